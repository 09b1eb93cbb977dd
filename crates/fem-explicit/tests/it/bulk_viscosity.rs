//! Bulk viscosity in collisions: what it smooths, what it takes, what it keeps.

use fem_collision::{Account, Collision, HistoryRow};
use fem_explicit::{
    BulkViscosity, ExplicitBodies, ModelParts, NodeForce, Run, ViscosityCoefficients,
};

use crate::common::{Pair, assert_foreign, n_nodes, quantities, stored};

fn model(pair: &Pair, coefficients: ViscosityCoefficients) -> ExplicitBodies {
    let node_forces = pair.bodies().map(|body| {
        let (mesh, drop) = (body.mesh().unwrap(), pair.approach().speed());
        let part = BulkViscosity::new(mesh, &pair.material(), coefficients, drop).unwrap();
        vec![Box::new(part) as Box<dyn NodeForce>]
    });
    pair.with_parts(ModelParts { node_forces, ..ModelParts::default() })
}

fn viscous(pair: &Pair) -> Collision {
    pair.run_model(&model(pair, ViscosityCoefficients::default()))
}

/// A twentieth of the shear wave speed, two elements a contact radius.
fn fast() -> Pair {
    let (velocities, element_size, candidate_radius) = ([150.0, 0.0], 180e-6, 3.5e-3);
    Pair { velocities, element_size, candidate_radius, ..Pair::default() }
}

/// Returns the energy taken by viscosity over the kinetic energy in the frame of the mass centre.
fn loss(run: &Collision) -> f64 {
    let [lower, upper] = run.bodies.map(|body| body.mass.unwrap());
    let reduced_mass = lower * upper / (lower + upper);
    let initial = 0.5 * reduced_mass * run.approach.speed().powi(2);
    run.energies.get(Account::BulkViscosity).unwrap() / initial
}

/// Ups and downs over one rise and one fall.
fn variation(run: &Collision, value: impl Fn(&HistoryRow) -> f64) -> f64 {
    let values: Vec<f64> = run.history.iter().map(value).collect();
    let sum: f64 = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    0.5 * sum / values.iter().copied().fold(0.0, f64::max)
}

#[test]
fn bulk_viscosity_reduces_ringing_and_energy_balances() {
    let often = Pair { history_rows: 2000, ..fast() };
    let (bare, viscous) = (often.run(), viscous(&often));
    let ups_and_downs = [&bare, &viscous].map(|run| {
        let pressure = variation(run, |row| row.centre_pressure.unwrap());
        [pressure, variation(run, |row| row.contact_force)]
    });
    // 15.8 and 5.2 were found, and 4.4 and 1.3 with viscosity: nodes that join the contact one by one
    // still hit the surface of the other body.
    for k in 0..2 {
        assert!(ups_and_downs[1][k] < ups_and_downs[0][k] / 3.0, "{ups_and_downs:?}");
    }
    let [without, with] = [&bare, &viscous].map(quantities);
    // What springs leave that open and close between two steps, 9e-6 without viscosity.
    with.assert_balance(2e-5, 1e-12);
    // It takes what would be vibration, too: the bodies lose less of their motion than it has taken.
    let fall = without.restitution.powi(2) - with.restitution.powi(2);
    assert!(fall > 0.0 && fall < loss(&viscous), "{fall:e} {:e}", loss(&viscous));
    // What it damps needs a shorter step.
    assert!(with.steps > without.steps && viscous.time_step < bare.time_step);
    assert_eq!(bare.energies.get(Account::BulkViscosity), None);
}

/// It takes a share of third order from a smooth motion, and of lower order from the edge of a contact, where the
/// pressure ends as a square root.
#[test]
fn bulk_viscosity_loss_of_a_slow_pair_converges_to_zero() {
    let [coarse, fine] = [90e-6, 45e-6].map(|element_size| {
        let pair = Pair { element_size, history_rows: 0, ..Pair::default() };
        loss(&viscous(&pair))
    });
    // Five elements a contact radius; the default has eight.
    assert!(fine < 2e-5, "{fine:e}");
    let order = (coarse / fine).log2();
    // 1.49 and 1.7e-5 were found; 1.00 and 7e-5 without the mean.
    assert!((1.3..3.1).contains(&order), "{order}");
}

#[test]
fn restart_keeps_bulk_viscosity_and_rejects_other_coefficients() {
    let pair = Pair { velocities: [5.0, 0.0], history_rows: 0, ..fast() };
    let (bare, usual) = (pair.model(), model(&pair, ViscosityCoefficients::default()));
    // Its force, its work and its means, pairs of eight bytes, and the lengths of three fields of each body.
    assert_eq!(pair.n_bytes(&usual), pair.n_bytes(&bare) + 3 * 16 * n_nodes(&bare) + 3 * 2);
    let mut run = Run::new(&usual, pair.expected(), &pair.request());
    assert_eq!(run.advance(200), None);
    let saved = stored(run.restart_state());
    let mut resumed = Run::resume(&usual, saved.clone()).unwrap();
    for run in [&mut run, &mut resumed] {
        assert_eq!(run.advance(200), None);
    }
    assert_eq!(run.restart_state(), resumed.restart_state());
    let linear = ViscosityCoefficients { linear: 0.061, ..ViscosityCoefficients::default() };
    assert_foreign("another coefficient", &model(&pair, linear), &saved);
}
