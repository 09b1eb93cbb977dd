//! The log of the contact: first and last contact, and extremes.

use fem_collision::{DeepestOverlap, POST_CONTACT_FRACTION, StepInstant, nan_aware_max_abs};
use fem_contact::ContactForces;
use serde::{Deserialize, Serialize};

use crate::model::ExplicitBodies;
use crate::state::{Scratch, State};

/// Relative motion of the mass centres, first and last contact, and extremes so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactLog {
    /// Integrated from the forces, m.
    pub approach: f64,
    /// Its rate over the last half step, m/s.
    pub approach_rate: f64,
    /// Time of the first step with a contact force, s.
    pub first_contact: Option<f64>,
    /// Time of the last such step so far, s.
    pub last_contact: Option<f64>,
    /// Number of separate contacts.
    pub episodes: u64,
    /// Contact force of the last step, N.
    pub force: f64,
    /// Largest contact force, N.
    pub peak_force: f64,
    /// Largest penetration of the springs.
    pub deepest_overlap: Option<DeepestOverlap>,
    /// Largest approach, m.
    pub max_approach: f64,
    was_closed: bool,
    /// Whether the bodies have receded since first touch.
    has_receded: bool,
}

impl ContactLog {
    /// Starts at first touch.
    pub fn new(model: &ExplicitBodies, state: &State) -> Self {
        let [lower, upper] = [0, 1].map(|side: usize| {
            let body = &model.bodies()[side];
            if body.node_forces.is_empty() {
                body.velocity
            } else {
                // Half a step before first touch the forces had acted for a shorter time.
                body.centre(&state.bodies[side].velocity)
            }
        });
        Self {
            approach: 0.0,
            approach_rate: lower - upper,
            first_contact: None,
            last_contact: None,
            episodes: 0,
            force: 0.0,
            peak_force: 0.0,
            deepest_overlap: None,
            max_approach: 0.0,
            was_closed: false,
            has_receded: false,
        }
    }

    /// Enters the contact at a time (s) and step.
    pub fn observe(&mut self, time: f64, step: u64, contact: &ContactForces) {
        let is_closed = contact.n_closed > 0;
        self.force = contact.force;
        if is_closed {
            self.first_contact.get_or_insert(time);
            self.last_contact = Some(time);
            self.episodes += u64::from(!self.was_closed);
            self.peak_force = nan_aware_max_abs(self.peak_force, contact.force);
            let (overlap, radius, at) =
                (contact.overlap, contact.overlap_radius, StepInstant { time, step });
            self.deepest_overlap =
                DeepestOverlap::of(self.deepest_overlap, DeepestOverlap { overlap, radius, at });
        }
        self.was_closed = is_closed;
        // Bodies farther apart than at first touch do not count; a value that is not a number does.
        if self.approach >= 0.0 || self.approach.is_nan() {
            self.max_approach = nan_aware_max_abs(self.max_approach, self.approach);
        }
    }

    /// Adds the impulse of forces that act for a time, s; the contact force is the last one.
    pub fn push(&mut self, model: &ExplicitBodies, scratch: &Scratch, time: f64) {
        self.approach_rate -= time * self.force * model.inverse_mass;
        for (side, body) in model.bodies().iter().enumerate() {
            if !body.node_forces.is_empty() {
                let change = time * scratch.resultants[side] / body.mass();
                self.approach_rate += if side == 0 { change } else { -change };
            }
        }
    }

    /// Moves the mass centres by a step (s).
    pub fn advance(&mut self, model: &ExplicitBodies, scratch: &Scratch, time_step: f64) {
        self.push(model, scratch, time_step);
        self.has_receded |= self.approach_rate < 0.0;
        self.approach += time_step * self.approach_rate;
    }

    /// Returns whether it can belong to a run in a state.
    pub fn fits(&self, state: &State) -> bool {
        let times_fit = match (self.first_contact, self.last_contact) {
            (Some(first), Some(last)) => first <= last && last <= state.time,
            (None, None) => true,
            _ => false,
        };
        times_fit && self.episodes <= state.step + 1
    }

    /// Returns whether the bodies have separated at a time (s): the contact has been open for a fifth of its duration
    /// while they recede, or gravity (as acceleration of the approach, m/s²) has brought the flight to its top.
    pub fn has_separated(&self, time: f64, gravity: f64) -> bool {
        let (Some(first), Some(last)) = (self.first_contact, self.last_contact) else {
            return false;
        };
        let is_at_top = gravity > 0.0 && self.has_receded && self.approach_rate >= 0.0;
        if is_at_top && !self.was_closed {
            return true;
        }
        !self.was_closed
            && self.approach_rate < 0.0
            && time - last >= POST_CONTACT_FRACTION * (last - first)
    }
}
