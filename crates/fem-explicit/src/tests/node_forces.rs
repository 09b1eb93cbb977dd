//! Forces on nodes: motion under weight.

use fem_collision::{Account, Approach, BodyInput};
use fem_contact::ContactForces;
use fem_mesh::Side;

use crate::energy::Ledger;
use crate::forces::Weight;
use crate::model::{ExplicitBodies, ModelParts};
use crate::part::Accounts;
use crate::run::ContactLog;
use crate::run::{advance, update_forces};
use crate::settings::Settings;
use crate::state::{Scratch, State};
use crate::test_support::{far_apart, glass_sphere, settings, started};

const ACCELERATION: f64 = 0.3;

/// A sphere at rest that rises from a wall far below, by two weights of negative gravity, which add up.
fn rising() -> (ExplicitBodies, State) {
    let weights = [0.25, 0.75].map(|share| Box::new(Weight::new(-share * ACCELERATION)) as Box<_>);
    let parts = ModelParts { node_forces: [Vec::new(), weights.into()], ..ModelParts::default() };
    far_apart([BodyInput::Wall, glass_sphere(8.0, Side::Above)], &settings(), parts)
}

fn upper_has(weight: Weight) -> ModelParts {
    ModelParts { node_forces: [Vec::new(), vec![Box::new(weight)]], ..ModelParts::default() }
}

/// u = ½at² and v = at at the steps' times: leapfrog is exact if it starts half a step before. The loss of potential
/// energy becomes kinetic energy; leapfrog's ½ v_{n−½}·M v_{n+½} is ⅛ m (aΔt)² short of ½ m v_n².
#[test]
fn a_free_motion_under_weight_is_the_closed_form_and_balances() {
    let (model, mut state) = rising();
    let (mut scratch, time_step) = (Scratch::new(&model), model.time_step());
    let (mut ledger, mut log) = (Ledger::new(&model, &state), ContactLog::new(&model, &state));
    let mass = model.bodies()[1].mass();
    let short = 0.125 * mass * (ACCELERATION * time_step).powi(2);
    for n in 0..1000 {
        let time = f64::from(n) * time_step;
        let body = &state.bodies[1];
        let (u, v) = (0.5 * ACCELERATION * time * time, ACCELERATION * (time - 0.5 * time_step));
        for node in (0..body.displacement.len()).filter(|_| n <= 200) {
            let ([r, y], [v_r, v_y]) = (body.displacement[node], body.velocity[node]);
            // Two hundred roundings of equal increments, which may all go one way, and the
            // vibrations that they start.
            assert!((y - u).abs() <= 1e-12 * u, "{n}: {y} {u}");
            assert!((v_y - v).abs() <= 1e-12 * v.abs(), "{n}: {v_y} {v}");
            assert!(r.abs() <= 1e-12 * u && v_r.abs() <= 1e-12 * v.abs(), "{n}: {r:e} {v_r:e}");
        }
        let contact = update_forces(&model, &state, &mut scratch).unwrap();
        assert_eq!(contact, ContactForces::default());
        assert!((scratch.resultants[1] / (ACCELERATION * mass) - 1.0).abs() < 1e-14);
        log.observe(state.time, state.step, &contact);
        let row = ledger.balance(&model, &state, &scratch, &contact);
        let work = -row.energy(Account::Potential).unwrap();
        let residual = row.residual.unwrap();
        assert!((residual + short).abs() < 1e-12 * (work + short), "{n}: {residual:e} {short:e}");
        // The approach that steers the recorder, counted from here on.
        let approach = row.approach + model.approach().gap();
        // Rounding of the gap.
        assert!((log.approach - approach).abs() < 1e-12, "{n}: {} {approach}", log.approach);
        ledger.push(&model, &scratch, contact.force, time_step);
        log.advance(&model, &scratch, time_step);
        advance(&model, &mut state, &mut scratch);
    }
    assert!(ledger.worst_momentum < 1e-13, "{}", ledger.worst_momentum);
}

/// A rigid sphere moves in closed form too, with balanced energy and momentum, while the body below is far away.
#[test]
fn rigid_sphere_under_weight_has_the_closed_form_motion() {
    let bodies = [glass_sphere(8.0, Side::Below), BodyInput::Rigid { radius: 0.5, mass: 3.0 }];
    let (model, mut state) = far_apart(bodies, &settings(), upper_has(Weight::new(-ACCELERATION)));
    let mut scratch = Scratch::new(&model);
    let mut ledger = Ledger::new(&model, &state);
    let time_step = model.time_step();
    for n in 0..=200 {
        let contact = update_forces(&model, &state, &mut scratch).unwrap();
        assert_eq!(scratch.resultants, [0.0, 3.0 * ACCELERATION]);
        let row = ledger.balance(&model, &state, &scratch, &contact);
        let time = f64::from(n) * time_step;
        let work = 3.0 * ACCELERATION * (0.5 * ACCELERATION * time * time);
        // Roundings of equal increments, as above; and of the other body's energy.
        assert!((row.energy(Account::Potential).unwrap() + work).abs() <= 1e-12 * work);
        assert!((row.velocity[1] - ACCELERATION * time).abs() <= 1e-12);
        let short = 0.125 * 3.0 * (ACCELERATION * time_step).powi(2);
        assert!((row.residual.unwrap() + short).abs() < 1e-13 * ledger.initial, "{n}");
        assert_eq!(row.vibration[1], 0.0);
        ledger.push(&model, &scratch, contact.force, model.time_step());
        advance(&model, &mut state, &mut scratch);
    }
    assert!(ledger.worst_momentum < 1e-13, "{}", ledger.worst_momentum);
}

/// A weight is ρ V g, whatever mass scaling moves, and its potential that times the height.
#[test]
fn mass_scaling_leaves_weight_and_potential_unchanged() {
    let gravity = 0.7;
    for mass_scaling in [0.0, 0.05] {
        let settings = Settings { mass_scaling, ..settings() };
        let bodies = [BodyInput::Wall, glass_sphere(8.0, Side::Above)];
        let approach = Approach::at(1.0).unwrap();
        let (model, mut state) =
            started(bodies, approach, &settings, upper_has(Weight::new(gravity)));
        let body = &model.bodies()[1];
        assert_eq!(body.moved_mass() > 1e-9 * body.mass(), mass_scaling > 0.0);
        let expected = gravity * 4.0 / 3.0 * std::f64::consts::PI;
        for place in &mut state.bodies[1].displacement {
            *place = [0.0, 0.3];
        }
        let motion = &state.motions(&model)[1];
        let mut forces = vec![[0.0; 2]; body.n_nodes()];
        let resultant = body.add_node_forces(motion, &[], &mut forces);
        let sum: f64 = forces.iter().map(|force| force[1]).sum();
        // The sphere's mass is exact to rounding.
        assert!((resultant / -expected - 1.0).abs() < 1e-12, "{resultant} {expected}");
        assert!((sum / resultant - 1.0).abs() < 1e-12 && forces.iter().all(|f| f[0] == 0.0));
        let mut accounts = Accounts::default();
        body.add_energies(motion, &state.bodies[1].history, &mut accounts);
        let potential = accounts.energies.get(Account::Potential).unwrap();
        assert!((potential / (0.3 * expected) - 1.0).abs() < 1e-12, "{potential}");
        // The relative acceleration with the inertia of all masses.
        let frame = model.frame();
        assert!((frame.weight() / expected - 1.0).abs() < 1e-12, "{}", frame.weight());
    }
}
