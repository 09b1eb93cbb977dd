//! A run from first touch to separation.

use fem_collision::{Snapshot, SnapshotRequest};

use crate::error::Stop;
use crate::history::{History, HistoryRow, RowKind};
use crate::ledger::Ledger;
use crate::model::Model;
use crate::recorder::{Instant, Recorder};
use crate::state::{Scratch, State};
use crate::step::{advance, is_closed_next, update_forces};

/// The run goes on for this share of the contact time after the last contact.
const FLIGHT_AFTER: f64 = 0.2;
/// Total energy over initial energy beyond which a run is unstable.
const ENERGY_LIMIT: f64 = 1.05;
/// Steps between reports to the monitor.
const MONITOR_STRIDE: u64 = 64;

/// What a run is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSettings {
    /// Estimate of the contact time, s: sets the stride of the history.
    pub expected_contact_time: f64,
    /// Estimate of the largest approach, m.
    pub expected_approach: f64,
    /// Rows of the history over the expected contact.
    pub history_rows: usize,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// The run gives up this long after first touch, s.
    pub max_time: f64,
}

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// Estimated share of the run that is done, 0 to 1.
    pub fraction: f64,
    /// Contact force, N.
    pub contact_force: f64,
}

/// Looks on while a run goes on.
pub trait Monitor {
    /// Called every few steps; `false` interrupts the run.
    fn report(&mut self, progress: Progress) -> bool;
}

impl Monitor for () {
    fn report(&mut self, _: Progress) -> bool {
        true
    }
}

/// What came out of a run, as far as it got.
#[derive(Debug, Clone)]
pub struct Collision {
    /// History over contact and separation.
    pub history: Vec<HistoryRow>,
    /// Snapshots in the order of time.
    pub snapshots: Vec<Snapshot>,
    /// Relative velocity after over before, 1 when elastic; `None` for a run
    /// that did not end.
    pub restitution: Option<f64>,
    /// Time of the first step with a contact force, s.
    pub first_contact: Option<f64>,
    /// Time of the last step with a contact force, s.
    pub last_contact: Option<f64>,
    /// Number of separate contacts.
    pub contact_episodes: u64,
    /// Largest contact force, N.
    pub peak_force: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest contact radius, m.
    pub max_contact_radius: f64,
    /// Largest contact pressure on the axis, Pa.
    pub peak_pressure: f64,
    /// Velocities of the mass centres at the end, m/s.
    pub velocity_after: [f64; 2],
    /// Vibration energy left in each body, J: twice the mean kinetic energy
    /// relative to the mass centre after the contact (half of a vibration's
    /// energy is kinetic); `None` for a run that did not end.
    pub vibration_energy: Option<[f64; 2]>,
    /// Kinetic energy at the start, J.
    pub initial_energy: f64,
    /// Worst imbalance of energy over the initial kinetic energy in the frame of
    /// the centre of mass.
    pub residual_relative: f64,
    /// Worst drift of momentum over Σ m|v| at the start.
    pub momentum_residual_relative: f64,
    /// Steps done.
    pub steps: u64,
    /// Elements times steps.
    pub element_updates: u64,
    /// Why the run did not end by itself.
    pub stopped: Option<Stop>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Runs a model from first touch until the force has been zero for a fifth of
/// the contact time and the bodies recede.
///
/// Nothing is allocated inside a step, but for the states of snapshots until
/// their pool is filled.
pub fn collide(model: &Model, settings: &RunSettings, monitor: &mut dyn Monitor) -> Collision {
    let mut run = Run::new(model, settings);
    let stopped = run.until_separation(monitor).err();
    run.finish(stopped)
}

/// A run under way.
struct Run<'a> {
    model: &'a Model,
    settings: &'a RunSettings,
    state: State,
    scratch: Scratch,
    ledger: Ledger,
    history: History,
    recorder: Recorder,
    /// Relative motion of the mass centres, integrated from the contact force.
    approach: f64,
    approach_rate: f64,
    first_contact: Option<f64>,
    last_contact: Option<f64>,
    contact_episodes: u64,
    was_closed: bool,
    peak_force: f64,
    max_approach: f64,
}

impl<'a> Run<'a> {
    fn new(model: &'a Model, settings: &'a RunSettings) -> Self {
        let expected_steps = settings.expected_contact_time / model.time_step();
        Self {
            model,
            settings,
            state: State::at_first_touch(model),
            scratch: Scratch::new(model),
            ledger: Ledger::new(model),
            history: History::new(settings.history_rows, expected_steps),
            recorder: Recorder::new(
                &settings.snapshots,
                model,
                settings.expected_approach,
                settings.expected_contact_time,
            ),
            approach: 0.0,
            approach_rate: model.approach_speed(),
            first_contact: None,
            last_contact: None,
            contact_episodes: 0,
            was_closed: false,
            peak_force: 0.0,
            max_approach: 0.0,
        }
    }

    fn until_separation(&mut self, monitor: &mut dyn Monitor) -> Result<(), Stop> {
        loop {
            let contact = update_forces(self.model, &self.state, &mut self.scratch);
            let (time, step) = (self.state.time, self.state.step);
            let is_closed = contact.n_closed > 0;
            let is_first_contact = is_closed && self.first_contact.is_none();
            let is_last_contact = is_closed
                && contact.force < 0.5 * self.peak_force
                && !is_closed_next(self.model, &self.state, &self.scratch);
            if is_closed {
                self.first_contact.get_or_insert(time);
                self.last_contact = Some(time);
                self.contact_episodes += u64::from(!self.was_closed);
                self.peak_force = self.peak_force.max(contact.force);
            }
            self.was_closed = is_closed;
            self.max_approach = self.max_approach.max(self.approach);
            let ended = self.has_separated(is_closed);
            if is_first_contact || is_last_contact || ended || self.history.is_due(step) {
                let row = self.ledger.balance(self.model, &self.state, &self.scratch, &contact);
                self.check_energy(&row)?;
                let kind = match (is_last_contact, is_first_contact || ended) {
                    (_, true) => RowKind::Landmark,
                    (true, _) => RowKind::LastContact,
                    _ => RowKind::Regular,
                };
                self.history.push(row, kind);
            }
            let now = Instant {
                approach: self.approach,
                approach_rate: self.approach_rate,
                is_closed,
                is_first_contact,
                is_last_contact,
            };
            self.recorder.observe(self.model, &self.state, &self.scratch, now);
            if ended {
                return Ok(());
            }
            if contact.at_limit {
                // A run that blows up throws its nodes about: that is not a large contact.
                let row = self.ledger.balance(self.model, &self.state, &self.scratch, &contact);
                self.check_energy(&row)?;
                let radius = self.model.interface().candidate_radius();
                return Err(Stop::ContactBeyondCandidates { time, step, radius });
            }
            if time - self.model.first_touch() > self.settings.max_time {
                return Err(Stop::NoSeparation { time, step });
            }
            if step.is_multiple_of(MONITOR_STRIDE) && !monitor.report(self.progress(contact.force))
            {
                return Err(Stop::Interrupted { time, step });
            }
            self.ledger.count_step(self.model, contact.force);
            self.count_motion(contact.force);
            advance(self.model, &mut self.state, &self.scratch);
        }
    }

    /// Relative motion of the mass centres over the step to t_n+1.
    fn count_motion(&mut self, force: f64) {
        let time_step = self.model.time_step();
        let inverse_mass: f64 =
            self.model.bodies().iter().map(|body| body.total_mass().recip()).sum();
        self.approach_rate -= time_step * force * inverse_mass;
        self.approach += time_step * self.approach_rate;
    }

    fn has_separated(&self, is_closed: bool) -> bool {
        let (Some(first), Some(last)) = (self.first_contact, self.last_contact) else {
            return false;
        };
        !is_closed
            && self.approach_rate < 0.0
            && self.state.time - last >= FLIGHT_AFTER * (last - first)
    }

    fn check_energy(&self, row: &HistoryRow) -> Result<(), Stop> {
        let ratio = 1.0 + row.residual / self.ledger.initial_relative;
        if ratio.is_finite() && ratio <= ENERGY_LIMIT {
            Ok(())
        } else {
            let (time, step) = (self.state.time, self.state.step);
            Err(Stop::EnergyGrowth { time, step, ratio })
        }
    }

    fn progress(&self, contact_force: f64) -> Progress {
        let expected = (1.0 + FLIGHT_AFTER) * self.settings.expected_contact_time;
        let done = (self.state.time - self.model.first_touch()) / expected;
        Progress {
            time: self.state.time,
            step: self.state.step,
            fraction: done.min(0.99),
            contact_force,
        }
    }

    fn finish(mut self, stopped: Option<Stop>) -> Collision {
        let is_recorded = self.history.rows().last().is_some_and(|row| row.time == self.state.time);
        if stopped.is_some() && !is_recorded {
            // The state where the run stopped ends the history, if it is sound.
            let contact = update_forces(self.model, &self.state, &mut self.scratch);
            let row = self.ledger.balance(self.model, &self.state, &self.scratch, &contact);
            if self.check_energy(&row).is_ok() {
                self.history.push(row, RowKind::Landmark);
            }
        }
        let rows = self.history.rows();
        let over_rows = |value: fn(&HistoryRow) -> f64| rows.iter().map(value).fold(0.0, f64::max);
        let velocity_after = rows.last().map_or([0.0; 2], |row| row.velocity);
        let after = |row: &&HistoryRow| self.last_contact.is_some_and(|last| row.time > last);
        let n_after = rows.iter().filter(after).count();
        let vibration_energy = (stopped.is_none() && n_after > 0).then(|| {
            [0, 1].map(|side: usize| {
                let sum: f64 = rows.iter().filter(after).map(|row| row.vibration[side]).sum();
                2.0 * sum / n_after as f64
            })
        });
        let restitution = stopped
            .is_none()
            .then(|| (velocity_after[1] - velocity_after[0]) / self.model.approach_speed());
        let max_contact_radius = over_rows(|row| row.contact_radius);
        let peak_pressure = over_rows(|row| row.centre_pressure);
        let (snapshots, warnings) = self.recorder.finish();
        Collision {
            history: self.history.into_rows(),
            snapshots,
            restitution,
            first_contact: self.first_contact,
            last_contact: self.last_contact,
            contact_episodes: self.contact_episodes,
            peak_force: self.peak_force,
            max_approach: self.max_approach,
            max_contact_radius,
            peak_pressure,
            velocity_after,
            vibration_energy,
            initial_energy: self.ledger.initial,
            residual_relative: self.ledger.worst_residual,
            momentum_residual_relative: self.ledger.worst_momentum,
            steps: self.state.step,
            element_updates: self.state.step * self.model.n_elements() as u64,
            stopped,
            warnings,
        }
    }
}

#[cfg(test)]
mod tests;
