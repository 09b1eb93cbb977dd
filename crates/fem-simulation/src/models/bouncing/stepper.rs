//! The stepper of a bouncing ball.

use std::sync::Arc;

use fem_case::Spot;
use fem_collision::{Approach, Collision, Monitor, OutputRequest, Phase, Progress, Snapshot, Stop};
use fem_explicit::ModelError;
use fem_mesh::SphereMesh;

use super::bounced::{Bounced, Bounces};
use super::chain::Chain;
use super::{Ball, after_fall, first_request, later_request};
use crate::models::method::{Model, start_stepper};
use crate::models::stepper::{RestartState, Stepper};
use crate::rejection::Rejection;

/// A bouncing ball under way.
pub(super) struct BouncingStepper {
    ball: Arc<Ball>,
    known: Bounces,
    /// Computes the contact under way.
    present: Arc<dyn Model>,
    /// The contact under way; `None` after the last one.
    contact: Option<Box<dyn Stepper>>,
    /// End of the contact before, if the ball falls onto its dent.
    dented: Option<RestartState>,
}

impl Bounces {
    /// Returns the output request of the present contact.
    fn request(&self, ball: &Ball) -> OutputRequest {
        match self.so_far.n_contacts() {
            0 => first_request(&self.request, self.so_far.time()),
            _ => later_request(&self.request, ball.gravity.bounces, self.so_far.element_updates()),
        }
    }

    /// Returns whether the state can belong to this ball in this contact.
    fn fits(&self, ball: &Ball, contact: &fem_explicit::RunState, approach: &Approach) -> bool {
        let (speed, time, _) = ball.fall(&self.approach);
        let is_first = self.so_far.n_contacts() == 0;
        self.request.check().is_ok()
            && self.so_far.is_consistent(&ball.gravity)
            && self.so_far.snapshots().iter().all(|one| has_sizes(one, ball.first.meshes()))
            && self.so_far.first_touch() == time
            && (!is_first || approach.speed() == speed)
            && approach.velocities()[0] == 0.0
            && approach.gap() == 0.0
            && *contact.request() == self.request(ball)
    }
}

/// Returns whether a snapshot has a value for every node.
fn has_sizes(snapshot: &Snapshot, meshes: [Option<&SphereMesh>; 2]) -> bool {
    snapshot.bodies.iter().zip(meshes).all(|(fields, mesh)| {
        let n = mesh.map_or(0, |mesh| mesh.nodes().len());
        fields.displacement.len() == n
            && fields.velocity.len() == n
            && (fields.effective.is_empty() || fields.effective.len() == n)
    })
}

impl BouncingStepper {
    /// Makes a ball at its start.
    pub fn new(ball: &Arc<Ball>, approach: &Approach, request: &OutputRequest) -> Self {
        let (speed, time, _) = ball.fall(approach);
        let so_far = Bounced::new(Chain::new(time), ball.gravity);
        let known =
            Bounces { approach: *approach, request: request.clone(), so_far, made_at: None };
        let present = ball.first.clone();
        let mut stepper = Self { ball: ball.clone(), known, present, contact: None, dented: None };
        stepper.touch(speed);
        stepper
    }

    /// Continues from a restart state.
    ///
    /// # Errors
    /// A restart state of another ball, or one whose parts contradict each other.
    pub fn resume(ball: &Arc<Ball>, state: RestartState) -> Result<Self, Rejection> {
        let another = || Rejection::new("gravity", ModelError::ForeignRestartState.to_string());
        let known = state.bounces.clone().ok_or_else(another)?;
        if !known.fits(ball, &state.contact, &state.approach) {
            return Err(another());
        }
        let present: Arc<dyn Model> = match known.made_at {
            Some(speed) => Arc::from(ball.made_at(speed).map_err(|_| another())?),
            None => ball.first.clone(),
        };
        let contact = Some(present.resume(RestartState { bounces: None, ..state })?);
        Ok(Self { ball: ball.clone(), known: *known, present, contact, dented: None })
    }

    /// Begins the contact at a landing speed, m/s.
    fn touch(&mut self, speed: f64) {
        match self.begin(speed) {
            Ok(contact) => self.contact = Some(contact),
            Err(stop) => self.known.so_far.stop(stop),
        }
    }

    /// Returns the stepper of the contact at a speed, m/s.
    fn begin(&mut self, speed: f64) -> Result<Box<dyn Stepper>, Stop> {
        let contact =
            Approach::new([0.0, -speed], 0.0).map_err(|error| Stop::NotMade(error.to_string()))?;
        if let Some(dented) = self.dented.take() {
            return self.present.again(&dented, &contact, &self.known.request(&self.ball));
        }
        if self.known.so_far.n_contacts() > 0
            && let Some(model) = self.ball.refined_model(self.present.as_ref(), speed)?
        {
            self.present = Arc::from(model);
            self.known.made_at = Some(speed);
        }
        Ok(start_stepper(&self.present, &contact, &self.known.request(&self.ball)))
    }

    /// Takes the result of a contact and returns the speed (m/s) of the next landing, if there is one.
    fn take(&mut self, mut collision: Collision) -> Option<f64> {
        // A later contact may have another mesh than the files.
        let meshes = self.ball.first.meshes();
        collision.unloaded = collision.unloaded.filter(|dent| has_sizes(dent, meshes));
        let collision = match self.known.so_far.n_contacts() {
            0 => {
                let (_, time, height) = self.ball.fall(&self.known.approach);
                after_fall(collision, time, height)
            }
            _ => collision,
        };
        self.known.so_far.take(collision, &self.known.request)
    }
}

impl Stepper for BouncingStepper {
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool {
        let Some(contact) = &mut self.contact else { return false };
        let mut one = ContactMonitor::of(&self.known.so_far, &self.ball, monitor);
        if contact.advance(&mut one) {
            return true;
        }
        let Some(contact) = self.contact.take() else { return false };
        if self.ball.gravity.spot == Some(Spot::Same) {
            self.dented = contact.restart_state().filter(|state| state.contact.is_dented());
        }
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
            Some(contact) => {
                ContactMonitor::of(so_far, &self.ball, &mut ()).whole(contact.progress())
            }
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

/// The monitor of one contact, which reports to the monitor of all contacts.
struct ContactMonitor<'a> {
    monitor: &'a mut dyn Monitor,
    k: usize,
    n: usize,
    /// Time of first touch of the contact, s.
    time: f64,
}

impl<'a> ContactMonitor<'a> {
    /// Makes the monitor of the present contact.
    fn of(so_far: &Bounced, ball: &Ball, monitor: &'a mut dyn Monitor) -> Self {
        Self { monitor, k: so_far.n_contacts(), n: ball.gravity.bounces, time: so_far.time() }
    }

    /// Returns the progress of all contacts from that of the present one.
    fn whole(&self, progress: Progress) -> Progress {
        let fraction = (self.k as f64 + progress.fraction) / self.n as f64;
        Progress { time: self.time + progress.time, fraction, ..progress }
    }
}

impl Monitor for ContactMonitor<'_> {
    /// Reports the phase of the first contact alone, since all contacts are one collision.
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
