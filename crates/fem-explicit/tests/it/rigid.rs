//! A rigid sphere as partner: one degree of freedom in place of a mesh.

use crate::common::{
    CONTACT_MODULUS, Hertz, Pair, assert_foreign, elastic, quantities, sphere_mass,
};
use fem_collision::{
    Approach, BodyFields, BodyInput, Collision, Ending, Expectation, SnapshotRequest, StressField,
};
use fem_contact::ContactError;
use fem_explicit::{ExplicitBodies, ModelError, Run, Settings, SmallStrainContact, collide};
use fem_material::ActsOn;

/// Masses of glass spheres with the radii (m) of the paper's pair, kg.
fn masses() -> [f64; 2] {
    [11.1e-3, 7.95e-3].map(|radius| sphere_mass(radius, 2390.0))
}

fn coarse() -> Pair {
    Pair { candidate_radius: 0.45e-3, ..Pair::coarse() }
}

/// A pair one of whose bodies is rigid, with the mass of its glass times a factor.
fn bodies_of(pair: &Pair, rigid: usize, factor: f64) -> [BodyInput; 2] {
    let (mut bodies, radius) = (pair.bodies(), pair.radii[rigid]);
    bodies[rigid] = BodyInput::Rigid { radius, mass: factor * sphere_mass(radius, 2390.0) };
    bodies
}

fn model(pair: &Pair, rigid: usize) -> ExplicitBodies {
    pair.model_of(bodies_of(pair, rigid, 1.0))
}

/// Hertz with R* and m* of both bodies, E* of the one that deforms alone. Either body rigid, at rest or moving; the finite size of the sphere that deforms takes some
/// thousandths, the mesh of five elements a contact radius as much (see `collision.rs`).
#[test]
fn a_rigid_partner_is_hertz_with_one_modulus() {
    let [radius, mass] = [[11.1e-3, 7.95e-3], masses()].map(|[a, b]| 1.0 / (1.0 / a + 1.0 / b));
    let hertz = Hertz::new(radius, mass, 2.0 * CONTACT_MODULUS, 0.5);
    for (rigid, velocities) in
        [(0, [0.5, 0.0]), (0, [0.0, -0.5]), (1, [0.5, 0.0]), (1, [0.0, -0.5]), (1, [1.5, 1.0])]
    {
        let pair = Pair { velocities, element_size: 35e-6, history_rows: 0, ..coarse() };
        let model = model(&pair, rigid);
        let run = pair.run_model(&model);
        let found = quantities(&run);
        let close = |a: f64, b: f64, what: &str| {
            assert!((a / b - 1.0).abs() < 0.01, "{rigid} {velocities:?} {what}: {a:e} {b:e}");
        };
        close(found.contact_time, hertz.time, "time");
        close(found.peak_force, hertz.force, "force");
        close(found.max_approach, hertz.approach, "approach");
        // As of two glass spheres.
        assert!((found.restitution - 1.0).abs() < 1e-4, "{}", found.restitution);
        found.assert_balance(2e-6, 1e-13);
        // The laws of elastic collision.
        let total: f64 = masses().iter().sum();
        for side in 0..2 {
            let sign = [-1.0, 1.0][side];
            let share = masses()[1 - side] / total;
            let after = velocities[side] + sign * share * (1.0 + found.restitution) * 0.5;
            let off = found.velocity_after[side] - after;
            // Mass scaling adds up to 2e-4 to the mesh.
            assert!(off.abs() < 1e-4, "{off:e} of {after}");
        }
        let body = run.bodies[rigid];
        assert_eq!((body.elements, body.nodes), (Some(0), Some(0)));
        assert!((body.mass.unwrap() / masses()[rigid] - 1.0).abs() < 1e-15);
        assert_eq!((body.moved_mass, body.vibration_energy), (Some(0.0), Some(0.0)));
        assert!(run.bodies[1 - rigid].vibration_energy.unwrap() > 0.0);
    }
}

/// Difference of two runs in what does not scatter from step to step.
fn differences(a: &Collision, b: &Collision) -> [f64; 5] {
    let [a, b] = [a, b].map(quantities);
    let off = |a: f64, b: f64| (a / b - 1.0).abs();
    [
        off(a.restitution, b.restitution),
        off(a.contact_time, b.contact_time),
        off(a.peak_force, b.peak_force),
        off(a.max_approach, b.max_approach),
        off(a.peak_pressure, b.peak_pressure),
    ]
}

/// Without end and with all the mass, at the same time step to rounding. The mass lets it yield by
/// 1e-12.
#[test]
fn an_enormous_rigid_sphere_is_a_wall() {
    let methods = [SmallStrainContact::Penalty, SmallStrainContact::Massless];
    for (wall, method) in methods.into_iter().flat_map(|method| [(0, method), (1, method)]) {
        let mut pair = Pair { method, ..coarse() };
        pair.velocities[wall] = 0.0;
        pair.velocities[1 - wall] = [0.5, -0.5][1 - wall];
        let mut bodies = pair.on_wall(wall);
        let plane = pair.model_of(bodies.clone());
        bodies[wall] = BodyInput::Rigid { radius: 1e10, mass: 1e10 };
        let round = pair.model_of(bodies);
        assert!((round.time_step() / plane.time_step() - 1.0).abs() < 1e-10);
        let [plane, round] = [plane, round].map(|model| pair.run_model(&model));
        let differences = differences(&plane, &round);
        assert!(differences.iter().all(|off| *off < 1e-9), "{differences:?}");
        // It takes twice the other's momentum.
        let after = round.bodies[wall].velocity_after.unwrap();
        let given = 2.0 * 0.5 * masses()[1 - wall] / 1e10;
        assert!((after.abs() / given - 1.0).abs() < 1e-3, "{after:e}");
        assert!(quantities(&round).residual < 2e-6, "{method:?}");
    }
}

/// A heavy body that moves has M/m (V/v)² of the energy that the collision is about, here 4e14: of its
/// own, rounding would leave nothing that could be balanced.
#[test]
fn a_heavy_rigid_sphere_that_moves_is_balanced() {
    let run = |velocities: [f64; 2]| {
        let pair = Pair { velocities, history_rows: 0, ..coarse() };
        let heavy = bodies_of(&pair, 0, 1e12);
        pair.run_model(&pair.model_of(heavy))
    };
    let (plain, moving) = (run([0.5, 0.0]), run([10.5, 10.0]));
    // As of other bodies, see `results_are_independent_of_a_common_velocity`; displacements are larger.
    assert!(differences(&plain, &moving).iter().all(|off| *off < 1e-9));
    for run in [plain, moving] {
        quantities(&run).assert_balance(2e-6, 1e-12);
    }
}

/// A body that relaxes at once sticks to a heavy rigid one that moves, and goes on with it: both keep
/// the velocity of their mass centre.
#[test]
fn a_body_that_relaxes_completely_stays_with_a_rigid_sphere() {
    let relaxation = Some(ActsOn::All);
    for (factor, velocities) in [(1.0, [0.5, 0.0]), (1e13, [10.5, 10.0])] {
        let pair = Pair { relaxation, terms: &[(1.0, 1e-6)], velocities, ..coarse() };
        let pair = Pair { candidate_radius: 1.5e-3, max_time: 2e-3, ..pair };
        let run = pair.run_model(&pair.model_of(bodies_of(&pair, 0, factor)));
        assert_eq!((run.ending.clone(), run.restitution), (Ending::Together, Some(0.0)));
        let masses = [factor * masses()[0], masses()[1]];
        let momentum = masses[0] * velocities[0] + masses[1] * velocities[1];
        for body in run.bodies {
            let off = body.velocity_after.unwrap() - momentum / (masses[0] + masses[1]);
            // Mass scaling.
            assert!(off.abs() < 1e-4 * 0.5, "{factor:e}: {off:e}");
        }
        assert!(run.residual_relative.unwrap() < 1e-3, "{}", run.residual_relative.unwrap());
    }
}

/// A heavy rigid sphere asks for the step of a wall. As a mesh, 1e4 times stiffer, it would take √1e4
/// times as many steps, less what the springs take of the soft body's own, of twice as many elements.
#[test]
fn rigid_partner_has_no_elements_and_keeps_the_wall_time_step() {
    let pair = coarse();
    let step = |lower: BodyInput| pair.model_of([lower, pair.sphere(1)]);
    let wall = step(BodyInput::Wall);
    let heavy = step(BodyInput::Rigid { radius: 11.1e-3, mass: 1e4 * masses()[0] });
    assert_eq!(wall.n_elements(), heavy.n_elements());
    // One part in the ratio of the masses, and less.
    assert!((heavy.time_step() / wall.time_step() - 1.0).abs() < 1e-4);
    let material = elastic(63e13, 0.244, 2390.0);
    let BodyInput::Sphere { mesh, .. } = pair.sphere(0) else { panic!("a sphere") };
    let meshed = step(BodyInput::Sphere { mesh, material });
    let own = step(bodies_of(&pair, 0, 1.0)[0].clone());
    let updates = |model: &ExplicitBodies| model.n_elements() as f64 / model.time_step();
    let saved = updates(&meshed) / updates(&own);
    assert!(saved > 100.0 && saved < 200.0, "{saved}");
    // No node of it takes part but one.
    assert_eq!((own.bodies()[0].n_elements(), own.bodies()[0].nodal_mass().len()), (0, 1));
    assert_eq!(own.bodies()[0].n_history(), 0);
    assert_eq!(wall.bodies()[0].stress(&BodyFields::default(), None), StressField::default());
}

/// A bead of a five-hundredth of the mass keeps its energy.
#[test]
fn a_light_rigid_bead_is_stable() {
    let speed = 0.5;
    let pair = Pair { radii: [1e-3, 7.95e-3], element_size: 20e-6, ..coarse() };
    let bodies = bodies_of(&pair, 0, 1.0);
    let settings = Settings { candidate_radius: 60e-6, ..pair.settings() };
    let light = ExplicitBodies::new(bodies, Approach::at(speed).unwrap(), &settings).unwrap();
    let expected = Expectation { contact_time: 6e-6, approach: 1e-6 };
    let run = collide(&light, expected, &pair.request(), &mut ());
    let found = quantities(&run);
    assert!(found.residual < 1e-5, "{}", found.residual);
    assert!((found.restitution - 1.0).abs() < 5e-3, "{}", found.restitution);
}

#[test]
fn rigid_partner_resumed_run_is_the_same_to_the_bit() {
    for rigid in 0..2 {
        let relaxation = Some(ActsOn::Shear);
        let snapshots = SnapshotRequest::Count(3);
        let pair = Pair { element_size: 110e-6, relaxation, gap: 1e-6, snapshots, ..coarse() };
        let model = model(&pair, rigid);
        let whole = pair.run_model(&model);
        assert_eq!(whole.snapshots.len(), 3);
        assert!(whole.snapshots.iter().all(|s| s.bodies[rigid].displacement.is_empty()));
        assert_eq!(pair.in_pieces(&model, 97), whole);
        let mut run = Run::new(&model, pair.expected(), &pair.request());
        assert_eq!(run.advance(300), None);
        let mut larger = bodies_of(&pair, rigid, 1.0);
        if let BodyInput::Rigid { radius, .. } = &mut larger[rigid] {
            *radius *= 1.0 + 1e-9;
        }
        let heavier = bodies_of(&pair, rigid, 1.0 + 1e-9);
        for (other, what) in
            [(larger, "radius"), (heavier, "mass"), (pair.on_wall(rigid), "a wall")]
        {
            assert_foreign(what, &pair.model_of(other), run.restart_state());
        }
    }
}

#[test]
fn explicit_bodies_reject_impossible_rigid_bodies() {
    let pair = coarse();
    let new = |radius: f64, mass: f64| {
        let bodies = [BodyInput::Rigid { radius, mass }, pair.sphere(1)];
        ExplicitBodies::new(bodies, pair.approach(), &pair.settings()).err()
    };
    assert_eq!(new(1e-2, 1.0), None);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
        let refused = new(bad, 1.0).unwrap();
        assert!(matches!(refused, ModelError::Contact(ContactError::NotPositive { .. })));
        let refused = new(1e-2, bad).unwrap();
        assert!(refused.to_string().starts_with("mass of a rigid sphere is"), "{refused}");
    }
    let rigid = || BodyInput::Rigid { radius: 1e-2, mass: 1.0 };
    for bodies in [[rigid(), BodyInput::Wall], [rigid(), rigid()]] {
        let refused = ExplicitBodies::new(bodies, pair.approach(), &pair.settings()).unwrap_err();
        assert_eq!(refused, ModelError::Contact(ContactError::BothRigid));
    }
}
