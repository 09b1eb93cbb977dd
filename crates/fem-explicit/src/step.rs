//! The phases of a time step.

use fem_contact::ContactForces;

use crate::body::Body;
use crate::model::Model;
use crate::motion::{advance_motion, push};
use crate::pace::Pace;
use crate::part::{Field, Motion, NodalField};
use crate::state::{BodyState, Clock, Scratch, State};
use crate::stress::Collapse;

/// A body with an element that its stress cannot follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Collapsed {
    /// 0 lower, 1 upper.
    pub side: usize,
    pub collapse: Collapse,
}

/// Why a step cannot be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    Collapsed(Collapsed),
    /// No step is short enough for what holds a node: the contact, or else its elements.
    TooStiff {
        /// 0 lower, 1 upper.
        side: usize,
        node: usize,
        is_of_contact: bool,
    },
}

/// Forces of the present configuration: of stress, on the nodes, of contact, of what holds a body.
///
/// # Errors
/// An element has collapsed: there are no forces.
pub(crate) fn update_forces(
    model: &Model,
    state: &State,
    scratch: &mut Scratch,
) -> Result<ContactForces, Collapsed> {
    let motions = state.motions(model);
    for side in 0..2 {
        let (body, motion) = (&model.bodies()[side], &motions[side]);
        let (history, forces) = (&state.bodies[side].history, &mut scratch.forces[side]);
        update_internal_forces(body, motion, history, forces)
            .map_err(|collapse| Collapsed { side, collapse })?;
        scratch.resultants[side] = body.add_node_forces(motion, history, forces);
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

/// Bounds the critical step of the present configuration, whose forces are in `scratch`, where that is
/// due, and changes the step; the time (s) by which half a step is shorter than before.
///
/// # Errors
/// No step is short enough.
pub(crate) fn update_step(
    model: &Model,
    state: &mut State,
    scratch: &mut Scratch,
) -> Result<Option<f64>, Fault> {
    let Some(pace) = state.pace.filter(|pace| pace.is_look_due(state.step)) else {
        return Ok(None);
    };
    if !pace.is_due(state.step)
        && let Some(same) = pace.looked_at(model, state.step, model.strain_rate(state))
    {
        state.pace = Some(same);
        return Ok(None);
    }
    let outlook = model.outlook(state, scratch);
    let now = (state.step, state.time);
    let Some(next) = pace.after(model, now, outlook) else {
        return Err(model.fault(state, scratch));
    };
    state.pace = Some(next);
    let [before, after] = [&pace, &next].map(|pace: &Pace| pace.time_step(model));
    if before == after {
        return Ok(None);
    }
    let shorter = 0.5 * (before - after);
    for (side, body) in model.bodies().iter().enumerate() {
        push(shorter, &body.inverse_mass, &scratch.forces[side], &mut state.bodies[side].velocity);
    }
    Ok(Some(shorter))
}

/// Takes both bodies to the next time: the nodes, what stress remembers, the nodes that have no mass
/// and what contact remembers, then what forces remember.
pub(crate) fn advance(model: &Model, state: &mut State, scratch: &mut Scratch) {
    state.time = state.time_after(state.step + 1, model);
    state.step += 1;
    let clock = state.clock(model);
    for side in 0..2 {
        let (body, forces) = (&model.bodies()[side], &scratch.forces[side]);
        advance_nodes(body, clock.time_step, &mut state.bodies[side], forces);
        advance_stress(body, clock, &mut state.bodies[side]);
    }
    advance_contact(model, state, scratch);
    for side in 0..2 {
        advance_node_forces(&model.bodies()[side], clock, &mut state.bodies[side]);
    }
}

/// Whether the next configuration is in contact; reads the forces of the
/// present one and moves nothing.
pub(crate) fn is_closed_next(
    model: &Model,
    state: &State,
    scratch: &Scratch,
    now: &ContactForces,
) -> bool {
    let time_step = state.time_step(model);
    let next = |side: usize| {
        let (inverse_mass, forces) = (&model.bodies()[side].inverse_mass, &scratch.forces[side]);
        let BodyState { displacement, velocity, .. } = &state.bodies[side];
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

/// Internal forces alone, by their sign on the nodes.
///
/// # Errors
/// An element has collapsed.
pub(crate) fn update_internal_forces(
    body: &Body,
    motion: &Motion<'_>,
    history: &[NodalField],
    forces: &mut Field,
) -> Result<(), Collapse> {
    forces.fill([0.0; 2]);
    match &body.stress {
        Some(stress) => stress.part.subtract_forces(motion, stress.of(history), forces),
        None => Ok(()),
    }
}

/// Moves the nodes of a body by a time step (s).
pub(crate) fn advance_nodes(body: &Body, time_step: f64, state: &mut BodyState, forces: &Field) {
    let BodyState { displacement, velocity, .. } = state;
    advance_motion(time_step, &body.inverse_mass, forces, velocity, displacement);
}

/// What the contact does at the end of a step that the nodes have done.
fn advance_contact(model: &Model, state: &mut State, scratch: &mut Scratch) {
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

/// What the stress of a body remembers of a step that the nodes have done, at its end.
pub(crate) fn advance_stress(body: &Body, clock: Clock, state: &mut BodyState) {
    let BodyState { displacement, velocity, history } = state;
    let Clock { time, time_step } = clock;
    let nodal_mass = &body.nodal_mass;
    let motion = Motion { time, time_step, displacement, velocity, nodal_mass };
    if let Some(stress) = body.stress.as_ref().filter(|stress| stress.has_history()) {
        stress.part.advance(&motion, stress.of_mut(history));
    }
}

/// What the forces on the nodes of a body remember of a step; the time (s) is its end.
pub(crate) fn advance_node_forces(body: &Body, clock: Clock, state: &mut BodyState) {
    let BodyState { displacement, velocity, history } = state;
    let Clock { time, time_step } = clock;
    let nodal_mass = &body.nodal_mass;
    let motion = Motion { time, time_step, displacement, velocity, nodal_mass };
    for force in body.node_forces.iter().filter(|force| force.has_history()) {
        force.part.advance(&motion, force.of_mut(history));
    }
}
