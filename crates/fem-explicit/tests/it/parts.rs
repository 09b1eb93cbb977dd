//! Parts that the caller hands to the model.

use crate::common::{Pair, n_nodes, quantities};
use fem_collision::{Account, BodyInput, SnapshotInstant, SnapshotRequest};
use fem_explicit::{
    Accounts, ExplicitBodies, Field, ModelError, ModelParts, Motion, NodalField, NodeForce, Part,
    Weight,
};

fn small() -> Pair {
    let snapshots = SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec());
    Pair { snapshots, ..Pair::small() }
}

fn on_both<F: NodeForce + Clone>(force: &F) -> ModelParts {
    let list = || vec![Box::new(force.clone()) as Box<dyn NodeForce>];
    ModelParts { node_forces: [list(), list()], contact: None, ..ModelParts::default() }
}

/// Bodies that fall together collide as if they did not fall.
#[test]
fn results_are_independent_of_a_common_acceleration() {
    let pair = small();
    let plain = pair.run();
    // A tenth of the speed of approach in the contact time.
    let acceleration = -0.05 / 65e-6;
    let falling = pair.with_parts(on_both(&Weight::new(-acceleration)));
    let run = pair.run_model(&falling);
    let (a, b) = (quantities(&plain), quantities(&run));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-10;
    // Rounding, as of a common velocity.
    assert!(close(a.restitution, b.restitution), "{} {}", a.restitution, b.restitution);
    assert!(close(a.contact_time, b.contact_time) && close(a.peak_force, b.peak_force));
    assert!(close(a.max_approach, b.max_approach) && a.steps == b.steps);
    // Velocities after a collision under gravity are those at the end of the contact.
    let time = run.last_contact.unwrap();
    for (before, after) in a.velocity_after.into_iter().zip(b.velocity_after) {
        assert!((after - before - acceleration * time).abs() < 1e-12, "{before} {after}");
    }
    // Leapfrog's order, as without a fall. Roundings of two thousand equal increments, which may all go one way.
    b.assert_balance(2.0 * a.residual, 1e-12);
    // Snapshots are taken at the same instants of the approach.
    for (one, other) in plain.snapshots.iter().zip(&run.snapshots) {
        assert_eq!((one.label, one.time), (other.label, other.time));
    }
}

/// Every node hangs on the ground by a Maxwell element: a spring (N/m) in series with a dashpot.
/// Its history is the spring's elongation q, q̇ + q/τ = u̇.
#[derive(Debug, Clone)]
struct Maxwell {
    stiffness: f64,
    relaxation_time: f64,
    time_step: f64,
}

impl Part for Maxwell {
    fn n_history(&self) -> usize {
        1
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.time_step = time_step;
    }
}

impl NodeForce for Maxwell {
    fn add_forces(&self, _: &Motion<'_>, history: &[NodalField], forces: &mut Field) -> f64 {
        let mut resultant = 0.0;
        for (force, q) in forces.iter_mut().zip(&history[0]) {
            for axis in 0..2 {
                force[axis] -= self.stiffness * q[axis];
            }
            resultant -= self.stiffness * q[1];
        }
        resultant
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let decay = (-self.time_step / self.relaxation_time).exp();
        for (q, v) in history[0].iter_mut().zip(motion.velocity) {
            for axis in 0..2 {
                q[axis] = decay * q[axis] + (1.0 - decay) * self.relaxation_time * v[axis];
            }
        }
    }

    fn add_energies(&self, _: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let square: f64 = history[0].iter().flatten().map(|q| q * q).sum();
        let energy = 0.5 * self.stiffness * square;
        accounts.energies.add(Account::Strain, energy);
        accounts.powers.add(Account::ViscousDissipation, 2.0 * energy / self.relaxation_time);
    }

    fn add_stiffness_bound(&self, bound: &mut [f64]) {
        bound.iter_mut().for_each(|stiffness| *stiffness += self.stiffness);
    }
}

/// A part with history, together with relaxing stress with its own: its energies balance, its history is
/// kept and resumed.
#[test]
fn a_force_with_history_balances_and_resumes() {
    for relaxation in [None, Some(fem_material::ActsOn::All)] {
        let pair = Pair { relaxation, ..small() };
        let plain = pair.model();
        let hung = Maxwell { stiffness: 3e4, relaxation_time: 4e-5, time_step: 0.0 };
        let model = pair.with_parts(on_both(&hung));
        assert!(model.time_step() < plain.time_step(), "the springs are in the time step");
        for (body, plain) in model.bodies().iter().zip(plain.bodies()) {
            assert_eq!(body.n_history(), plain.n_history() + 1);
        }
        // A field of each body, and its length.
        assert_eq!(pair.n_bytes(&model), pair.n_bytes(&plain) + 16 * n_nodes(&model) + 2 * 2);

        let run = pair.run_model(&model);
        assert_eq!(run, pair.in_pieces(&model, 97));
        let (found, free) = (quantities(&run), quantities(&pair.run_model(&plain)));
        // The ground slows them down: 5 % are measured, of an elastic pair.
        assert!(found.restitution < 0.97 * free.restitution, "{}", found.restitution);
        let lost = run.history.last().unwrap().energy(Account::ViscousDissipation).unwrap();
        assert!(lost > 0.01 * run.initial_energy.unwrap());
        // Leapfrog and the trapezoidal rule, as of a relaxing body.
        found.assert_balance(1e-5, 1e-12);
    }
}

#[test]
fn a_force_on_a_wall_is_refused() {
    let pair = small();
    let bodies = [BodyInput::Wall, pair.sphere(1)];
    let parts = on_both(&Weight::new(1.0));
    let refused =
        ExplicitBodies::with_parts(bodies, pair.approach(), &pair.settings(), parts).unwrap_err();
    assert_eq!(refused, ModelError::ForceOnWall);
}
