//! A ball that bounces, under way.

use std::sync::Arc;

use fem_collision::{Approach, Collision, Monitor, OutputRequest, Phase, Progress, Snapshot, Stop};
use fem_explicit::ModelError;
use fem_mesh::SphereMesh;

use super::bounced::{Bounced, Bounces};
use super::chain::Chain;
use super::{Ball, fallen, first_request, later_request};
use crate::models::method::{Model, begun};
use crate::models::stepper::{RestartState, Stepper};
use crate::rejection::Rejection;

/// A ball that bounces, under way.
pub(super) struct BouncingCourse {
    ball: Arc<Ball>,
    known: Bounces,
    /// Computes the contact under way.
    present: Arc<dyn Model>,
    /// None once there is no further one.
    contact: Option<Box<dyn Stepper>>,
}

impl Bounces {
    /// Output request of the present contact.
    fn asked(&self, ball: &Ball) -> OutputRequest {
        match self.so_far.n_contacts() {
            0 => first_request(&self.request, self.so_far.time()),
            _ => later_request(&self.request, ball.gravity.bounces, self.so_far.element_updates()),
        }
    }

    /// Whether it can be of this ball in this contact. What was computed is not computed again.
    fn fits(&self, ball: &Ball, contact: &fem_explicit::RestartState, met: &Approach) -> bool {
        let (speed, time, _) = ball.fall(&self.approach);
        let is_first = self.so_far.n_contacts() == 0;
        self.request.check().is_ok()
            && self.so_far.is_sound(&ball.gravity)
            && self.so_far.snapshots().iter().all(|one| has_sizes(one, ball.first.meshes()))
            && self.so_far.first_touch() == time
            && (!is_first || met.speed() == speed)
            && met.velocities()[0] == 0.0
            && met.gap() == 0.0
            && *contact.request() == self.asked(ball)
    }
}

/// Whether a snapshot has a value for every node.
fn has_sizes(snapshot: &Snapshot, meshes: [Option<&SphereMesh>; 2]) -> bool {
    snapshot.bodies.iter().zip(meshes).all(|(fields, mesh)| {
        let n = mesh.map_or(0, |mesh| mesh.nodes().len());
        fields.displacement.len() == n
            && fields.velocity.len() == n
            && (fields.effective.is_empty() || fields.effective.len() == n)
    })
}

impl BouncingCourse {
    /// A ball about to fall.
    pub fn new(ball: &Arc<Ball>, approach: &Approach, request: &OutputRequest) -> Self {
        let (speed, time, _) = ball.fall(approach);
        let so_far = Bounced::new(Chain::new(time), ball.gravity);
        let known =
            Bounces { approach: *approach, request: request.clone(), so_far, made_at: None };
        let present = ball.first.clone();
        let mut course = Self { ball: ball.clone(), known, present, contact: None };
        course.touch(speed);
        course
    }

    /// Goes on from a memory.
    ///
    /// # Errors
    /// A memory of another ball; one whose parts contradict each other.
    pub fn resume(ball: &Arc<Ball>, memory: RestartState) -> Result<Self, Rejection> {
        let another = || Rejection::new("gravity", ModelError::ForeignRestartState.to_string());
        let known = memory.bounces.clone().ok_or_else(another)?;
        if !known.fits(ball, &memory.contact, &memory.met) {
            return Err(another());
        }
        let present: Arc<dyn Model> = match known.made_at {
            Some(speed) => Arc::from(ball.made_at(speed).map_err(|_| another())?),
            None => ball.first.clone(),
        };
        let contact = Some(present.resume(RestartState { bounces: None, ..memory })?);
        Ok(Self { ball: ball.clone(), known: *known, present, contact })
    }

    /// The ball comes down at a speed, m/s.
    fn touch(&mut self, speed: f64) {
        match self.begin(speed) {
            Ok(contact) => self.contact = Some(contact),
            Err(stop) => self.known.so_far.stop(stop),
        }
    }

    /// The contact at a speed, m/s.
    fn begin(&mut self, speed: f64) -> Result<Box<dyn Stepper>, Stop> {
        if self.known.so_far.n_contacts() > 0
            && let Some(model) = self.ball.anew(self.present.as_ref(), speed)?
        {
            self.present = Arc::from(model);
            self.known.made_at = Some(speed);
        }
        let contact =
            Approach::new([0.0, -speed], 0.0).map_err(|error| Stop::NotMade(error.to_string()))?;
        Ok(begun(&self.present, &contact, &self.known.asked(&self.ball)))
    }

    /// A contact is over: the speed (m/s) at which the ball comes down again, if it does.
    fn take(&mut self, collision: Collision) -> Option<f64> {
        let collision = match self.known.so_far.n_contacts() {
            0 => {
                let (_, time, height) = self.ball.fall(&self.known.approach);
                fallen(collision, time, height)
            }
            _ => collision,
        };
        self.known.so_far.take(collision, &self.known.request)
    }
}

impl Stepper for BouncingCourse {
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool {
        let Some(contact) = &mut self.contact else { return false };
        let mut one = OneOfMany::of(&self.known.so_far, &self.ball, monitor);
        if contact.advance(&mut one) {
            return true;
        }
        let Some(contact) = self.contact.take() else { return false };
        let landing = self.take(contact.finish());
        if let Some(speed) = landing
            && self.known.so_far.n_contacts() < self.ball.gravity.bounces
        {
            self.touch(speed);
        }
        self.contact.is_some()
    }

    fn progress(&self) -> Progress {
        let so_far = &self.known.so_far;
        let over = Progress { time: 0.0, step: 0, fraction: 1.0, contact_force: 0.0 };
        match &self.contact {
            Some(contact) => OneOfMany::of(so_far, &self.ball, &mut ()).whole(contact.progress()),
            None => Progress { time: so_far.time(), ..over },
        }
    }

    fn restart_state(&self) -> Option<RestartState> {
        let contact = self.contact.as_ref()?.restart_state()?;
        Some(RestartState { bounces: Some(Box::new(self.known.clone())), ..contact })
    }

    fn finish(mut self: Box<Self>) -> Collision {
        if let Some(contact) = self.contact.take() {
            self.take(contact.finish());
        }
        let Self { ball, known, .. } = *self;
        let mut so_far = known.so_far;
        if so_far.is_at_rest() {
            ball.rest(&mut so_far);
        }
        so_far.collision(known.approach)
    }
}

/// Looks on for one that looks on at all contacts.
struct OneOfMany<'a> {
    monitor: &'a mut dyn Monitor,
    k: usize,
    n: usize,
    /// First touch since the start of the case, s.
    time: f64,
}

impl<'a> OneOfMany<'a> {
    /// Returns the approach of the next contact.
    fn of(so_far: &Bounced, ball: &Ball, monitor: &'a mut dyn Monitor) -> Self {
        Self { monitor, k: so_far.n_contacts(), n: ball.gravity.bounces, time: so_far.time() }
    }

    /// Returns the progress of all contacts from that of the present one.
    fn whole(&self, progress: Progress) -> Progress {
        let fraction = (self.k as f64 + progress.fraction) / self.n as f64;
        Progress { time: self.time + progress.time, fraction, ..progress }
    }
}

impl Monitor for OneOfMany<'_> {
    /// All contacts are one collision.
    fn enter(&mut self, phase: Phase) {
        if self.k == 0 {
            self.monitor.enter(phase);
        }
    }

    fn report(&mut self, progress: Progress) -> bool {
        let whole = self.whole(progress);
        self.monitor.report(whole)
    }
}
