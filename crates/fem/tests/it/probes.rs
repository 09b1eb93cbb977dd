//! Probes: what they see is what the fields are, and that nothing else sees them.

use std::path::Path;

use fem::{Case, Collision, Simulation, Snapshot};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
const COARSE: &str = "mesh.contact_element_size='60 um'";
/// Contact pole of the target, a place below it off the axis, and far in the striker.
const PROBES: &str = "output.probe=[{body='target', r=0, y=0}, \
    {body='target', r='0.1 mm', y='0.15 mm'}, {body='striker', r=0, y='-11.1 mm'}]";

fn simulation(overrides: &[&str]) -> Simulation {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Simulation::new(Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap()).unwrap()
}

fn run(overrides: &[&str]) -> Collision {
    simulation(overrides).run(&mut ())
}

/// The one whose approach is largest.
fn deepest(seen: &[Snapshot]) -> &Snapshot {
    seen.iter().max_by(|one, other| one.approach.total_cmp(&other.approach)).unwrap()
}

/// Steps, bits and warnings of a run are the same with probes; without there is nothing of them.
#[test]
fn nothing_else_sees_probes() {
    for model in ["model.fem={}", "model.condensed={}"] {
        let without = run(&[COARSE, model]);
        let mut with = run(&[COARSE, model, PROBES]);
        assert!(without.probes.is_empty() && with.probes.len() > 100, "{}", with.probes.len());
        with.probes.clear();
        assert_eq!(with, without);
    }
}

/// Displacement is what velocity adds up to, and the body's centre goes as its mass centre does: to the
/// strains there, some 1e-4 of the approach.
#[test]
fn velocity_adds_up_to_displacement() {
    for model in ["model.fem={}", "model.condensed={}"] {
        let seen = run(&[COARSE, model, PROBES]).probes;
        for (side, k) in [(1, 0), (1, 1), (0, 2)] {
            let at =
                |one: &Snapshot| (one.displacement(side)[k][1], one.bodies[side].velocity[k][1]);
            let mut way = 0.0;
            for two in seen.windows(2) {
                let ((_, before), (_, after)) = (at(&two[0]), at(&two[1]));
                way += 0.5 * (two[1].time - two[0].time) * (before + after);
            }
            let moved = at(&seen[seen.len() - 1]).0 - at(&seen[0]).0;
            // The trapezoidal rule over some hundred instants; the striker goes 30 um.
            assert!((way - moved).abs() < 5e-8, "{model} {side} {k}: {way:e} {moved:e}");
        }
        let first = &seen[0];
        assert_eq!(first.displacement(0)[2], [0.0; 2]);
        // What the first difference of the springs adds in the condensed model.
        assert!((first.bodies[0].velocity[2][1] - 0.5).abs() < 1e-3);
    }
}

/// The stress at the pole is the pressure there, and both models see the same.
#[test]
fn both_models_see_the_same_stress() {
    let [explicit, condensed] =
        ["model.fem={}", "model.condensed={}"].map(|model| run(&[model, PROBES]));
    let stress = |collision: &Collision, k: usize| deepest(&collision.probes).bodies[1].stress[k];
    let pressure = explicit.peak_pressure.unwrap();
    // The fit to elements beside the edge of the body, and the instant.
    assert!((stress(&explicit, 0)[1] / pressure + 1.0).abs() < 0.04, "{:?}", stress(&explicit, 0));
    for k in [0, 1] {
        let (a, b) = (stress(&explicit, k), stress(&condensed, k));
        for component in 0..4 {
            // A share of the pressure: waves, the contact's last node, the nearest of 200 instants.
            let apart = (a[component] - b[component]).abs() / pressure;
            assert!(apart < 0.02, "{k} {component}: {a:?} {b:?}");
        }
    }
    // Below the edge of the contact there is shear, and more pressure than tension.
    let [rr, yy, tt, ry] = stress(&explicit, 1);
    assert!(yy < -0.5 * pressure && rr < 0.0 && tt < 0.0 && ry.abs() > 0.05 * pressure);
}

/// Of like bodies half is computed: its image sees the mirror image.
#[test]
fn an_image_sees_the_mirror_image() {
    let like = ["body.0.sphere.diameter='15.9 mm'", "mesh.contact_element_size='60 um'"];
    let places = "output.probe=[{body='striker', r='0.1 mm', y='-0.15 mm'}, \
        {body='target', r='0.1 mm', y='0.15 mm'}]";
    let [half, whole] = ["on", "off"].map(|switch| {
        let symmetry = format!("effects.mirror_symmetry='{switch}'");
        run(&[like[0], like[1], places, &symmetry])
    });
    let (half, whole) = (deepest(&half.probes), deepest(&whole.probes));
    let [rr, yy, tt, ry] = half.bodies[0].stress[0];
    assert_eq!(half.bodies[1].stress[1], [rr, yy, tt, -ry]);
    for (side, k) in [(0, 0), (1, 1)] {
        let ([a_r, a_y], [b_r, b_y]) = (half.displacement(side)[k], whole.displacement(side)[k]);
        // The contact of both is that of matching nodes; instants differ by a step or two.
        assert!((a_r - b_r).abs() < 2e-8 && (a_y - b_y).abs() < 2e-8, "{a_r} {b_r} {a_y} {b_y}");
    }
}

/// Gone on from a memory, in the frame of another observer, and stopped: what was seen is there.
#[test]
fn probes_are_in_the_memory_of_a_run() {
    let simulation = simulation(&[COARSE, PROBES]);
    let mut course = simulation.start();
    while course.progress().fraction < 0.4 && course.advance(&mut ()) {}
    let memory = serde_json::to_string(&course.restart_state()).unwrap();
    let stopped = course.finish();
    let mut resumed = simulation.resume(serde_json::from_str(&memory).unwrap()).unwrap();
    while resumed.advance(&mut ()) {}
    let whole = simulation.run(&mut ());
    assert_eq!(resumed.finish(), whole);
    assert!(stopped.probes.len() > 50 && whole.probes.starts_with(&stopped.probes[..50]));
}

#[test]
fn a_place_that_is_not_computed_is_refused() {
    let refusal = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let case = Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap();
        Simulation::new(case).unwrap_err()
    };
    let block = "body.0={name='block', half_space={}, material='glass'}";
    let far = "output.probe=[{body='block', r='1 m', y='-1 m'}]";
    let error = refusal(&[block, "body.1.approach_speed=0.5", far, COARSE]);
    assert!(error.to_string().contains("does not reach"), "{error}");
    let stiff = [
        "material.stiff={density=2390, youngs_modulus=6.3e12, poissons_ratio=0.244}",
        "body.0.material='stiff'",
        "effects.rigid_partner='on'",
        PROBES,
    ];
    assert!(refusal(&stiff).to_string().contains("rigid body"));
}

/// A model without fields says so.
#[test]
fn a_model_without_fields_says_so() {
    let simulation = simulation(&["model.ting={}", PROBES]);
    let warnings = simulation.warnings(&simulation.run(&mut ())).join("\n");
    assert!(warnings.contains("output.probe has no effect"), "{warnings}");
}
