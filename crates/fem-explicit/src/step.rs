//! The phases of a time step.

use fem_contact::ContactForces;
use fem_material::ActsOn;

use crate::body::Body;
use crate::kernel::{subtract_internal_forces, subtract_split_internal_forces};
use crate::model::Model;
use crate::nodes::{advance_branch, advance_motion, start_effective};
use crate::state::{BodyState, Scratch, State};

/// Forces of the present configuration: internal, then contact.
pub(crate) fn update_forces(model: &Model, state: &State, scratch: &mut Scratch) -> ContactForces {
    for side in 0..2 {
        update_internal_forces(
            &model.bodies()[side],
            &state.bodies[side],
            &mut scratch.forces[side],
        );
    }
    let [lower, upper] = &mut scratch.forces;
    model.interface().add_forces([&state.bodies[0].u, &state.bodies[1].u], [lower, upper])
}

/// Moves both bodies to the next time.
pub(crate) fn advance(model: &Model, state: &mut State, scratch: &Scratch) {
    for side in 0..2 {
        advance_body(
            &model.bodies()[side],
            model.time_step(),
            &mut state.bodies[side],
            &scratch.forces[side],
        );
    }
    state.step += 1;
    state.time = model.approach().first_touch() + state.step as f64 * model.time_step();
}

/// Whether the next configuration is in contact; reads the forces of the
/// present one and moves nothing.
pub(crate) fn is_closed_next(model: &Model, state: &State, scratch: &Scratch) -> bool {
    let time_step = model.time_step();
    let next = |side: usize| {
        let (body, forces) = (&model.bodies()[side], &scratch.forces[side]);
        let BodyState { u, v, .. } = &state.bodies[side];
        move |node: u32| {
            let k = node as usize;
            let velocity = v[k][1] + time_step * (body.inverse_mass[k][1] * forces[k][1]);
            u[k][1] + time_step * velocity
        }
    };
    model.interface().is_closed([next(0), next(1)])
}

/// Internal forces alone, by their sign on the nodes.
pub(crate) fn update_internal_forces(body: &Body, state: &BodyState, forces: &mut [[f64; 2]]) {
    forces.fill([0.0; 2]);
    match &body.relaxation {
        None => subtract_internal_forces(&body.blocks, body.moduli, &state.u, forces),
        Some(relaxation) => match relaxation.acts_on {
            ActsOn::All => subtract_internal_forces(&body.blocks, body.moduli, &state.w, forces),
            ActsOn::Shear => subtract_split_internal_forces(
                &body.blocks,
                body.moduli,
                &state.u,
                &state.w,
                forces,
            ),
        },
    }
}

/// Moves one body to the next time.
pub(crate) fn advance_body(
    body: &Body,
    time_step: f64,
    state: &mut BodyState,
    forces: &[[f64; 2]],
) {
    advance_motion(time_step, &body.inverse_mass, forces, &mut state.v, &mut state.u);
    if let Some(relaxation) = &body.relaxation {
        start_effective(relaxation.equilibrium_weight, &state.u, &mut state.w);
        for (branch, q) in relaxation.branches.iter().zip(&mut state.q) {
            let gain = branch.gain * time_step;
            advance_branch(branch.decay, gain, branch.weight, &state.v, q, &mut state.w);
        }
    }
}

impl BodyState {
    /// w = g∞ u + Σ g_k q_k.
    pub(crate) fn update_effective(&mut self, body: &Body) {
        if let Some(relaxation) = &body.relaxation {
            start_effective(relaxation.equilibrium_weight, &self.u, &mut self.w);
            for (branch, q) in relaxation.branches.iter().zip(&mut self.q) {
                advance_branch(1.0, 0.0, branch.weight, &self.v, q, &mut self.w);
            }
        }
    }
}
