//! Mirror symmetry: identical bodies are computed as one, with the results of both.

use fem_collision::{Account, Collision};
use fem_simulation::Simulation;

use crate::scene::{decision_on, refused_of, simulation_of};

const TWINS: &str = r#"
    material.glass = { density = "2390 kg/m^3", youngs_modulus = "63 GPa", poissons_ratio = 0.244 }
    body = [{ name = "lower", sphere.diameter = "16 mm", material = "glass", approach_speed = "0.7 m/s" },
            { name = "upper", sphere.diameter = "16 mm", material = "glass", approach_speed = "-0.2 m/s" }]
    mesh.contact_element_size = "60 um"
    start.gap = "2 um""#;

const RELAXING: &str =
    "material.glass.relaxation={acts_on='shear', terms=[{weight=0.8, decay_rate=5e3}]}";

fn run(overrides: &[&str]) -> (Simulation, Collision) {
    let simulation = simulation_of(TWINS, overrides);
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

fn is_on(simulation: &Simulation) -> bool {
    decision_on(simulation, "mirror symmetry").active
}

#[track_caller]
fn close(a: f64, b: f64, scale: f64, relative: f64) {
    assert!((a - b).abs() <= relative * scale.abs(), "{a:e} {b:e}");
}

#[test]
fn mirrored_scene_gives_the_results_of_the_full_scene() {
    for (model, relative) in [
        // The steps are the same, and rounding does not grow.
        ("model.fem={}", 1e-8),
        // One factor replaces a sum of two.
        ("model.condensed={vibration_modes=4}", 1e-8),
        ("model.condensed={penalty_springs=true}", 1e-8),
    ] {
        for relaxation in ["material.glass.density=2390", RELAXING] {
            let overrides = [model, relaxation];
            let (half, mirrored) = run(&overrides);
            let (both, whole) = run(&[&overrides[..], &["effects.mirror_symmetry='off'"]].concat());
            assert!(is_on(&half) && !is_on(&both));
            assert_eq!(mirrored.steps, whole.steps, "{model}");
            if let (Some(half), Some(both)) = (mirrored.element_updates, whole.element_updates) {
                assert_eq!(2 * half, both);
            }
            let close = |a: Option<f64>, b: Option<f64>| {
                close(a.unwrap(), b.unwrap(), b.unwrap(), relative);
            };
            close(mirrored.restitution, whole.restitution);
            close(mirrored.contact_time, whole.contact_time);
            close(mirrored.peak_force, whole.peak_force);
            close(mirrored.max_approach, whole.max_approach);
            close(mirrored.max_contact_radius, whole.max_contact_radius);
            close(mirrored.peak_pressure, whole.peak_pressure);
            close(mirrored.initial_energy, whole.initial_energy);
            for (a, b) in mirrored.bodies.iter().zip(&whole.bodies) {
                close(a.velocity_after, b.velocity_after);
                assert_eq!(a.mass, b.mass);
                close(a.moved_mass, b.moved_mass);
                assert_eq!(a.elements, b.elements);
            }
            rows_are_those_of_the_whole(&mirrored, &whole, relative);
            snapshots_are_those_of_the_whole(&half, &mirrored, &whole);
        }
    }
}

fn rows_are_those_of_the_whole(mirrored: &Collision, whole: &Collision, relative: f64) {
    assert_eq!(mirrored.history.len(), whole.history.len());
    let energy = whole.initial_energy.unwrap();
    for (a, b) in mirrored.history.iter().zip(&whole.history) {
        close(a.time, b.time, b.time, 1e-12);
        close(a.approach, b.approach, whole.max_approach.unwrap(), relative);
        for (a, b) in a.velocity.iter().zip(b.velocity) {
            close(*a, b, 0.7, relative);
        }
        for account in Account::all() {
            match [a, b].map(|row| row.energy(account)) {
                [Some(a), Some(b)] => close(a, b, energy, 10.0 * relative),
                accounts => assert_eq!(accounts, [None; 2]),
            }
        }
    }
}

fn snapshots_are_those_of_the_whole(half: &Simulation, mirrored: &Collision, whole: &Collision) {
    assert_eq!(mirrored.snapshots.len(), whole.snapshots.len());
    let meshes = half.model().meshes();
    let (approach, speed) = (whole.max_approach.unwrap(), 0.7);
    for (a, b) in mirrored.snapshots.iter().zip(&whole.snapshots) {
        assert_eq!(a.label, b.label);
        for side in 0..2 {
            let (a, b) = (&a.bodies[side], &b.bodies[side]);
            assert_eq!(a.displacement.len(), meshes[side].unwrap().nodes().len());
            let pairs = |a: &[[f64; 2]], b: &[[f64; 2]]| -> Vec<[f64; 2]> {
                let pairs = a.as_flattened().iter().zip(b.as_flattened());
                pairs.map(|(a, b)| [*a, *b]).collect()
            };
            for [a, b] in pairs(&a.displacement, &b.displacement) {
                close(a, b, approach, 1e-5);
            }
            for [a, b] in pairs(&a.velocity, &b.velocity) {
                close(a, b, speed, 1e-4);
            }
            assert_eq!(a.effective.len(), b.effective.len());
        }
    }
}

/// Different bodies are both computed, and mirror symmetry cannot be forced on them, nor on a model without meshes.
#[test]
fn only_identical_bodies_are_mirrored() {
    for difference in [
        "body.1.sphere.diameter='16.1 mm'",
        "body.1={name='floor', wall={}}",
        "body.1.material='ice'",
    ] {
        let ice = "material.ice={density=917, youngs_modulus=9.3e9, poissons_ratio=0.33}";
        assert!(!is_on(&simulation_of(TWINS, &[ice, difference])), "{difference}");
        for model in ["model.fem={}", "model.condensed={}", "model.ting={}"] {
            let forced = [ice, difference, "effects.mirror_symmetry='on'", model];
            let error = refused_of(TWINS, &forced);
            assert_eq!(error.key(), Some("effects.mirror_symmetry"), "{error}");
        }
    }
    assert!(is_on(&simulation_of(TWINS, &["effects.mirror_symmetry='on'"])));
}
