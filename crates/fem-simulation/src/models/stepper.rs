//! A collision under way, for who decides when it goes on: a generator, a frame of a page, a process
//! that is stopped and begun again.

use std::sync::Arc;

use fem_collision::{Approach, Collision, Monitor, OutputRequest, Progress, Stop};

use crate::models::method::Model;
use crate::models::restart_state::RestartState;

/// A collision under way.
pub trait Stepper {
    /// Goes on for a while: some steps of a model that steps, all that there is of another one. Whether
    /// there is more to compute.
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool;

    /// How far it is.
    fn progress(&self) -> Progress;

    /// All that a restart needs, of a model that goes on from it; see
    /// [`Model::resume`](crate::Model::resume).
    fn memory(&self) -> Option<RestartState> {
        None
    }

    /// What came out. A collision that is not over is interrupted here.
    fn finish(self: Box<Self>) -> Collision;
}

/// Begins a collision by a model: one that steps goes on in steps, another one in one go.
pub(crate) fn begun(
    model: &Arc<dyn Model>,
    approach: &Approach,
    request: &OutputRequest,
) -> Box<dyn Stepper> {
    model.start(approach, request).unwrap_or_else(|| {
        let (model, approach, request) = (model.clone(), *approach, request.clone());
        let collide = move |monitor: &mut dyn Monitor| model.collide(&approach, &request, monitor);
        Box::new(InOneGo::of(approach, collide))
    })
}

/// Goes on to the end, or until `monitor` interrupts it.
pub(crate) fn to_the_end(mut course: Box<dyn Stepper>, monitor: &mut dyn Monitor) -> Collision {
    while monitor.report(course.progress()) && course.advance(monitor) {}
    course.finish()
}

/// A collision that cannot begin, and why.
pub(crate) fn stopped(approach: Approach, stop: Stop) -> Box<dyn Stepper> {
    Box::new(InOneGo::of(approach, move |_| Collision::stopped(approach, stop.clone())))
}

/// A collision that is computed in one go.
pub(crate) struct InOneGo<F> {
    approach: Approach,
    collide: F,
    collision: Option<Collision>,
}

impl<F: Fn(&mut dyn Monitor) -> Collision> InOneGo<F> {
    /// Of bodies that meet like this, and what computes it.
    pub fn of(approach: Approach, collide: F) -> Self {
        Self { approach, collide, collision: None }
    }
}

impl<F: Fn(&mut dyn Monitor) -> Collision> Stepper for InOneGo<F> {
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool {
        if self.collision.is_none() {
            self.collision = Some((self.collide)(monitor));
        }
        false
    }

    fn progress(&self) -> Progress {
        let fraction = if self.collision.is_some() { 1.0 } else { 0.0 };
        Progress { time: 0.0, step: 0, fraction, contact_force: 0.0 }
    }

    fn finish(self: Box<Self>) -> Collision {
        let not_begun = Stop::Interrupted { time: 0.0, step: 0 };
        self.collision.unwrap_or_else(|| Collision::stopped(self.approach, not_begun))
    }
}
