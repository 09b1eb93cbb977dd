//! Fields at an instant.

mod common;

use common::{GLASS, Scene, glass, material};
use fem_condensed::{CollideSettings, CondensedPair, ContactModel, Frame, PairSettings};
use fem_collision::{Label, SnapshotRequest, StressField};
use fem_material::ActsOn::{self, All, Shear};
use fem_material::Material;

fn relaxing(acts_on: ActsOn) -> Material {
    material(GLASS, acts_on, &[(1.0, 2708.0)])
}

/// Everything that the snapshots say about the bodies as a whole, for every kind of body.
#[test]
fn snapshots_are_the_motion() {
    let cases = [
        (glass(), glass(), 0),
        (relaxing(All), glass(), 0),
        (relaxing(Shear), relaxing(All), 0),
        (glass(), relaxing(Shear), 6),
    ];
    for (lower, upper, vibration_modes) in cases {
        let scene = Scene::paper(lower, upper);
        let settings = PairSettings { vibration_modes, ..scene.settings() };
        let pair = CondensedPair::new(scene.inputs(8.0), settings).unwrap();
        let run = common::collide(&pair, 0.5, &CollideSettings::default());
        let frame = Frame { velocities: [0.7, 0.2], gap: 1e-6 };
        let request = SnapshotRequest::Labels(Label::ALL.to_vec());
        let (snapshots, missing) =
            pair.snapshots(&frame, pair.relaxations(), &run, &request).unwrap();
        assert!(missing.is_empty() && snapshots.len() == 4, "{missing:?}");
        assert!(snapshots.windows(2).all(|two| two[0].time < two[1].time));
        let momentum = {
            let [lower, upper] = pair.masses();
            lower * 0.7 + upper * 0.2
        };
        for snapshot in &snapshots {
            let mut total = 0.0;
            let mut centres = [0.0; 2];
            for (side, fields) in snapshot.bodies.iter().enumerate() {
                let masses = pair.nodal_masses(side);
                let mean = |field: &[[f64; 2]]| {
                    masses.iter().zip(field).map(|(m, u)| m * u[1]).sum::<f64>()
                };
                total += mean(&fields.velocity);
                centres[side] = mean(&fields.displacement) / pair.masses()[side];
            }
            // Rounding of fields of 1e-5 m.
            assert!((total / momentum - 1.0).abs() < 1e-9);
            assert!((centres[0] - centres[1] - 1e-6 - snapshot.approach).abs() < 1e-15);
        }
        let half = 0.5 * run.max_approach;
        assert!((snapshots[0].approach / half - 1.0).abs() < 0.02);
        assert!((snapshots[1].approach / run.max_approach - 1.0).abs() < 1e-3);
        assert!((snapshots[2].approach / half - 1.0).abs() < 0.02);
        assert!(
            (snapshots[3].time - frame.first_touch() - run.contact_time).abs() <= run.time_step
        );

        // Under the contact the stress is Hertz'.
        let maximum = &snapshots[1];
        for (side, input) in pair.inputs().iter().enumerate() {
            let fem_condensed::BodyInput::Sphere { mesh, material } = input else { continue };
            let stress = StressField::of(mesh, material, &maximum.bodies[side]);
            let depth = |node: u32| mesh.nodes()[node as usize][1].abs();
            for &node in
                mesh.axis().iter().filter(|&&node| depth(node) < 3.0 * run.max_contact_radius)
            {
                let hertz = fem_laws::HertzPressure {
                    contact_radius: run.max_contact_radius,
                    peak_pressure: run.peak_pressure,
                };
                let expected = hertz.axis_stress(depth(node), 0.244).axial;
                let found = stress.points[node as usize][1];
                // Recovered from elements of an eighth of the radius; 4 % at the surface.
                assert!((found - expected).abs() < 0.05 * run.peak_pressure, "{found} {expected}");
            }
        }
    }
}

/// Counts and times.
#[test]
fn counts_and_times() {
    let scene = Scene::paper(glass(), glass());
    let pair = scene.condensed(6.0);
    let run = scene.collide(&pair);
    let frame = Frame { velocities: [0.5, 0.0], gap: 0.0 };
    let with = |request| pair.snapshots(&frame, [None; 2], &run, &request).unwrap();
    let (five, missing) = with(SnapshotRequest::Count(5));
    assert!(five.len() == 5 && missing.is_empty());
    for (k, snapshot) in five.iter().enumerate() {
        let time = run.contact_time * k as f64 / 4.0;
        // The contact ends within a step of its last.
        assert!((snapshot.time - time).abs() <= 1.01 * run.time_step);
    }
    let (many, missing) = with(SnapshotRequest::Count(10_000));
    assert!(many.len() < 300 && missing.len() == 1);
    let (two, missing) = with(SnapshotRequest::Times(vec![30e-6, 10e-6, 1.0]));
    assert!(two.len() == 2 && missing.len() == 1);
    assert!((two[0].time - 10e-6).abs() <= 1e-12 && (two[1].time - 30e-6).abs() <= 1e-12);
}

/// The explicit model's fields at the largest approach, node by node.
#[test]
fn fields_are_the_explicit_ones() {
    let scene = Scene::paper(relaxing(Shear), relaxing(All));
    let stiffness = 5.0 * scene.pair().contact_modulus();
    let hertz = scene.hertz();
    let bodies = [0, 1].map(|side: usize| fem_explicit::BodyInput::Deformable {
        mesh: scene.mesh(side, 5.0).unwrap(),
        material: scene.bodies[side].clone().unwrap().1,
        velocity: [0.5, 0.0][side],
    });
    let settings = fem_explicit::Settings {
        contact_stiffness: stiffness,
        candidate_radius: 1.5 * hertz.max_contact_radius(),
        step_factor: 0.9,
        mass_scaling: 3e-5,
        gap: 0.0,
    };
    let model = fem_explicit::Model::new(bodies, &settings).unwrap();
    let request = SnapshotRequest::Labels(vec![Label::Maximum]);
    let settings = fem_explicit::RunSettings {
        expected_contact_time: hertz.contact_time(),
        expected_approach: hertz.max_approach(),
        history_rows: 100,
        snapshots: request.clone(),
        max_time: 1e-3,
    };
    let reference = fem_explicit::collide(&model, &settings, &mut ());
    let settings = PairSettings {
        contact: ContactModel::Springs(stiffness),
        vibration_modes: 12,
        ..scene.settings()
    };
    let pair = CondensedPair::new(scene.inputs(5.0), settings).unwrap();
    let run = common::collide(&pair, 0.5, &CollideSettings { n_steps: 1000, ..Default::default() });
    let frame = Frame { velocities: [0.5, 0.0], gap: 0.0 };
    let (snapshots, _) = pair.snapshots(&frame, pair.relaxations(), &run, &request).unwrap();
    for side in 0..2 {
        let (found, expected) = (&snapshots[0].bodies[side], &reference.snapshots[0].bodies[side]);
        let distance = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        // Against the approach. The instants differ by up to a step of either model, 4e-8 s, in
        // which the bodies move by 1e-8 m: 1e-3 of the approach.
        assert!(distance(&found.displacement, &expected.displacement) < 3e-3 * run.max_approach);
        // The effective displacements differ by a rigid motion that no stress sees.
        let stress = |fields| {
            let input = &pair.inputs()[side];
            let fem_condensed::BodyInput::Sphere { mesh, material } = input else { panic!() };
            StressField::of(mesh, material, fields).cells
        };
        let (found, expected) = (stress(found), stress(expected));
        let pairs = found.as_flattened().iter().zip(expected.as_flattened());
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The explicit contact force is noisy by some parts in a thousand.
        assert!(worst < 1e-2 * run.peak_pressure, "{worst:e}");
    }
}
