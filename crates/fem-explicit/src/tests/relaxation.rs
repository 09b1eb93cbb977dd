//! Prony branches through the whole step.

use fem_collision::{Account, BodyFields};
use fem_material::{ActsOn, ElasticModuli, Material};
use fem_mesh::Side;

use crate::body::Body;
use crate::run::{advance, update_forces};
use crate::state::{Scratch, State};
use crate::stress::Moduli;
use crate::test_support::{
    accounts, assembled, free_sphere, moduli, relaxing_glass, unit_sphere, vector,
};

const TERMS: [(f64, f64); 3] = [(0.3, 0.02), (0.4, 0.3), (0.1, 5.0)];

/// Returns a sphere with an instantaneous uniform strain, which all branches have.
fn strained(material: Material) -> (crate::ExplicitBodies, State) {
    let mesh = unit_sphere(8.0, Side::Above);
    let u: Vec<_> = mesh.nodes().iter().map(|&[r, y]| [0.02 * r, -0.01 * y]).collect();
    let (model, mut state) = free_sphere(mesh, material, 0.9);
    let state_of_body = &mut state.bodies[1];
    let stress = model.bodies()[1].stress.as_ref().unwrap();
    stress.part.start_deformed(&u, &mut state_of_body.history);
    state_of_body.displacement = u;
    (model, state)
}

/// Takes steps in which nothing moves, and returns the forces of the last state.
fn hold(model: &crate::ExplicitBodies, state: &mut State, n: usize) -> Vec<[f64; 2]> {
    let mut scratch = Scratch::new(model);
    let start = state.time;
    for _ in 0..n {
        advance(model, state, &mut scratch);
    }
    state.time -= start;
    update_forces(model, state, &mut scratch).unwrap();
    scratch.forces[1].clone()
}

/// A held strain relaxes as the Prony series: forces and recovered stress are those of the relaxed moduli, K or g K,
/// and g G. Branch k stores ½ q·g_k K q, which falls as e^{−2t/τ}; the loss is the dissipated power. An elastic bulk
/// keeps its energy.
#[test]
fn a_held_strain_relaxes_as_the_prony_series() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let material = relaxing_glass(&TERMS, acts_on);
        let all = moduli(&material);
        let (model, mut state) = strained(material);
        let n = (0.5 / model.time_step()) as usize;
        let f = hold(&model, &mut state, n);
        let time = n as f64 * model.time_step();
        let g = 0.2 + TERMS.iter().map(|(weight, tau)| weight * (-time / tau).exp()).sum::<f64>();
        assert!(g < 0.6, "{g} is not relaxed");
        let (body, u) = (&model.bodies()[1], vector(&state.bodies[1].displacement));
        let forces = |moduli: Moduli| assembled(body.mesh().unwrap(), moduli) * &u;
        let (bulk, shear) =
            (forces(Moduli { shear: 0.0, ..all }), forces(Moduli { bulk: 0.0, ..all }));
        let energy = |forces: &nalgebra::DVector<f64>| 0.5 * u.dot(forces);
        let (lasting, relaxing, bulk_modulus, exact) = match acts_on {
            ActsOn::All => (0.0, energy(&bulk) + energy(&shear), g * all.bulk, (bulk + shear) * g),
            ActsOn::Shear => (energy(&bulk), energy(&shear), all.bulk, bulk + shear * g),
        };
        // Rounding of some dozen steps.
        let error = (vector(&f) + &exact).amax() / exact.amax();
        assert!(error < 1e-13, "{acts_on:?}: {error:e}");

        let (mut stored, mut power) = (lasting + 0.2 * relaxing, 0.0);
        for (weight, tau) in TERMS {
            let part = weight * relaxing * (-2.0 * time / tau).exp();
            stored += part;
            power += 2.0 / tau * part;
        }
        let accounts = accounts(body, &state.bodies[1]);
        let found = accounts.energies.get(Account::Strain).unwrap();
        let found_power = accounts.powers.get(Account::ViscousDissipation).unwrap();
        assert!((found / stored - 1.0).abs() < 1e-13, "{acts_on:?}: {found} {stored}");
        assert!((found_power / power - 1.0).abs() < 1e-12, "{acts_on:?}: {found_power} {power}");

        let relaxed = ElasticModuli::from_bulk_shear(bulk_modulus, g * all.shear).unwrap();
        let exact = relaxed.stress([0.02, -0.01, 0.02, 0.0]);
        let fields = BodyFields {
            displacement: state.bodies[1].displacement.clone(),
            effective: state.bodies[1].history[body.effective().unwrap()].clone(),
            ..BodyFields::default()
        };
        let stress = body.stress(&fields, None);
        for found in stress.cells.iter().chain(&stress.points) {
            for (found, exact) in found.iter().zip(exact) {
                // Rounding of strains of 0.02 by unit moduli.
                assert!((found - exact).abs() < 1e-14, "{acts_on:?}: {found} {exact}");
            }
        }
    }
}

/// Ramp: q = τ(1 − e^{−t/τ}) u̇ holds exactly for any ratio of step to relaxation time.
#[test]
fn branches_follow_a_ramp_exactly() {
    let mesh = unit_sphere(4.0, Side::Above);
    let rate: Vec<_> = mesh.nodes().iter().map(|&[r, y]| [0.02 * r, -0.01 * y]).collect();
    let material = relaxing_glass(&[(0.5, 1e-4), (0.3, 0.3)], ActsOn::All);
    let (model, mut state) = free_sphere(mesh, material, 0.9);
    state.bodies[1].velocity.copy_from_slice(&rate);
    hold(&model, &mut state, 40);
    let time = 40.0 * model.time_step();
    for (tau, q) in [1e-4, 0.3].into_iter().zip(&state.bodies[1].history[1..]) {
        let gain = -tau * f64::exp_m1(-time / tau);
        for (q, rate) in q.iter().zip(&rate) {
            for axis in 0..2 {
                // Forty roundings.
                assert!((q[axis] - gain * rate[axis]).abs() < 1e-15, "{tau}");
            }
        }
    }
}

#[test]
fn effective_displacement_of_a_state_is_what_the_step_leaves() {
    let (model, mut state) = strained(relaxing_glass(&TERMS, ActsOn::Shear));
    hold(&model, &mut state, 7);
    let after_step = state.bodies[1].history.clone();
    // A rigid start leaves the branches as they are and makes the effective displacement anew.
    let body = &mut state.bodies[1];
    let stress = model.bodies()[1].stress.as_ref().unwrap();
    stress.part.start_rigid(&body.displacement, &mut body.history);
    assert_eq!(body.history, after_step);
}

/// Terms of no weight keep no history; an elastic body has no branch at all.
#[test]
fn zero_weight_terms_keep_no_history() {
    let n_history = |model: &crate::ExplicitBodies| model.bodies().each_ref().map(Body::n_history);
    // The effective displacement and one branch.
    let (model, _) = strained(relaxing_glass(&[(0.0, 1.0), (0.5, 1.0)], ActsOn::All));
    assert_eq!(n_history(&model), [0, 2]);
    let (model, state) = strained(relaxing_glass(&[(0.0, 1.0)], ActsOn::All));
    assert_eq!(n_history(&model), [0, 0]);
    assert_eq!(model.bodies()[1].effective(), None);
    assert!(state.bodies[1].history.is_empty());
}
