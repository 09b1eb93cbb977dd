//! A rigid sphere as partner: its curvature in the gap, its mass in the reduced mass, and no more.

use crate::common::{
    GLASS, Scene, assert_balance, assert_close, assert_pulse, assert_restitution, collide, glass,
    hertz_pulse, material, ting_pulse,
};
use crate::explicit_agreement::assert_agreement;
use fem_collision::{BodyInput, Collision, Frame, OutputRequest, SnapshotRequest};
use fem_condensed::{CondensedError, CondensedPair, PairSettings};
use fem_contact::ContactError;
use fem_laws::{FiniteSize, HertzImpact, Pair, PairRelaxation, Partner, Ting, sphere_mass};
use fem_material::ActsOn::{All, Shear};
use fem_material::Material;

/// Radius (m) and mass (kg) of the paper's larger sphere.
const RADIUS: f64 = 11.1e-3;

fn mass() -> f64 {
    sphere_mass(2.0 * RADIUS, GLASS[2])
}

/// The closed form of two bodies one of which has no compliance: 1e-300 of it is none.
fn pair_of(soft: &Material) -> Pair {
    let rigid = Partner::Sphere { radius: RADIUS, mass: mass(), plane_strain_modulus: 1e300 };
    Pair::new(rigid, Partner::solid_sphere(15.9e-3, soft)).unwrap()
}

/// The paper's smaller sphere of a material, the larger one rigid in its place.
fn condensed(soft: &Material, rigid: usize, speed: f64, elements: f64) -> CondensedPair {
    let contact_radius = HertzImpact::new(&pair_of(soft), speed).unwrap().max_contact_radius();
    let mut bodies = [None, None];
    bodies[1 - rigid] = Some((15.9e-3, soft.clone()));
    let scene = Scene { bodies, speed };
    let mesh_radius = scene.hertz().max_contact_radius();
    let mut inputs = scene.inputs(elements * mesh_radius / contact_radius);
    inputs[rigid] = BodyInput::Rigid { radius: RADIUS, mass: mass() };
    CondensedPair::new(inputs, PairSettings::new(1.5 * contact_radius)).unwrap()
}

/// a/R → 0: Hertz with R* and m* of both bodies and E* of the one that deforms.
#[test]
fn a_small_contact_is_hertz_with_one_modulus() {
    let speed = 1e-7;
    let hertz = HertzImpact::new(&pair_of(&glass()), speed).unwrap();
    for rigid in 0..2 {
        let pair = condensed(&glass(), rigid, speed, 16.0);
        let run = collide(&pair, speed);
        // As of two spheres that deform.
        assert_pulse(&run, hertz_pulse(&hertz), [2e-4, 1e-3, 3e-4]);
        assert_close("radius", run.max_contact_radius.unwrap(), hertz.max_contact_radius(), 3e-3);
        assert_close("pressure", run.peak_pressure.unwrap(), hertz.peak_pressure(), 1e-2);
        let body = run.bodies[rigid];
        assert_eq!((body.elements, body.nodes, body.mass), (Some(0), Some(0), Some(mass())));
        assert_eq!((body.moved_mass, body.vibration_energy), (Some(0.0), Some(0.0)));
    }
}

/// Ting with the finite size of the one that deforms, in either place.
#[test]
fn a_relaxing_sphere_on_a_rigid_one_is_ting() {
    for (acts_on, terms) in [(All, [(0.8, 5e3)]), (Shear, [(1.0, 2708.0)])] {
        let soft = material(GLASS, acts_on, &terms);
        let relaxation = PairRelaxation::new(None, Some(&soft)).unwrap();
        let finite_size = FiniteSize::new(None, Some((7.95e-3, &soft))).unwrap();
        let ting = Ting::new(&pair_of(&soft), relaxation).with_finite_size(finite_size);
        let ting = ting.impact(0.5).unwrap();
        for rigid in 0..2 {
            let run = collide(&condensed(&soft, rigid, 0.5, 12.0), 0.5);
            // As in `six_scenes_are_ting_with_finite_size`.
            let tolerance = 1e-4 + 0.01 * (1.0 - ting.restitution);
            assert_restitution("Ting", &run, ting.restitution, tolerance);
            assert_pulse(&run, ting_pulse(&ting), [2e-3, 3e-3, 2e-3]);
            assert_balance("Ting", &run, 1e-4);
            let momentum = run.momentum_residual_relative.unwrap();
            assert!(momentum < 1e-4, "{momentum}");
        }
    }
}

/// The numbers of a run.
fn numbers(run: &Collision) -> [f64; 6] {
    [
        run.restitution.unwrap(),
        run.contact_time.unwrap(),
        run.peak_force.unwrap(),
        run.max_approach.unwrap(),
        run.peak_pressure.unwrap(),
        run.max_contact_radius.unwrap(),
    ]
}

/// Swapped bodies are in the mirror, to the last digits; velocities of the frame too.
#[test]
fn mirrored_scenes_give_mirrored_results() {
    let soft = material(GLASS, All, &[(0.8, 5e3)]);
    let [one, other] = [0, 1].map(|rigid| collide(&condensed(&soft, rigid, 0.5, 6.0), 0.5));
    for (one, other) in numbers(&one).into_iter().zip(numbers(&other)) {
        assert_close("mirrored", other, one, 1e-12);
    }
    // In both, the lower body strikes.
    let [after, mirrored] =
        [one, other].map(|run| run.bodies.map(|body| body.velocity_after.unwrap()));
    for side in 0..2 {
        assert!((after[side] - (0.5 - mirrored[1 - side])).abs() < 1e-13);
    }
}

/// A very stiff partner of the same mass has its share of the approach: T ~ E*^(−2/5), F ~ E*^(2/5) (Hertz).
#[test]
fn a_stiff_partner_approaches_the_rigid_one() {
    for ratio in [1e2, 1e4, 1e5] {
        let stiff = material([GLASS[0] * ratio, GLASS[1], GLASS[2]], All, &[]);
        let mut scene = Scene::paper(stiff, glass());
        scene.speed = 0.05;
        // The stiff body's mesh is the finer one: the points are the soft one's nodes.
        let [lower, _] = scene.inputs(11.0);
        let [_, upper] = scene.inputs(8.0);
        let pair = CondensedPair::new([lower, upper.clone()], scene.settings()).unwrap();
        let [mass, _] = pair.masses();
        let rigid = BodyInput::Rigid { radius: RADIUS, mass };
        let rigid = CondensedPair::new([rigid, upper], scene.settings()).unwrap();
        let [deformable, rigid] = [pair, rigid].map(|pair| scene.collide(&pair));
        // 0.7, 0.1 and 2.8 % of it are measured: a/R = 2 % of the finite size, and for the force the
        // edge's place between two nodes.
        let share = (1.0 + 1.0 / ratio).powf(0.4) - 1.0;
        let off = |of: fn(&Collision) -> Option<f64>| {
            of(&deformable).unwrap() / of(&rigid).unwrap() - 1.0
        };
        assert_close("time", off(|run| run.contact_time), share, 0.05);
        assert_close("approach", off(|run| run.max_approach), share, 0.05);
        assert_close("force", off(|run| run.peak_force), -share, 0.05);
    }
}

/// The same elements and penalty springs step by step; see `explicit_agreement.rs` for the tolerances.
#[test]
fn condensed_rigid_partner_equals_the_explicit_one() {
    let soft = material(GLASS, All, &[(0.8, 5e3)]);
    let hertz = HertzImpact::new(&pair_of(&soft), 0.5).unwrap();
    let stiffness = 5.0 * pair_of(&soft).contact_modulus();
    for rigid in 0..2 {
        let inputs = condensed(&soft, rigid, 0.5, 5.0).inputs().clone();
        let runs = assert_agreement("rigid", inputs, &hertz, stiffness);
        for side in 0..2 {
            let [found, reference] = runs.each_ref().map(|run| run.bodies[side]);
            let off = found.velocity_after.unwrap() - reference.velocity_after.unwrap();
            assert!(off.abs() < 5e-5, "{off:e}");
            assert_eq!((found.nodes, found.elements), (reference.nodes, reference.elements));
            assert!((found.mass.unwrap() / reference.mass.unwrap() - 1.0).abs() < 1e-12);
        }
    }
}

/// A rigid sphere moves as the frame says, and has no fields; its factor takes no memory.
#[test]
fn snapshots_have_the_fields_of_the_other_body() {
    let soft = material(GLASS, All, &[(0.8, 5e3)]);
    let pair = condensed(&soft, 0, 0.5, 6.0);
    let frame = pair.frame(0.5).unwrap();
    let Frame { masses, reduced_mass, .. } = frame;
    let inverse: f64 = masses.iter().map(|mass| mass.unwrap().recip()).sum();
    assert!((reduced_mass * inverse - 1.0).abs() < 1e-15);
    let request =
        OutputRequest { snapshots: SnapshotRequest::Count(3), ..OutputRequest::history() };
    let run = pair.collide(&frame, pair.relaxations(), 200, &request, &mut ()).unwrap();
    assert!(!run.snapshots.is_empty());
    for snapshot in &run.snapshots {
        assert!(snapshot.bodies[0].displacement.is_empty());
        assert!(snapshot.bodies[1].displacement.len() > 100);
    }
}

#[test]
fn condensed_pair_rejects_impossible_rigid_bodies() {
    let scene = Scene::paper(glass(), glass());
    let [_, upper] = scene.inputs(4.0);
    let new = |radius: f64, mass: f64| {
        let bodies = [BodyInput::Rigid { radius, mass }, upper.clone()];
        CondensedPair::new(bodies, scene.settings()).err()
    };
    assert_eq!(new(1e-2, 1.0), None);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
        let refused = new(bad, 1.0);
        assert!(matches!(refused, Some(CondensedError::Contact(ContactError::NotPositive { .. }))));
        let refused = new(1e-2, bad).unwrap();
        assert!(refused.to_string().starts_with("mass of a rigid sphere is"), "{refused}");
    }
    // A contact that outgrows a small rigid sphere says so.
    let bodies = [BodyInput::Rigid { radius: 0.3e-3, mass: 1e-3 }, upper.clone()];
    let small = CondensedPair::new(bodies, scene.settings()).unwrap();
    assert_eq!(small.smallest_radius(), 0.3e-3);
    assert!(small.enlarge(1.0).and_then(|whole| whole.enlarge(2.0)).is_err());
}
