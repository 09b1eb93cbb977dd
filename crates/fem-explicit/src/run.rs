//! A run from first touch to separation, as a stepper: whoever owns it decides when to go on.

use std::ops::Deref;

use fem_collision::{
    Collision, Ending, Expectation, FLIGHT_AFTER, Monitor, OutputRequest, Phase, Progress, RowKind,
    STEPS_BETWEEN_REPORTS, Stop,
};

use crate::contact_work::held_by;
use crate::error::ModelError;
use crate::memory::Memory;
use crate::model::Model;
use crate::outcome::outcome;
use crate::probing::Probing;
use crate::recorder::Instant;
use crate::state::{Scratch, State};
use crate::step::{Fault, advance, is_closed_next, update_forces, update_step};

/// Runs a model from first touch until the force has been zero for a fifth of
/// the contact time and the bodies recede.
///
/// Nothing is allocated inside a step, but for the states of snapshots until
/// their pool is filled.
pub fn collide(
    model: &Model,
    expected: Expectation,
    want: &OutputRequest,
    monitor: &mut dyn Monitor,
) -> Collision {
    monitor.enter(Phase::Collision);
    let mut run = Run::new(model, expected, want);
    while monitor.report(run.progress()) && run.advance(STEPS_BETWEEN_REPORTS).is_none() {}
    run.finish()
}

/// A run under way. Between two calls of [`Run::advance`] all that it knows is its [`Memory`].
///
/// It borrows its model or shares it: `M` is `&Model` or `Arc<Model>`.
///
/// ```
/// use fem_collision::{Approach, BodyInput, Ending, Expectation, OutputRequest};
/// use fem_explicit::{Model, Run, Settings};
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
/// #     mass_times: [1.0; 2],
/// # };
/// let bodies = [BodyInput::Sphere { mesh, material }, BodyInput::Wall];
/// let model = Model::new(bodies, Approach::at(0.5)?, &settings)?;
/// let expected = Expectation { contact_time: 80e-6, approach: 20e-6 };
/// let mut run = Run::new(&model, expected, &OutputRequest::quantities());
/// assert_eq!(run.advance(100), None);
/// // Stopped here, and gone on from what it knew, perhaps in another process.
/// let memory = run.memory().clone();
/// let mut resumed = Run::resume(&model, memory)?;
/// while resumed.advance(100).is_none() {}
/// let collision = resumed.finish();
/// assert_eq!(collision.ending, Ending::Parted);
/// assert!((collision.restitution.unwrap() - 1.0).abs() < 2e-3);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Run<M> {
    model: M,
    pub(crate) memory: Memory,
    scratch: Scratch,
    probing: Probing,
}

impl<M: Deref<Target = Model>> Run<M> {
    /// A run at first touch.
    pub fn new(model: M, expected: Expectation, want: &OutputRequest) -> Self {
        let (memory, scratch) = (Memory::new(&model, expected, want), Scratch::new(&model));
        let probing = Probing::new(&model, want);
        Self { model, memory, scratch, probing }
    }

    /// Goes on from a memory of a run of the same model; a run that had ended has ended.
    ///
    /// # Errors
    /// A memory of another model or version: other meshes, masses, materials, forces, contact, approach
    /// or time step. One whose parts contradict each other.
    pub fn resume(model: M, memory: Memory) -> Result<Self, ModelError> {
        if !memory.fits(&model) {
            return Err(ModelError::MemoryOfAnother);
        }
        let (scratch, probing) = (Scratch::new(&model), Probing::new(&model, memory.want()));
        Ok(Self { model, memory, scratch, probing })
    }

    /// What holds the model.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// All that the run knows.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// How far the run is.
    pub fn progress(&self) -> Progress {
        let Memory { state, log, expected, .. } = &self.memory;
        let length = (1.0 + FLIGHT_AFTER) * expected.contact_time;
        let elapsed = state.time - self.model.approach().first_touch();
        Progress {
            time: state.time,
            step: state.step,
            fraction: Progress::share(elapsed, length),
            contact_force: log.force,
        }
    }

    /// At most so many steps. How the run ended, once it has: then there is no step any more.
    pub fn advance(&mut self, n_steps: u64) -> Option<&Ending> {
        let Self { model, memory, scratch, probing } = self;
        advance_run(model, memory, (scratch, probing), n_steps);
        memory.ending.as_ref()
    }

    /// What came out so far. A run that has not ended is interrupted here.
    pub fn finish(self) -> Collision {
        let Self { model, mut memory, mut scratch, .. } = self;
        let ending = memory.ending.take().unwrap_or_else(|| {
            let (time, step) = (memory.state.time, memory.state.step);
            Ending::Stopped(Stop::Interrupted { time, step })
        });
        if let Ending::Stopped(_) = ending {
            record_stop(&model, &mut memory, &mut scratch);
        }
        outcome(&model, memory, ending)
    }
}

/// At most so many steps of a run that has not ended; none of one that has.
fn advance_run(
    model: &Model,
    memory: &mut Memory,
    (scratch, probing): (&mut Scratch, &mut Probing),
    n_steps: u64,
) {
    for _ in 0..n_steps {
        if memory.ending.is_some() {
            return;
        }
        memory.ending = match step(model, memory, scratch, probing) {
            Ok(ending) => ending.inspect(|_| memory.sound.forget()),
            Err(stop) => Some(Ending::Stopped(stop)),
        };
    }
}

/// Forces of the present configuration, what is observed of it, and the motion to the next; or how the
/// run has ended instead.
fn step(
    model: &Model,
    memory: &mut Memory,
    scratch: &mut Scratch,
    probing: &mut Probing,
) -> Result<Option<Ending>, Stop> {
    let (max_time, most_updates) = (memory.max_time(), memory.want().most_element_updates);
    let Memory {
        state, log, ledger, observed, history, recorder, probes, sound, stability, ..
    } = memory;
    let mut stop = |fault: Fault, state: &State| {
        let of_law = matches!(fault, Fault::Collapsed(_)).then(|| stability.why(model, state));
        of_law.flatten().unwrap_or_else(|| model.stop(fault, state))
    };
    let contact = update_forces(model, state, scratch)
        .map_err(|collapsed| stop(Fault::Collapsed(collapsed), state))?;
    ledger.follow(model, state, scratch, &contact).map_err(|grown| model.stop_of(grown, state))?;
    if let Some(shorter) = update_step(model, state, scratch).map_err(|at| stop(at, state))? {
        ledger.push(model, scratch, contact.force, shorter);
        log.force = contact.force;
        log.push(model, scratch, shorter);
    }
    let (time, step) = (state.time, state.step);
    let is_closed = contact.n_closed > 0;
    let is_first_contact = is_closed && log.first_contact.is_none();
    let is_last_contact = is_closed
        && contact.force < 0.5 * log.peak_force
        && !is_closed_next(model, state, scratch, &contact);
    log.observe(time, step, &contact);
    if is_closed {
        observed.touch();
    }
    let has_separated = log.has_separated(time, model.gravity());
    // At the limit too: a run that blows up throws its nodes about, which is not a large contact, and
    // its balance tells.
    let is_beyond = contact.at_limit || contact.turn.is_some();
    let kind = match (is_last_contact, is_first_contact || has_separated || is_beyond) {
        (_, true) => RowKind::Landmark,
        (true, _) => RowKind::LastContact,
        _ => RowKind::Regular,
    };
    let is_landmark = kind != RowKind::Regular;
    let mut history = history.as_mut().filter(|history| is_landmark || history.is_due(step));
    let mut stays_together = false;
    if is_landmark || observed.is_due(step) {
        let row = ledger.balance(model, state, scratch, &contact);
        ledger.check(&row, step).map_err(|grown| model.stop_of(grown, state))?;
        observed.take(row, ledger.impulse(), step, is_closed);
        probing.observe(probes, model, state, scratch, log.approach);
        if ledger.adds_up() {
            sound.observe(model, state, scratch, log.approach);
        }
        stability.observe(model, state, ledger.adds_up())?;
        if let Some(history) = &mut history {
            history.push(row, kind);
        }
        let since_touch = time - model.approach().first_touch();
        stays_together = observed.stays_together(model, is_closed, since_touch, log.approach_rate);
    } else if let Some(history) = &mut history {
        // One row more than what is observed, of which nothing else knows.
        let row = ledger.clone().balance(model, state, scratch, &contact);
        if ledger.check(&row, step).is_ok() {
            history.push(row, kind);
        }
    }
    let now = Instant {
        approach: log.approach,
        approach_rate: log.approach_rate,
        is_closed,
        is_first_contact,
        is_last_contact,
        stays_together,
    };
    recorder.observe(model, state, scratch, now);
    if has_separated {
        return Ok(Some(Ending::Parted));
    }
    if stays_together {
        return Ok(Some(Ending::Together));
    }
    if let Some(turn) = contact.turn {
        return Err(model.stop_of_turn(turn, state));
    }
    if contact.at_limit {
        return Err(Stop::ContactBeyondCandidates { time, step, radius: model.candidate_radius() });
    }
    if time - model.approach().first_touch() > max_time {
        return Err(match log.first_contact {
            Some(_) => Stop::NoSeparation { time, step },
            None => Stop::NoContact { time, step, approach: log.approach },
        });
    }
    let element_updates = step.saturating_mul(model.n_elements() as u64);
    if element_updates >= most_updates {
        return Err(Stop::TooManyUpdates { time, step, element_updates });
    }
    let time_step = state.time_step(model);
    ledger.push(model, scratch, contact.force, time_step);
    log.advance(model, scratch, time_step);
    let held = held_by(model, state, &contact);
    advance(model, state, scratch);
    ledger.begin_step(model, held, time_step, state, scratch, contact.force);
    Ok(None)
}

/// The state where the run stopped ends what is observed and the history, and is the last sound one, if it
/// is sound.
fn record_stop(model: &Model, memory: &mut Memory, scratch: &mut Scratch) {
    let Memory { state, log, ledger, observed, history, sound, .. } = memory;
    if let Ok(contact) = update_forces(model, state, scratch) {
        if observed.last.is_none_or(|row| row.time < state.time) {
            let row = ledger.balance(model, state, scratch, &contact);
            if ledger.check(&row, state.step).is_ok() {
                observed.take(row, ledger.impulse(), state.step, contact.n_closed > 0);
            }
        }
        if ledger.adds_up() && observed.last.is_some_and(|row| row.time == state.time) {
            sound.keep(model, state, scratch, log.approach);
        }
    }
    if let (Some(history), Some(row)) = (history, observed.last)
        && history.rows().last().is_none_or(|last| last.time < row.time)
    {
        history.push(row, RowKind::Landmark);
    }
}

#[cfg(test)]
mod tests;
