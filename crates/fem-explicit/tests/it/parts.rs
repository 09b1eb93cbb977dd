//! Parts that the caller hands to the model.

use std::any::Any;

use crate::common::{Pair, quantities};
use fem_collision::{Account, BodyInput, CandidateRegion, SnapshotInstant, SnapshotRequest};
use fem_contact::{ContactForces, ContactInterface, Profile, Surface};
use fem_explicit::{
    Accounts, Contact, ExplicitBodies, Field, ModelError, ModelParts, Motion, MotionMut,
    NodalField, NodeForce, Part, Run, Springs,
};

fn small() -> Pair {
    let snapshots = SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec());
    Pair { snapshots, ..Pair::small() }
}

fn model(pair: &Pair, parts: ModelParts) -> ExplicitBodies {
    let bodies = [pair.sphere(0), pair.sphere(1)];
    ExplicitBodies::with_parts(bodies, pair.approach(), &pair.settings(), parts).unwrap()
}

fn on_both<F: NodeForce + Clone>(force: &F) -> ModelParts {
    let list = || vec![Box::new(force.clone()) as Box<dyn NodeForce>];
    ModelParts { node_forces: [list(), list()], contact: None, ..ModelParts::default() }
}

/// Returns the size of the restart state before the first step, in bytes.
fn n_bytes(pair: &Pair, model: &ExplicitBodies) -> usize {
    let run = Run::new(model, pair.expected(), &pair.request());
    postcard::to_stdvec(run.restart_state()).unwrap().len()
}

/// A part that is off is absent: the same bits, and the same size of the restart state.
#[test]
fn default_parts_change_neither_bits_nor_restart_size() {
    let pair = small();
    let (plain, other) = (pair.model(), model(&pair, ModelParts::default()));
    assert_eq!(pair.run_model(&plain), pair.run_model(&other));
    assert_eq!(n_bytes(&pair, &plain), n_bytes(&pair, &other));
    let n_nodes: usize = plain.bodies().iter().map(|body| body.n_nodes()).sum();
    // Displacement and velocity of each node, and a few hundred bytes beside.
    let n_state = 2 * 16 * n_nodes;
    assert!((n_state..n_state + 700).contains(&n_bytes(&pair, &plain)));
}

/// The same acceleration (m/s²) along +y everywhere.
#[derive(Debug, Clone)]
struct Pull(f64);

impl Part for Pull {}

impl NodeForce for Pull {
    fn add_forces(&self, motion: &Motion<'_>, _: &[NodalField], forces: &mut Field) -> f64 {
        for (force, mass) in forces.iter_mut().zip(motion.nodal_mass) {
            force[1] += mass * self.0;
        }
        motion.nodal_mass.iter().map(|mass| mass * self.0).sum()
    }

    fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
        let nodes = motion.nodal_mass.iter().zip(motion.displacement);
        let work = nodes.map(|(mass, u)| mass * self.0 * u[1]).sum();
        accounts.energies.add(Account::WallWork, work);
    }
}

/// Bodies that fall together collide as if they did not fall.
#[test]
fn results_are_independent_of_a_common_acceleration() {
    let pair = small();
    let plain = pair.run();
    // A tenth of the speed of approach in the contact time.
    let acceleration = -0.05 / 65e-6;
    let falling = model(&pair, on_both(&Pull(acceleration)));
    let run = pair.run_model(&falling);
    let (a, b) = (quantities(&plain), quantities(&run));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-10;
    // Rounding, as of a common velocity.
    assert!(close(a.restitution, b.restitution), "{} {}", a.restitution, b.restitution);
    assert!(close(a.contact_time, b.contact_time) && close(a.peak_force, b.peak_force));
    assert!(close(a.max_approach, b.max_approach) && a.steps == b.steps);
    let time = run.history.last().unwrap().time;
    for (before, after) in a.velocity_after.into_iter().zip(b.velocity_after) {
        assert!((after - before - acceleration * time).abs() < 1e-12, "{before} {after}");
    }
    // Leapfrog's order, as without a fall.
    assert!(b.residual < 2.0 * a.residual, "{} {}", b.residual, a.residual);
    // Roundings of two thousand equal increments, which may all go one way.
    assert!(b.momentum_residual < 1e-12, "{}", b.momentum_residual);
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
        let model = model(&pair, on_both(&hung));
        assert!(model.time_step() < plain.time_step(), "the springs are in the time step");
        for (body, plain) in model.bodies().iter().zip(plain.bodies()) {
            assert_eq!(body.n_history(), plain.n_history() + 1);
        }
        let n_nodes: usize = model.bodies().iter().map(|body| body.n_nodes()).sum();
        // A field of each body, and its length.
        assert_eq!(n_bytes(&pair, &model), n_bytes(&pair, &plain) + 16 * n_nodes + 2 * 2);

        let run = pair.run_model(&model);
        assert_eq!(run, pair.in_pieces(&model, 97));
        let (found, free) = (quantities(&run), quantities(&pair.run_model(&plain)));
        // The ground slows them down: 5 % are measured, of an elastic pair.
        assert!(found.restitution < 0.97 * free.restitution, "{}", found.restitution);
        let lost = run.history.last().unwrap().energy(Account::ViscousDissipation).unwrap();
        assert!(lost > 0.01 * run.initial_energy.unwrap());
        // Leapfrog and the trapezoidal rule, as of a relaxing body.
        assert!(found.residual < 1e-5, "{}", found.residual);
        assert!(found.momentum_residual < 1e-12, "{}", found.momentum_residual);
    }
}

#[test]
fn a_force_on_a_wall_is_refused() {
    let pair = small();
    let bodies = [BodyInput::Wall, pair.sphere(1)];
    let parts = on_both(&Pull(1.0));
    let refused =
        ExplicitBodies::with_parts(bodies, pair.approach(), &pair.settings(), parts).unwrap_err();
    assert_eq!(refused, ModelError::ForceOnWall);
}

/// The penalty contact with a history that it does not need: the steps done, at each node of either
/// body.
#[derive(Debug)]
struct Counting {
    penalty: Springs,
    first_touch: f64,
    time_step: f64,
}

impl Counting {
    fn of(pair: &Pair) -> Self {
        let [lower, upper] = [0, 1].map(|body| {
            let sphere = pair.sphere(body);
            Surface::of_sphere(sphere.mesh().unwrap())
        });
        let (settings, approach) = (pair.settings(), pair.approach());
        let penalty = ContactInterface::new(
            lower,
            upper,
            settings.contact_stiffness,
            approach.gap(),
            settings.candidate_radius,
        );
        Self {
            penalty: Springs::Undeformed(penalty.unwrap()),
            first_touch: approach.first_touch(),
            time_step: 0.0,
        }
    }

    fn check(&self, motions: &[Motion<'_>; 2], history: [&[NodalField]; 2]) {
        let n_steps = ((motions[0].time - self.first_touch) / self.time_step).round();
        for (motion, fields) in motions.iter().zip(history) {
            assert_eq!(fields.len(), 1);
            assert_eq!(fields[0].len(), motion.displacement.len());
            assert!(fields[0].iter().all(|count| *count == [n_steps; 2]), "{n_steps}");
        }
    }
}

impl Part for Counting {
    fn n_history(&self) -> usize {
        1
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.time_step = time_step;
    }
}

impl Contact for Counting {
    fn candidate_region(&self) -> CandidateRegion {
        self.penalty.candidate_region()
    }

    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.penalty.add_stiffness_bound(side, bound);
    }

    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces {
        self.check(motions, history);
        self.penalty.add_forces(motions, [&[]; 2], forces)
    }

    fn pushed_nodes(&self, side: usize) -> Vec<u32> {
        self.penalty.pushed_nodes(side)
    }

    fn advance(
        &self,
        motions: [MotionMut<'_>; 2],
        history: [&mut [NodalField]; 2],
        _: &mut dyn Any,
    ) {
        assert!(motions[0].time > self.first_touch);
        for fields in history {
            fields[0].iter_mut().flatten().for_each(|count| *count += 1.0);
        }
    }

    fn is_closed_next(
        &self,
        now: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        self.penalty.is_closed_next(now, next, [&[]; 2])
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        self.penalty.radius_and_pressure(motions, [&[]; 2])
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        self.penalty.profile(motions, [&[]; 2])
    }
}

/// Another contact takes the place of the penalty's; its history is behind that of the bodies'
/// parts and resumed with it.
#[test]
fn custom_contact_replaces_the_penalty_contact_and_resumes() {
    for relaxation in [None, Some(fem_material::ActsOn::Shear)] {
        let pair = Pair { relaxation, ..small() };
        let contact = || Some(Box::new(Counting::of(&pair)) as Box<dyn Contact>);
        let parts = ModelParts { contact: contact(), ..ModelParts::default() };
        let (plain, other) = (pair.model(), model(&pair, parts));
        assert!(plain.interface().is_some() && other.interface().is_none());
        assert_eq!(other.candidate_radius(), plain.candidate_radius());
        let run = pair.run_model(&plain);
        assert_eq!(pair.run_model(&other), run);
        assert_eq!(pair.in_pieces(&other, 97), run);
        let n_nodes: usize = plain.bodies().iter().map(|body| body.n_nodes()).sum();
        assert_eq!(n_bytes(&pair, &other), n_bytes(&pair, &plain) + 16 * n_nodes + 2 * 2);
        // A restart state with more fields belongs to another model.
        let saved = Run::new(&other, pair.expected(), &pair.request()).restart_state().clone();
        assert_eq!(Run::resume(&plain, saved.clone()).err(), Some(ModelError::ForeignRestartState));
        // So does one with the same fields, of a contact with another number.
        let later = Counting { first_touch: 1e-9, ..Counting::of(&pair) };
        let later = ModelParts { contact: Some(Box::new(later)), ..ModelParts::default() };
        let refused = Run::resume(&model(&pair, later), saved).err();
        assert_eq!(refused, Some(ModelError::ForeignRestartState));
    }
}
