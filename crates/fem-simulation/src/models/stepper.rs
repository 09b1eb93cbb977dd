//! A collision that is computed in pieces, and its restart state.

use fem_collision::{Approach, Collision, Monitor, Progress, StepInstant, Stop};
use serde::{Deserialize, Serialize};

use crate::models::bouncing::Bounces;

/// A collision under way, for callers that decide when it continues: a generator, a frame of a page, or a process that
/// is stopped and started again.
pub trait Stepper {
    /// Computes some steps, or the whole collision if the model has no steps. Returns whether there is more to compute.
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool;

    /// Returns the progress.
    fn progress(&self) -> Progress;

    /// Returns the restart state, if the model can continue from one ([`Model::resume`](crate::Model::resume)).
    fn restart_state(&self) -> Option<RestartState> {
        None
    }

    /// Returns the collision. One that has not ended is interrupted.
    fn finish(self: Box<Self>) -> Collision;
}

/// Computes a collision to its end, or until `monitor` interrupts it.
pub(crate) fn to_the_end(mut stepper: Box<dyn Stepper>, monitor: &mut dyn Monitor) -> Collision {
    while monitor.report(stepper.progress()) && stepper.advance(monitor) {}
    stepper.finish()
}

/// Returns a collision that cannot begin, with its reason.
pub(crate) fn stopped(approach: Approach, stop: Stop) -> Box<dyn Stepper> {
    Box::new(SingleStep::new(approach, move |_| Collision::stopped(approach, stop.clone())))
}

/// A collision that is computed in a single piece.
pub(crate) struct SingleStep<F> {
    approach: Approach,
    collide: F,
    collision: Option<Collision>,
}

impl<F: Fn(&mut dyn Monitor) -> Collision> SingleStep<F> {
    /// Makes the stepper of an approach from the function that computes its collision.
    pub fn new(approach: Approach, collide: F) -> Self {
        Self { approach, collide, collision: None }
    }
}

impl<F: Fn(&mut dyn Monitor) -> Collision> Stepper for SingleStep<F> {
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
        let not_begun = Stop::Interrupted { at: StepInstant { time: 0.0, step: 0 } };
        self.collision.unwrap_or_else(|| Collision::stopped(self.approach, not_begun))
    }
}

/// A collision whose result is transformed when it is finished.
pub(crate) struct Transformed<F> {
    /// The approach in restart states.
    pub approach: Approach,
    pub stepper: Box<dyn Stepper>,
    pub transform: F,
}

impl<F: FnOnce(Collision) -> Collision> Stepper for Transformed<F> {
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool {
        self.stepper.advance(monitor)
    }

    fn progress(&self) -> Progress {
        self.stepper.progress()
    }

    fn restart_state(&self) -> Option<RestartState> {
        Some(RestartState { approach: self.approach, ..self.stepper.restart_state()? })
    }

    fn finish(self: Box<Self>) -> Collision {
        (self.transform)(self.stepper.finish())
    }
}

/// The restart state of a [`Stepper`] between two advances. A stepper that resumes from it
/// ends with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestartState {
    /// State of the present contact, by explicit elements.
    pub(crate) contact: fem_explicit::RunState,
    /// Results of earlier contacts, for a ball that gravity brings back.
    pub(crate) bounces: Option<Box<Bounces>>,
    /// Approach of the bodies in the present contact, in the frame of the case.
    pub(crate) approach: Approach,
    /// Number of elements per length over that of the first plan.
    pub(crate) refinement: f64,
    /// Coarser meshes on which the collision was computed before.
    pub(crate) levels: Vec<RefinementLevel>,
}

impl RestartState {
    /// Returns the state of the present contact.
    pub fn contact(&self) -> &fem_explicit::RunState {
        &self.contact
    }

    /// Returns the number of steps done in the present contact.
    pub fn step(&self) -> u64 {
        self.contact.step()
    }
}

/// A mesh that was too coarse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefinementLevel {
    /// Edge length of its elements at the contact.
    pub contact_element_size_m: f64,
    /// Element updates of its collision; `None` if the collision was not computed on it or takes none.
    pub element_updates: Option<u64>,
    /// Key of the quantity that exceeds its tolerance by the largest factor.
    pub quantity: String,
    /// Its estimated error: the restitution's absolute, others relative.
    pub error: f64,
    /// The tolerance of that quantity in the case.
    pub tolerance: f64,
}
