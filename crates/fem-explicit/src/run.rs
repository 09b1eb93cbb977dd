//! A run from first touch to separation, as a stepper: whoever owns it decides when to go on.

use fem_collision::{
    BodyResult, Book, Collision, Ending, Expectation, Monitor, Phase, Progress, Row, RowKind, Stop,
    Want,
};

use crate::contact_log::FLIGHT_AFTER;
use crate::error::ModelError;
use crate::memory::Memory;
use crate::model::Model;
use crate::recorder::Instant;
use crate::state::Scratch;
use crate::step::{advance, is_closed_next, update_forces};

/// Total energy over initial energy beyond which a run is unstable.
const ENERGY_LIMIT: f64 = 1.05;
/// Steps between reports to the monitor.
const MONITOR_STRIDE: u64 = 64;

/// Runs a model from first touch until the force has been zero for a fifth of
/// the contact time and the bodies recede.
///
/// Nothing is allocated inside a step, but for the states of snapshots until
/// their pool is filled.
pub fn collide(
    model: &Model,
    expected: Expectation,
    want: &Want,
    monitor: &mut dyn Monitor,
) -> Collision {
    monitor.enter(Phase::Collision);
    let mut run = Run::new(model, expected, want);
    let stopped = loop {
        if !monitor.report(run.progress()) {
            break Some(run.interrupt());
        }
        match run.advance(MONITOR_STRIDE) {
            Ok(Status::UnderWay) => {}
            Ok(Status::Separated) => break None,
            Err(stop) => break Some(stop),
        }
    };
    run.finish(stopped)
}

/// Whether a run goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The run goes on.
    UnderWay,
    /// The bodies have separated: nothing more is to be computed.
    Separated,
}

/// A run under way. Between two calls of [`Run::advance`] all that it knows is its [`Memory`].
///
/// ```
/// use fem_collision::{Approach, BodyInput, Expectation, Want};
/// use fem_explicit::{Model, Run, Settings, Status};
/// # use fem_material::{ElasticModuli, Material};
/// # use fem_mesh::{HalfDisc, Side};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
/// # let material = Material::new(2390.0, moduli, None)?;
/// # let disc = HalfDisc {
/// #     radius: 1e-2,
/// #     contact_element_size: 0.2e-3,
/// #     refined_radius: 0.6e-3,
/// #     growth: None,
/// # };
/// # let mesh = disc.build()?.on_side(Side::Below);
/// # let settings = Settings {
/// #     contact_stiffness: 6e11,
/// #     candidate_radius: 0.8e-3,
/// #     step_factor: 0.9,
/// #     mass_scaling: 1e-3,
/// # };
/// let bodies = [BodyInput::Sphere { mesh, material }, BodyInput::Wall];
/// let model = Model::new(bodies, Approach::at(0.5)?, &settings)?;
/// let expected = Expectation { contact_time: 80e-6, approach: 20e-6 };
/// let mut run = Run::new(&model, expected, &Want::quantities());
/// for _ in 0..10 {
///     run.advance(10)?;
/// }
/// // Stopped here, and gone on from what it knew, perhaps in another process.
/// let memory = run.memory().clone();
/// let mut resumed = Run::resume(&model, memory)?;
/// while resumed.advance(100)? == Status::UnderWay {}
/// let collision = resumed.finish(None);
/// assert!((collision.restitution.unwrap() - 1.0).abs() < 2e-3);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Run<'a> {
    model: &'a Model,
    pub(crate) memory: Memory,
    scratch: Scratch,
}

impl<'a> Run<'a> {
    /// A run at first touch.
    pub fn new(model: &'a Model, expected: Expectation, want: &Want) -> Self {
        let memory = Memory::new(model, expected, want);
        Self { model, memory, scratch: Scratch::new(model) }
    }

    /// Goes on from a memory of a run of the same model.
    ///
    /// # Errors
    /// A memory of another model: other sizes, approach, time step or region of contact.
    pub fn resume(model: &'a Model, memory: Memory) -> Result<Self, ModelError> {
        if !memory.fits(model) {
            return Err(ModelError::MemoryOfAnother);
        }
        Ok(Self { model, memory, scratch: Scratch::new(model) })
    }

    /// All that the run knows.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// How far the run is.
    pub fn progress(&self) -> Progress {
        let Memory { state, log, expected, .. } = &self.memory;
        let length = (1.0 + FLIGHT_AFTER) * expected.contact_time;
        let done = (state.time - self.model.approach().first_touch()) / length;
        Progress {
            time: state.time,
            step: state.step,
            fraction: done.min(0.99),
            contact_force: log.force,
        }
    }

    /// The stop of a run that is left here.
    pub fn interrupt(&self) -> Stop {
        Stop::Interrupted { time: self.memory.state.time, step: self.memory.state.step }
    }

    /// At most so many steps.
    ///
    /// # Errors
    /// What ends the run before the bodies have separated.
    pub fn advance(&mut self, n_steps: u64) -> Result<Status, Stop> {
        for _ in 0..n_steps {
            if self.step()? == Status::Separated {
                return Ok(Status::Separated);
            }
        }
        Ok(Status::UnderWay)
    }

    /// Forces of the present configuration, what is observed of it, and the motion to the next.
    fn step(&mut self) -> Result<Status, Stop> {
        let Memory { state, log, ledger, history, recorder, max_time, .. } = &mut self.memory;
        let contact = update_forces(self.model, state, &mut self.scratch);
        let (time, step) = (state.time, state.step);
        let is_closed = contact.n_closed > 0;
        let is_first_contact = is_closed && log.first_contact.is_none();
        let is_last_contact = is_closed
            && contact.force < 0.5 * log.peak_force
            && !is_closed_next(self.model, state, &self.scratch);
        log.observe(time, &contact);
        let has_separated = log.has_separated(time);
        if is_first_contact || is_last_contact || has_separated || history.is_due(step) {
            let row = ledger.balance(self.model, state, &self.scratch, &contact);
            check_energy(&row, ledger.initial_relative, step)?;
            let kind = match (is_last_contact, is_first_contact || has_separated) {
                (_, true) => RowKind::Landmark,
                (true, _) => RowKind::LastContact,
                _ => RowKind::Regular,
            };
            history.push(row, kind);
        }
        let now = Instant {
            approach: log.approach,
            approach_rate: log.approach_rate,
            is_closed,
            is_first_contact,
            is_last_contact,
        };
        recorder.observe(self.model, state, &self.scratch, now);
        if has_separated {
            return Ok(Status::Separated);
        }
        if contact.at_limit {
            // A run that blows up throws its nodes about: that is not a large contact.
            let row = ledger.balance(self.model, state, &self.scratch, &contact);
            check_energy(&row, ledger.initial_relative, step)?;
            let radius = self.model.candidate_radius();
            return Err(Stop::ContactBeyondCandidates { time, step, radius });
        }
        if time - self.model.approach().first_touch() > *max_time {
            return Err(Stop::NoSeparation { time, step });
        }
        ledger.count_step(self.model, &self.scratch, contact.force);
        log.advance(self.model, &self.scratch);
        advance(self.model, state, &self.scratch);
        Ok(Status::UnderWay)
    }

    /// What came out: of a run that has separated, or that was stopped.
    pub fn finish(mut self, stopped: Option<Stop>) -> Collision {
        if stopped.is_some() {
            self.record_stop();
        }
        let Memory { state, log, ledger, history, recorder, .. } = self.memory;
        let is_complete = stopped.is_none();
        let rows = history.rows();
        let over_rows = |value: fn(&Row) -> Option<f64>| {
            Some(rows.iter().filter_map(value).fold(0.0, f64::max))
        };
        let velocity_after = rows.last().map(|row| row.velocity).filter(|_| is_complete);
        let vibration_energy =
            log.last_contact.filter(|_| is_complete).and_then(|last| vibration_after(rows, last));
        let speed = self.model.approach().speed();
        let restitution = velocity_after.map(|[lower, upper]| (upper - lower) / speed);
        let bodies = [0, 1].map(|side: usize| {
            let body = &self.model.bodies()[side];
            let is_sphere = body.mesh().is_some();
            BodyResult {
                elements: Some(body.n_elements()),
                nodes: Some(body.n_nodes()),
                mass: is_sphere.then(|| body.mass()),
                added_mass: is_sphere.then(|| body.added_mass()),
                velocity_after: velocity_after.map(|both| both[side]),
                vibration_energy: vibration_energy.filter(|_| is_sphere).map(|both| both[side]),
            }
        });
        let ends = log.first_contact.zip(log.last_contact);
        let (max_contact_radius, peak_pressure) =
            (over_rows(|row| row.contact_radius), over_rows(|row| row.centre_pressure));
        let (snapshots, warnings) = recorder.finish();
        Collision {
            approach: *self.model.approach(),
            ending: stopped.map_or(Ending::Parted, Ending::Stopped),
            restitution,
            // A contact that was left before its end has no duration.
            contact_time: ends.filter(|_| is_complete).map(|(first, last)| last - first),
            first_contact: log.first_contact,
            last_contact: log.last_contact,
            contact_episodes: log.episodes,
            peak_force: Some(log.peak_force),
            max_approach: Some(log.max_approach),
            max_contact_radius,
            peak_pressure,
            force_scatter: None,
            searched: Some(self.model.searched()),
            initial_energy: Some(ledger.initial),
            energies: rows.last().map_or(Book::EMPTY, |row| row.energies),
            residual: rows.last().and_then(|row| row.residual),
            residual_relative: Some(ledger.worst_residual),
            momentum_residual_relative: Some(ledger.worst_momentum),
            bodies,
            time_step: Some(self.model.time_step()),
            steps: Some(state.step),
            element_updates: Some(state.step * self.model.n_elements() as u64),
            factor_bytes: None,
            repeated_contact_solutions: None,
            history: history.into_rows(),
            snapshots,
            warnings,
        }
    }

    /// The state where the run stopped ends the history, if it is sound.
    fn record_stop(&mut self) {
        let Memory { state, ledger, history, .. } = &mut self.memory;
        if history.rows().last().is_some_and(|row| row.time == state.time) {
            return;
        }
        let contact = update_forces(self.model, state, &mut self.scratch);
        let row = ledger.balance(self.model, state, &self.scratch, &contact);
        if check_energy(&row, ledger.initial_relative, state.step).is_ok() {
            history.push(row, RowKind::Landmark);
        }
    }
}

/// Refuses a row whose energy is not finite or has grown beyond the initial, J.
fn check_energy(row: &Row, initial: f64, step: u64) -> Result<(), Stop> {
    let ratio = row.residual.map_or(f64::NAN, |residual| 1.0 + residual / initial);
    if ratio.is_finite() && ratio <= ENERGY_LIMIT {
        Ok(())
    } else {
        Err(Stop::EnergyGrowth { time: row.time, step, ratio })
    }
}

/// Energy left in the vibrations of both bodies after the last contact (s), J: twice the mean
/// kinetic energy relative to the mass centre, since half of a vibration's energy is kinetic.
fn vibration_after(rows: &[Row], last_contact: f64) -> Option<[f64; 2]> {
    let after = || rows.iter().filter(|row| row.time > last_contact);
    let n_after = after().count();
    (n_after > 0).then(|| {
        [0, 1].map(|side: usize| {
            2.0 * after().map(|row| row.vibration[side]).sum::<f64>() / n_after as f64
        })
    })
}

#[cfg(test)]
mod tests;
