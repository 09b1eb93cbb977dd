//! The critical time step of deformed bodies, and the fault where no step is short enough.

use std::f64::consts::SQRT_2;

use super::stops::{CollapsedElement, Fault};
use crate::model::ExplicitBodies;
use crate::state::{Scratch, State};
use crate::stress::Collapse;
use crate::time::StepDemand;

/// Returns the largest present strain rate (1/s) of an element at finite strain.
pub(crate) fn strain_rate(model: &ExplicitBodies, state: &State) -> f64 {
    let motions = state.motions(model);
    let rates = model.bodies().iter().zip(&motions);
    let rates = rates.filter_map(|(body, motion)| Some(body.finite_strain()?.strain_rate(motion)));
    rates.fold(0.0, f64::max)
}

/// Returns what the deformed bodies demand of the time step; `scratch` holds the bounds that it is made of.
pub(crate) fn step_demand(
    model: &ExplicitBodies,
    state: &State,
    scratch: &mut Scratch,
) -> StepDemand {
    demand_and_node(model, state, scratch).0
}

/// Returns the demand, and the side and the node with the shortest critical step.
fn demand_and_node(
    model: &ExplicitBodies,
    state: &State,
    scratch: &mut Scratch,
) -> (StepDemand, [usize; 2]) {
    let motions = state.motions(model);
    let strain_rate = strain_rate(model, state);
    let within = StepDemand::longest_pause(model.time_step(), strain_rate);
    let (mut critical, mut node) = (f64::INFINITY, [0, 0]);
    for (side, body) in model.bodies().iter().enumerate() {
        let (stiffness, damping) = (&mut scratch.stiffness[side], &mut scratch.damping[side]);
        let Some(bound) = &body.bound else { continue };
        stiffness.fill(0.0);
        // A body at small strain, or a rigid one, has the growth of the contact alone.
        if let (Some(placed), Some(stress)) = (&body.stress, body.finite_strain()) {
            let history = placed.of(&state.bodies[side].history);
            stress.add_stiffness_bound(&motions[side], history, stiffness);
        }
        damping.fill(0.0);
        model.contact().add_bound_growth(&motions, within, side, stiffness, damping);
        let (own, at) = bound.current_critical_step(&body.nodal_mass, stiffness, damping);
        if own < critical || own.is_nan() {
            (critical, node) = (own, [side, at]);
        }
    }
    let rates = model.bodies().iter().enumerate().filter_map(|(side, body)| {
        let stress = body.finite_strain()?;
        // The bounds have been replaced by the critical steps of the nodes.
        let allowances = &mut scratch.stiffness[side];
        for step in allowances.iter_mut() {
            *step = StepDemand::strain_allowance(*step, critical);
        }
        Some(stress.allowance_rate(&motions[side], allowances))
    });
    let allowance_rate = rates.fold(0.0, f64::max);
    (StepDemand { critical_time_step: critical, strain_rate, allowance_rate }, node)
}

/// Returns the fault where no step is short enough: the most compressed element if the critical node is one of its
/// corners, otherwise the stiffness at that node.
pub(crate) fn fault(model: &ExplicitBodies, state: &State, scratch: &mut Scratch) -> Fault {
    let (demand, [side, node]) = demand_and_node(model, state, scratch);
    let body = &model.bodies()[side];
    let (stiffness, damping) = (&mut scratch.stiffness[side], &mut scratch.damping[side]);
    stiffness.fill(0.0);
    damping.fill(0.0);
    let mut without_contact = f64::INFINITY;
    if let (Some(bound), Some(placed)) = (&body.bound, &body.stress) {
        if let Some(stress) = body.finite_strain() {
            let history = placed.of(&state.bodies[side].history);
            stress.add_stiffness_bound(&state.motions(model)[side], history, stiffness);
        }
        without_contact = bound.current_critical_step(&body.nodal_mass, stiffness, damping).0;
    }
    // The contact has more of the stiffness than the elements.
    let is_of_contact = without_contact > SQRT_2 * demand.critical_time_step;
    let collapsed = most_compressed(model, state);
    let is_corner = model.bodies()[collapsed.side].mesh().is_some_and(|mesh| {
        let quad = mesh.quads().get(collapsed.collapse.element);
        collapsed.side == side && quad.is_some_and(|quad| quad.contains(&(node as u32)))
    });
    match is_corner && !is_of_contact {
        true => Fault::Collapsed(collapsed),
        false => Fault::TooStiff { side, node, is_of_contact },
    }
}

/// Returns the most compressed element of a model at finite strain.
fn most_compressed(model: &ExplicitBodies, state: &State) -> CollapsedElement {
    let of = |side: usize| {
        let stress = model.bodies()[side].finite_strain()?;
        let collapse = stress.most_compressed(&state.bodies[side].displacement);
        Some(CollapsedElement { side, collapse })
    };
    let ratio = |at: &CollapsedElement| at.collapse.volume_ratio;
    let most = [0, 1].into_iter().filter_map(of).min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    let none = Collapse { element: 0, volume_ratio: f64::NAN };
    most.unwrap_or(CollapsedElement { side: 0, collapse: none })
}
