//! Collects the results of all contacts into one result.

use fem_case::{Gravity, Spot};
use fem_collision::{
    Approach, Bounce, Collision, Ending, HistoryRow, OutputRequest, RestState, STAY_TOGETHER,
    Snapshot, Stop,
};
use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::report;

/// The restart state of a bouncing ball, in addition to that of the present contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Bounces {
    /// Initial state of the ball, and the output request of all contacts.
    pub(super) approach: Approach,
    pub(super) request: OutputRequest,
    /// Results of the finished contacts.
    pub(super) so_far: Bounced,
    /// Speed (m/s) of the contact for which the present model was refined, if it was.
    pub(super) made_at: Option<f64>,
}

/// The results of the contacts so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Bounced {
    gravity: Gravity,
    chain: Chain,
    first: Option<Collision>,
    bounces: Vec<Bounce>,
    rest: Option<RestState>,
    ending: Ending,
    steps: Option<u64>,
    element_updates: Option<u64>,
    /// Energy (J) left in vibrations by the contact before, and the largest bound of their influence.
    vibration: f64,
    phase: Option<(usize, f64)>,
    sinks: bool,
    warnings: Vec<String>,
}

impl Bounced {
    pub fn new(chain: Chain, gravity: Gravity) -> Self {
        Self {
            gravity,
            chain,
            first: None,
            bounces: Vec::new(),
            rest: None,
            ending: Ending::Parted,
            steps: None,
            element_updates: None,
            vibration: 0.0,
            phase: None,
            sinks: false,
            warnings: Vec::new(),
        }
    }

    /// Returns the time of first touch of the contact under way, or the end of the last one, s.
    pub fn time(&self) -> f64 {
        self.chain.time()
    }

    /// Returns the time of the first touch of all, s.
    pub fn first_touch(&self) -> f64 {
        self.chain.first_touch()
    }

    pub fn element_updates(&self) -> u64 {
        self.element_updates.unwrap_or_default()
    }

    /// Returns the number of finished contacts.
    pub fn n_contacts(&self) -> usize {
        self.bounces.len()
    }

    /// Returns the snapshots of the first contact.
    pub fn snapshots(&self) -> &[Snapshot] {
        self.first.as_ref().map_or(&[], |first| &first.snapshots)
    }

    /// Returns whether the state is consistent with a ball under this gravity during a contact.
    pub fn is_consistent(&self, gravity: &Gravity) -> bool {
        self.gravity == *gravity
            && self.n_contacts() < gravity.bounces
            && self.first.is_some() == (self.n_contacts() > 0)
            && self.ending == Ending::Parted
            && self.rest.is_none()
            && !self.sinks
    }

    pub fn is_at_rest(&self) -> bool {
        self.ending == Ending::AtRest
    }

    pub fn warn(&mut self, warning: String) {
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    /// Records that the ball flows under its weight without limit.
    pub fn sink(&mut self) {
        self.sinks = true;
    }

    pub fn bear(&mut self, rest: RestState) {
        self.rest = Some(rest);
    }

    /// Returns the weight m g, N.
    pub fn weight(&self) -> Option<f64> {
        Some(self.gravity.acceleration * self.first.as_ref()?.bodies[1].mass?)
    }

    pub fn stop(&mut self, stop: Stop) {
        self.ending = Ending::Stopped(stop);
    }

    /// Takes the result of a contact and returns the speed (m/s) of the next landing, if there is one.
    pub fn take(&mut self, mut collision: Collision, request: &OutputRequest) -> Option<f64> {
        let add = |sum: Option<u64>, more: Option<u64>| {
            more.map(|more| sum.unwrap_or_default().saturating_add(more)).or(sum)
        };
        self.steps = add(self.steps, collision.steps);
        self.element_updates = add(self.element_updates, collision.element_updates);
        let time = self.time();
        // Bodies that stay together after a bounce are a ball at rest, which has its own warning.
        let is_first = self.bounces.is_empty();
        for warning in std::mem::take(&mut collision.warnings) {
            if is_first || warning != STAY_TOGETHER {
                self.warn(warning);
            }
        }
        let rows = std::mem::take(&mut collision.history);
        let weight = self.gravity.acceleration * collision.bodies[1].mass.unwrap_or(0.0);
        self.chain.take(&collision, &rows, weight);
        if let Ending::Stopped(stop) = &collision.ending {
            let stop = of_all(stop, self.element_updates).later_by(time);
            return self.stop_after(&rows, collision, stop);
        }
        let bounce = Bounce {
            time,
            speed_before: collision.approach.speed(),
            restitution: collision.restitution.unwrap_or_default(),
            contact_time: collision.contact_time,
            peak_force: collision.peak_force,
        };
        self.bounces.push(bounce);
        self.bound_phase(&collision, &bounce);
        let is_parted = collision.ending == Ending::Parted;
        let end = rows.last().copied().filter(|_| is_parted);
        if end.is_some_and(|end| !Chain::is_finite(&end)) {
            let what = format!("the flight after contact {} is not finite", self.bounces.len());
            return self.stop_after(&rows, collision, Stop::OutOfRange(what));
        }
        let landing = end.and_then(|end| self.chain.landing(&end, self.gravity.acceleration));
        if let Some(bounce) = self.bounces.last_mut() {
            // The speed after is that at the height of first touch, which equals the landing speed.
            let after = landing.as_ref().map_or(0.0, |landing| landing.speed);
            let found = Ending::Parted.restitution(after, bounce.speed_before);
            bounce.restitution = found.unwrap_or(bounce.restitution);
        }
        self.chain.keep(&rows, landing.map_or(f64::INFINITY, |landing| landing.time));
        let of_dents = self.dent(collision, time);
        let Some(landing) = landing else {
            self.chain.stay(rows.last());
            self.ending = Ending::AtRest;
            return None;
        };
        if self.bounces.len() < self.gravity.bounces
            && let Some(end) = &end
        {
            self.chain.fly(end, &landing, of_dents, request.history_rows > 0);
        }
        Some(landing.speed)
    }

    /// Ends the run with the rows of a contact that stopped.
    fn stop_after<T>(&mut self, rows: &[HistoryRow], last: Collision, stop: Stop) -> Option<T> {
        self.chain.keep(rows, f64::INFINITY);
        self.ending = Ending::Stopped(stop);
        self.first.get_or_insert(last);
        None
    }

    /// Keeps the dents of a contact that begins at a time (s), and returns the energy locked in by those that the ball meets
    /// again, J.
    fn dent(&mut self, mut contact: Collision, time: f64) -> f64 {
        let unloaded =
            contact.unloaded.take().map(|dent| Snapshot { time: time + dent.time, ..dent });
        let locked_in = contact.bodies.each_ref().map(|body| body.locked_in);
        let is_same = self.gravity.spot == Some(Spot::Same);
        let is_first = self.first.is_none();
        let first = self.first.get_or_insert(contact);
        // A dent is that of the last contact in the same place.
        if is_first || is_same && unloaded.is_some() {
            first.unloaded = unloaded;
            for (body, energy) in first.bodies.iter_mut().zip(locked_in) {
                body.locked_in = energy;
            }
        }
        locked_in.iter().flatten().filter(|_| is_same).sum()
    }

    /// Returns the bound on the influence of the previous contact's vibrations.
    fn bound_phase(&mut self, collision: &Collision, bounce: &Bounce) {
        // Waves in a half-space, which has no mass, do not return.
        let bodies = collision.bodies.iter().filter(|body| body.mass.is_some());
        let left: f64 = bodies.filter_map(|body| body.vibration_energy).sum();
        let initial = collision.initial_energy.unwrap_or(f64::INFINITY);
        let bound = report::phase_bound(self.vibration, left, initial, bounce.restitution);
        if bound > self.phase.map_or(report::MAX_SILENT_BOUND, |(_, largest)| largest) {
            self.phase = Some((self.bounces.len(), bound));
        }
        self.vibration = left;
    }

    /// Returns the whole result.
    pub fn collision(mut self, approach: Approach) -> Collision {
        let Some(first) = self.first.take() else {
            let stop = match self.ending {
                Ending::Stopped(stop) => stop,
                _ => Stop::NotMade("the ball never landed".to_string()),
            };
            return Collision::stopped(approach, stop);
        };
        let said = match self.sinks {
            true => vec![report::sinks(self.bounces.len())],
            false => report::of(&self.bounces, &self.ending, self.phase),
        };
        said.into_iter().for_each(|warning| self.warn(warning));
        let shift = |time: Option<f64>| Some(time? + self.chain.first_touch());
        Collision {
            approach,
            restitution: self
                .bounces
                .first()
                .map(|bounce| bounce.restitution)
                .or(first.restitution),
            first_contact: shift(first.first_contact),
            last_contact: shift(first.last_contact),
            energies: self.chain.energies(),
            residual: self.chain.residual(),
            residual_relative: self.chain.worst_residual().or(first.residual_relative),
            energy_growth: self.chain.growth(),
            steps: self.steps,
            element_updates: self.element_updates,
            bounces: self.bounces,
            rest: self.rest,
            ending: self.ending,
            history: self.chain.into_rows(),
            warnings: self.warnings,
            ..first
        }
    }
}

/// Returns the stop of a contact with the element updates of all contacts.
fn of_all(stop: &Stop, element_updates: Option<u64>) -> Stop {
    match (stop, element_updates) {
        (&Stop::TooManyUpdates { at, .. }, Some(element_updates)) => {
            Stop::TooManyUpdates { at, element_updates }
        }
        _ => stop.clone(),
    }
}
