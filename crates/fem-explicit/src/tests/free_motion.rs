//! Motion without contact: rigid flight, and what leapfrog conserves.

use fem_collision::{Account, Approach};
use fem_mesh::Side;

use crate::body::{BodyState, Clock};
use crate::model::ModelParts;
use crate::run::{advance, update_forces};
use crate::state::{Scratch, State};
use crate::test_support::{
    accounts, free_sphere, glass_sphere, ragged, settings, started, unit_glass, unit_sphere,
};
use crate::time::advance_motion;

#[test]
fn rigid_flight_strains_nothing() {
    let bodies = [Side::Below, Side::Above].map(|side| glass_sphere(8.0, side));
    let approach = Approach::new([0.3, -0.7], 1e3).unwrap();
    let (model, mut state) = started(bodies, approach, &settings(), ModelParts::default());
    // Back from first touch to the start.
    for body in &mut state.bodies {
        body.displacement.fill([0.0; 2]);
    }
    let mut scratch = Scratch::new(&model);
    for _ in 0..200 {
        let contact = update_forces(&model, &state, &mut scratch).unwrap();
        assert_eq!(contact.n_closed, 0);
        advance(&model, &mut state, &mut scratch);
    }
    for (side, velocity) in [0.3, -0.7].into_iter().enumerate() {
        let (body, state) = (&model.bodies()[side], &state.bodies[side]);
        assert!(scratch.forces[side].iter().flatten().all(|f| *f == 0.0));
        assert!(state.velocity.iter().all(|v| *v == [0.0, velocity]));
        assert!(state.displacement.iter().all(|u| *u == state.displacement[0]));
        assert_eq!(accounts(body, state).energies.get(Account::Strain), Some(0.0));
        // Two hundred roundings.
        let distance = 200.0 * model.time_step() * velocity;
        assert!((state.displacement[0][1] / distance - 1.0).abs() < 1e-13);
    }
}

/// ½ v_{n−½}·M v_{n+½} + ½ u_n·K u_n stays the same to rounding, and so does momentum, at any
/// step that is stable.
#[test]
fn leapfrog_conserves_energy_and_momentum() {
    for step_factor in [0.3, 1.0] {
        let mesh = unit_sphere(8.0, Side::Above);
        let velocity = ragged(&mesh, 2);
        let (model, mut state) = free_sphere(mesh, unit_glass(), step_factor);
        let body = &model.bodies()[1];
        state.bodies[1].velocity.copy_from_slice(&velocity);
        let mut scratch = Scratch::new(&model);
        let momentum = |state: &State| body.sum_mass(&state.bodies[1].velocity);
        let (mut first, start) = (None, momentum(&state));
        for _ in 0..1000 {
            update_forces(&model, &state, &mut scratch).unwrap();
            let before = state.clone();
            advance(&model, &mut state, &mut scratch);
            let kinetic: f64 = body
                .nodal_mass
                .iter()
                .zip(before.bodies[1].velocity.iter().zip(&state.bodies[1].velocity))
                .map(|(m, (v, w))| 0.5 * m * (v[0] * w[0] + v[1] * w[1]))
                .sum();
            let stored = accounts(body, &before.bodies[1]).energies.get(Account::Strain);
            let energy = kinetic + stored.unwrap();
            let first = *first.get_or_insert(energy);
            // A thousand steps' roundings of a few 1e-16, at random.
            assert!((energy / first - 1.0).abs() < 1e-13, "{energy} {first}");
        }
        let scale: f64 = body.nodal_mass.iter().zip(&velocity).map(|(m, v)| m * v[1].abs()).sum();
        assert!((momentum(&state) - start).abs() < 1e-13 * scale);
    }
}

/// The bound is 20 % below the critical step of the assembled body; beyond that the same motion
/// grows without limit.
#[test]
fn leapfrog_blows_up_beyond_the_critical_step() {
    let mesh = unit_sphere(8.0, Side::Above);
    let v = ragged(&mesh, 2);
    let (model, state) = free_sphere(mesh, unit_glass(), 1.0);
    let (body, [_, mut state]) = (&model.bodies()[1], state.bodies);
    let mut f = vec![[0.0; 2]; v.len()];
    state.velocity = v;
    let time_step = 1.4 * model.time_step();
    for _ in 0..1000 {
        let clock = Clock { time: 0.0, time_step };
        state.update_internal_forces(body, clock, &mut f).unwrap();
        let BodyState { displacement, velocity, .. } = &mut state;
        advance_motion(time_step, &body.inverse_mass, &f, velocity, displacement);
    }
    assert!(state.displacement.iter().flatten().any(|u| u.is_nan() || u.abs() > 1e20));
}
