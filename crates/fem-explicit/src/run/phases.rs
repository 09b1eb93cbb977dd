//! The phases of a time step that change the state: forces, step control, and the motion to the next instant.

use fem_contact::ContactForces;

use super::current_critical_step::{fault, step_demand, strain_rate};
use super::stops::{CollapsedElement, Fault};
use crate::model::ExplicitBodies;
use crate::state::{Scratch, State};
use crate::time::{StepControl, add_impulse};

/// Computes the forces in the present configuration: internal forces, node forces, contact forces, and the reactions of
/// held bodies.
pub(crate) fn update_forces(
    model: &ExplicitBodies,
    state: &State,
    scratch: &mut Scratch,
) -> Result<ContactForces, CollapsedElement> {
    let (motions, clock) = (state.motions(model), state.clock(model));
    for (side, body) in model.bodies().iter().enumerate() {
        let (of_body, forces) = (&state.bodies[side], &mut scratch.forces[side]);
        of_body
            .update_internal_forces(body, clock, forces)
            .map_err(|collapse| CollapsedElement { side, collapse })?;
        scratch.resultants[side] = body.add_node_forces(&motions[side], &of_body.history, forces);
    }
    let sides = scratch.pushed.iter_mut().zip(&scratch.forces);
    sides.for_each(|(pushed, forces)| pushed.begin(forces));
    let [lower, upper] = &mut scratch.forces;
    let contact =
        model.contact().add_forces(&motions, state.contact_history(model), [lower, upper]);
    let sides = scratch.pushed.iter_mut().zip(&scratch.forces);
    sides.for_each(|(pushed, forces)| pushed.end(forces));
    for (side, body) in model.bodies().iter().enumerate().filter(|(_, body)| body.held) {
        scratch.resultants[side] += body.hold(&mut scratch.forces[side]);
    }
    Ok(contact)
}

/// Controls the time step of a model whose stiffness changes: checks the strain rate or bounds the critical step when that
/// is due, with the present forces in `scratch`. Returns half the decrease of the time step (s) if it changes.
pub(crate) fn update_time_step(
    model: &ExplicitBodies,
    state: &mut State,
    scratch: &mut Scratch,
) -> Result<Option<f64>, Fault> {
    let step = state.step;
    let due = state.step_control.filter(|control| control.is_rate_check_due(step));
    let Some(control) = due else { return Ok(None) };
    let model_step = model.time_step();
    if !control.is_bound_due(step)
        && let Some(same) = control.after_rate_check(step, strain_rate(model, state), model_step)
    {
        state.step_control = Some(same);
        return Ok(None);
    }
    let demand = step_demand(model, state, scratch);
    let (now, settings) = ((step, state.time), [model_step, model.step_factor()]);
    let Some(next) = control.after_bound(demand, now, settings) else {
        return Err(fault(model, state, scratch));
    };
    state.step_control = Some(next);
    let [before, after] =
        [&control, &next].map(|control: &StepControl| control.time_step(model_step));
    if before == after {
        return Ok(None);
    }
    let shorter = 0.5 * (before - after);
    for (side, body) in model.bodies().iter().enumerate() {
        let velocity = &mut state.bodies[side].velocity;
        add_impulse(shorter, &body.inverse_mass, &scratch.forces[side], velocity);
    }
    Ok(Some(shorter))
}

/// Takes both bodies to the next instant: the nodes, the history of the stress, the nodes without mass and the history
/// of the contact, then the history of the forces on nodes.
pub(crate) fn advance(model: &ExplicitBodies, state: &mut State, scratch: &mut Scratch) {
    state.time = state.time_after(state.step + 1, model);
    state.step += 1;
    let clock = state.clock(model);
    for (side, body) in model.bodies().iter().enumerate() {
        state.bodies[side].advance_nodes(body, clock.time_step, &scratch.forces[side]);
        state.bodies[side].advance_stress(body, clock);
    }
    advance_contact(model, state, scratch);
    for (side, body) in model.bodies().iter().enumerate() {
        state.bodies[side].advance_node_forces(body, clock);
    }
}

/// Takes the contact to the end of a step in which the nodes have moved.
fn advance_contact(model: &ExplicitBodies, state: &mut State, scratch: &mut Scratch) {
    if !model.contact_advances {
        return;
    }
    let clock = state.clock(model);
    let [lower, upper] = model.bodies();
    let [state_of_lower, state_of_upper] = &mut state.bodies;
    let (lower_motion, lower_history) = state_of_lower.split_contact(lower, clock);
    let (upper_motion, upper_history) = state_of_upper.split_contact(upper, clock);
    let (motions, history) = ([lower_motion, upper_motion], [lower_history, upper_history]);
    model.contact().advance(motions, history, scratch.contact.as_mut());
}

/// Returns whether the next configuration is in contact; reads the present forces and moves nothing.
pub(crate) fn is_closed_next(
    model: &ExplicitBodies,
    state: &State,
    scratch: &Scratch,
    now: &ContactForces,
) -> bool {
    let time_step = state.time_step(model);
    let next = |side: usize| {
        let (inverse_mass, forces) = (&model.bodies()[side].inverse_mass, &scratch.forces[side]);
        let (displacement, velocity) =
            (&state.bodies[side].displacement, &state.bodies[side].velocity);
        move |node: u32| {
            let k = node as usize;
            [0, 1].map(|axis: usize| {
                let change = time_step * (inverse_mass[k][axis] * forces[k][axis]);
                displacement[k][axis] + time_step * (velocity[k][axis] + change)
            })
        }
    };
    model.contact().is_closed_next(now, [&next(0), &next(1)], state.contact_history(model))
}
