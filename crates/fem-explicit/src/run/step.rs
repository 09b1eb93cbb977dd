//! One step of a run, as a list of its phases.

use fem_collision::{Ending, RowKind, StepInstant, Stop};
use fem_contact::ContactForces;

use super::phases::{advance, is_closed_next, update_forces, update_time_step};
use super::restart_state::RunState;
use super::stops::{Fault, stop_of_growth, stop_of_turn};
use crate::energy::held_by;
use crate::model::ExplicitBodies;
use crate::snapshots::{Instant, Probing};
use crate::state::Scratch;

/// Takes a step: forces of the present configuration, their energy, the time step, observation and records of this
/// instant, and the motion to the next one. Returns the ending of a run that ends here instead.
pub(super) fn step(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &mut Scratch,
    probing: &mut Probing,
) -> Result<Option<Ending>, Stop> {
    let contact = update_forces(model, &run.state, scratch)
        .map_err(|collapsed| stop_of_fault(run, model, Fault::Collapsed(collapsed)))?;
    run.ledger
        .follow(model, &run.state, scratch, &contact)
        .map_err(|growth| stop_of_growth(model, growth, &run.state))?;
    control_time_step(run, model, scratch, contact.force)?;
    let mut instant = observe_contact(run, model, scratch, &contact);
    sample(run, model, scratch, probing, &contact, &mut instant)?;
    run.recorder.observe(model, &run.state, scratch, instant);
    if let Some(ending) = ending(run, model, &contact, instant)? {
        return Ok(Some(ending));
    }
    move_on(run, model, scratch, &contact);
    Ok(None)
}

/// Returns the stop of a run that cannot take a step: a material instability, if a collapse follows from one.
fn stop_of_fault(run: &mut RunState, model: &ExplicitBodies, fault: Fault) -> Stop {
    let unstable = matches!(fault, Fault::Collapsed(_))
        .then(|| run.stability.stop_of_collapse(model, &run.state));
    unstable.flatten().unwrap_or_else(|| fault.stop(model, &run.state))
}

/// Changes the time step where that is due; impulses up to half a step before t_n change with it.
fn control_time_step(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &mut Scratch,
    force: f64,
) -> Result<(), Stop> {
    let changed = update_time_step(model, &mut run.state, scratch)
        .map_err(|fault| stop_of_fault(run, model, fault))?;
    if let Some(shorter) = changed {
        run.ledger.push(model, scratch, force, shorter);
        run.log.force = force;
        run.log.push(model, scratch, shorter);
    }
    Ok(())
}

/// Enters the contact into the log. Returns what the next phases need of this instant.
fn observe_contact(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &Scratch,
    contact: &ContactForces,
) -> Instant {
    let RunState { state, log, sampled, .. } = run;
    let is_closed = contact.n_closed > 0;
    let is_first_contact = is_closed && log.first_contact.is_none();
    let is_last_contact = is_closed
        && contact.force < 0.5 * log.peak_force
        && !is_closed_next(model, state, scratch, contact);
    log.observe(state.time, state.step, contact);
    if is_closed {
        sampled.touch();
    }
    Instant {
        approach: log.approach,
        approach_rate: log.approach_rate,
        is_closed,
        is_first_contact,
        is_last_contact,
        has_separated: log.has_separated(state.time, model.gravity()),
        stays_together: false,
    }
}

/// Balances the energy of sampled instants, feeds all that is derived from them, and writes a row of the history where
/// one is due. Finds out whether the bodies stay together.
fn sample(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &Scratch,
    probing: &mut Probing,
    contact: &ContactForces,
    instant: &mut Instant,
) -> Result<(), Stop> {
    let kind = row_kind(contact, *instant);
    let is_landmark = kind != RowKind::Regular;
    let RunState { state, ledger, sampled, history, probes, last_valid, stability, .. } = run;
    let step = state.step;
    let mut history = history.as_mut().filter(|history| is_landmark || history.is_due(step));
    if is_landmark || sampled.is_due(step) {
        let row = ledger.balance(model, state, scratch, contact);
        ledger.check(&row, step).map_err(|growth| stop_of_growth(model, growth, state))?;
        sampled.take(row, ledger.impulse(), step, instant.is_closed);
        probing.observe(probes, model, state, scratch, instant.approach);
        if ledger.adds_up() {
            last_valid.observe(model, state, scratch, instant.approach);
        }
        stability.observe(model, state, ledger.adds_up())?;
        if let Some(history) = &mut history {
            history.push(row, kind);
        }
        let since_touch = state.time - model.approach().first_touch();
        instant.stays_together =
            sampled.stays_together(model, instant.is_closed, since_touch, instant.approach_rate);
    } else if let Some(history) = &mut history {
        // A row of the history alone: a balance that leaves the ledger as it is.
        let row = ledger.clone().balance(model, state, scratch, contact);
        if ledger.check(&row, step).is_ok() {
            history.push(row, kind);
        }
    }
    Ok(())
}

/// Returns the kind of a row. An instant at a limit of the contact is a landmark too: there the balance shows whether
/// the nodes of an unstable run have reached the limit, or a large contact.
fn row_kind(contact: &ContactForces, instant: Instant) -> RowKind {
    let is_at_limit = contact.at_limit || contact.fold.is_some();
    let is_landmark = instant.is_first_contact || instant.has_separated || is_at_limit;
    match (instant.is_last_contact, is_landmark) {
        (_, true) => RowKind::Landmark,
        (true, _) => RowKind::LastContact,
        _ => RowKind::Regular,
    }
}

/// Returns the ending of a run that ends at this instant.
fn ending(
    run: &RunState,
    model: &ExplicitBodies,
    contact: &ContactForces,
    instant: Instant,
) -> Result<Option<Ending>, Stop> {
    let (time, step) = (run.state.time, run.state.step);
    let at = StepInstant { time, step };
    if instant.has_separated {
        return Ok(Some(Ending::Parted));
    }
    if instant.stays_together {
        return Ok(Some(Ending::Together));
    }
    if let Some(turn) = contact.fold {
        return Err(stop_of_turn(model, turn, &run.state));
    }
    if contact.at_limit {
        return Err(Stop::ContactBeyondCandidates { at, radius: model.candidate_radius() });
    }
    if time - model.approach().first_touch() > run.max_time() {
        return Err(match run.log.first_contact {
            Some(_) => Stop::NoSeparation { at },
            None => Stop::NoContact { at, approach: instant.approach },
        });
    }
    let element_updates = step.saturating_mul(model.n_elements() as u64);
    if element_updates >= run.request().most_element_updates {
        return Err(Stop::TooManyUpdates { at, element_updates });
    }
    Ok(None)
}

/// Moves the bodies to the next instant, and counts the impulses of the step.
fn move_on(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &mut Scratch,
    contact: &ContactForces,
) {
    let RunState { state, log, ledger, .. } = run;
    let time_step = state.time_step(model);
    ledger.push(model, scratch, contact.force, time_step);
    log.advance(model, scratch, time_step);
    let held = held_by(model, state, contact);
    advance(model, state, scratch);
    ledger.since.begin_step(model, held, time_step, state, scratch, contact.force);
}

/// Records the state in which a run has stopped: it ends the samples and the history, and is the last valid state if
/// its energy adds up.
pub(super) fn record_stop(run: &mut RunState, model: &ExplicitBodies, scratch: &mut Scratch) {
    let RunState { state, log, ledger, sampled, history, last_valid, .. } = run;
    if let Ok(contact) = update_forces(model, state, scratch) {
        if sampled.last.is_none_or(|row| row.time < state.time) {
            let row = ledger.balance(model, state, scratch, &contact);
            if ledger.check(&row, state.step).is_ok() {
                sampled.take(row, ledger.impulse(), state.step, contact.n_closed > 0);
            }
        }
        if ledger.adds_up() && sampled.last.is_some_and(|row| row.time == state.time) {
            last_valid.keep(model, state, scratch, log.approach);
        }
    }
    if let (Some(history), Some(row)) = (history, sampled.last)
        && history.rows().last().is_none_or(|last| last.time < row.time)
    {
        history.push(row, RowKind::Landmark);
    }
}
