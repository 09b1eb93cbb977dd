//! `[model] auto = {}`: the chosen model, its reason, and its result within the tolerance of a more expensive model.

use std::path::Path;

use fem_case::Case;
use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::Simulation;
use fem_simulation::effects::{Effect, EffectStatus, FiniteSizeEffect};

use crate::scene::simulation_of as simulation;

/// Returns the case of two spheres, the first of which strikes the second.
fn scene(material: &str, [striker, target]: [&str; 2], speed: &str) -> String {
    let body = |name: &str, diameter: &str, speed: &str| {
        format!(
            "{{ name = '{name}', sphere.diameter = '{diameter}', material = 'stuff', approach_speed = '{speed}' }}"
        )
    };
    let bodies = [body("striker", striker, speed), body("target", target, "0 m/s")];
    format!("{material}\nbody = [{}]\n", bodies.join(", "))
}

const GLASS: &str =
    "material.stuff = { density = 2390, youngs_modulus = '63 GPa', poissons_ratio = 0.244 }";

const RELAXING: &str =
    "material.stuff = { density = 2390, youngs_modulus = '63 GPa', poissons_ratio = 0.244,
        relaxation = { acts_on = 'shear', terms = [{ weight = 0.6, decay_rate = '2708 1/s' }] } }";

const RUBBER: &str =
    "material.stuff = { density = 1100, youngs_modulus = '10 MPa', poissons_ratio = 0.45,
        relaxation = { acts_on = 'all', terms = [{ weight = 0.4, relaxation_time = '0.5 ms' }] } }";

/// The result of the chosen model does not advise another one for waves that a large partner takes.
#[test]
fn the_chosen_model_advises_no_other() {
    for material in ["nylon", "soda-lime-glass", "steel", "silicone"] {
        for speed in ["1 cm/s", "0.1 m/s", "1 m/s"] {
            let text = format!(
                "body = [{{ name = 'block', half_space = {{}}, material = 'lib:{material}' }},
                         {{ name = 'ball', sphere.diameter = '10 mm', material = 'lib:{material}', approach_speed = '{speed}' }}]"
            );
            let simulation = simulation(&text, &["model={auto={}}", "output.snapshots=[]"]);
            let warnings = simulation.setup().warnings().join("\n");
            let chosen = simulation.considered().iter().find(|it| it.chosen).unwrap();
            let of = format!("{material}, {speed}: {}", chosen.model);
            assert!(!warnings.contains("which this model leaves out"), "{of}: {warnings}");
        }
    }
}

/// Asserts that restitution (absolute), contact time and peak force (relative) agree within the tolerance.
fn within(tolerance: f64, found: &Collision, reference: &Collision, what: &str) {
    let restitution = found.restitution.unwrap() - reference.restitution.unwrap();
    let time = found.contact_time.unwrap() / reference.contact_time.unwrap() - 1.0;
    let force = found.peak_force.unwrap() / reference.peak_force.unwrap() - 1.0;
    for (change, name) in [(restitution, "e"), (time, "T"), (force, "F")] {
        assert!(change.abs() < tolerance, "{what}: {name} has an error of {change:e}");
    }
}

/// A scene, its overrides, the expected model, the reason against the one before it, and the tolerance.
type Row = (String, &'static [&'static str], &'static str, &'static str, f64);

fn table() -> Vec<Row> {
    let pair = ["22.2 mm", "15.9 mm"];
    vec![
        (scene(GLASS, pair, "0.5 m/s"), &[], "hertz = {}", "", 0.01),
        (
            scene(GLASS, pair, "0.5 m/s"),
            &["accuracy.tolerance='0.2 %'"],
            "hertz = { finite_size = true }",
            "lacks finite size",
            0.002,
        ),
        (
            scene(RELAXING, pair, "0.5 m/s"),
            &[],
            "ting = { finite_size = true }",
            "lacks viscoelasticity",
            0.01,
        ),
        (
            scene(RELAXING, pair, "0.5 m/s"),
            &["output.snapshots=[\"maximum\"]"],
            "condensed = {}",
            "cannot write the requested snapshots",
            0.01,
        ),
        // Relaxation changes the force by 3 % and the restitution by 5 %.
        (scene(RELAXING, pair, "0.5 m/s"), &["accuracy.tolerance='20 %'"], "hertz = {}", "", 0.2),
        (
            scene(GLASS, ["100 um", "80 um"], "2 mm/s"),
            &["accuracy.tolerance='0.5 %'"],
            "hertz = {}",
            "",
            0.005,
        ),
        // The contact is larger than a tenth of the spheres, whose compliance is more than a correction. Vibrations change
        // the force by 1.0 %, and the place of the edge between nodes by 0.4 %.
        (
            scene(RUBBER, ["20 mm", "20 mm"], "0.5 m/s"),
            &[],
            "condensed = { vibration_modes = 12 }",
            "lacks vibration",
            0.01,
        ),
        (
            scene(RUBBER, ["20 mm", "20 mm"], "1 cm/s"),
            &["accuracy.tolerance='2 %'"],
            "ting = { finite_size = true }",
            "lacks viscoelasticity",
            0.02,
        ),
        // Waves in a sphere eight times as large return in part, which modes of vibration resolve.
        (
            scene(GLASS, ["40 mm", "5 mm"], "20 m/s"),
            &[],
            "condensed = { vibration_modes = 12 }",
            "lacks partner waves",
            0.01,
        ),
        // Waves in a sphere a hundred times as large do not return.
        (
            scene(GLASS, ["1 m", "10 mm"], "3 m/s"),
            &["accuracy.tolerance='0.5 %'"],
            "ting = { finite_size = true }",
            "lacks partner waves",
            0.005,
        ),
        // An effect that elements alone have.
        (
            scene(GLASS, ["10 mm", "10 mm"], "20 m/s"),
            &["effects.bulk_viscosity='on'"],
            "fem = {}",
            "cannot do as [effects] says for bulk viscosity",
            0.02,
        ),
        // Strain that is not small.
        (
            scene(GLASS, ["10 mm", "10 mm"], "40 m/s"),
            &["accuracy.tolerance='0.6 %'"],
            "fem = {}",
            "lacks finite strain",
            0.02,
        ),
        // Inertia of the spheres' own deformation.
        (
            scene(GLASS, ["10 mm", "10 mm"], "40 m/s"),
            &["accuracy.tolerance='0.6 %'", "effects.finite_strain='off'"],
            "condensed = { vibration_modes = 12 }",
            "lacks vibration",
            0.006,
        ),
    ]
}

#[test]
fn the_cheapest_model_within_the_tolerance_is_chosen() {
    for (text, set, expected, why, tolerance) in table() {
        let set: Vec<&str> = set.iter().copied().chain(["model.auto={}"]).collect();
        let simulation = simulation(&text, &set);
        let considered = simulation.considered();
        let chosen = considered.iter().position(|considered| considered.chosen).unwrap();
        let reasons: Vec<String> =
            considered.iter().map(|c| format!("{}: {}", c.model, c.reason)).collect();
        assert_eq!(considered[chosen].model, expected, "{reasons:#?}");
        if chosen > 0 {
            let before = &considered[chosen - 1].reason;
            assert!(before.contains(why), "{expected}: {before}");
        }
        assert!(
            simulation.warnings_before().iter().all(|w| !w.contains("tolerance")),
            "{reasons:#?}"
        );
        let found = simulation.run(&mut ());
        let reference = reference(&text);
        within(tolerance, &found, &reference, expected);
        // The resolved case names the model, and gives the same.
        let again = Simulation::new(Case::of(simulation.resolved().clone()).unwrap()).unwrap();
        assert!(again.considered().is_empty());
        assert_eq!(again.run(&mut ()), found, "{expected}");
    }
}

/// Computes the reference with the condensed model on elements of half the default size, with modes, or with the radiation
/// term if a body is large.
fn reference(text: &str) -> Collision {
    let model = match text.contains("'1 m'") {
        true => "model.condensed={}",
        false => "model.condensed={vibration_modes=12}",
    };
    let size =
        simulation(text, &[model]).setup().elements.as_ref().unwrap().plan.contact_element_size;
    let size = format!("mesh.contact_element_size={}", 0.5 * size);
    simulation(text, &[model, &size, "output.snapshots=[]"]).run(&mut ())
}

#[test]
fn a_tolerance_that_no_model_meets_is_warned_of() {
    let text = scene(RELAXING, ["22.2 mm", "15.9 mm"], "0.5 m/s");
    let simulation = simulation(&text, &["model.auto={}", "accuracy.tolerance=1e-5"]);
    let warnings = simulation.warnings_before();
    assert!(warnings[0].contains("no model is known"), "{warnings:?}");
    let chosen = simulation.considered().iter().find(|considered| considered.chosen).unwrap();
    assert_eq!(chosen.model, "ting = { finite_size = true }");
    assert!(chosen.reason.contains("comes closest"), "{}", chosen.reason);
}

/// The peak pressure has a tolerance of its own.
#[test]
fn the_tolerance_of_the_peak_pressure_decides() {
    let text = scene(GLASS, ["22.2 mm", "15.9 mm"], "0.5 m/s");
    let asked = |tolerance: &str| {
        let tolerance = format!("accuracy.tolerance={{peak_pressure={tolerance}}}");
        let nominal = "effects.finite_strain='off'";
        let simulation = simulation(&text, &["model.auto={}", &tolerance, nominal]);
        let chosen = simulation.considered().iter().find(|c| c.chosen).unwrap().model;
        let warnings = simulation.warnings_before();
        (chosen, warnings.iter().any(|warning| warning.contains("no model is known")))
    };
    assert_eq!(asked("0.03"), ("hertz = {}", false));
    // Half-spaces lack the inclination of the surfaces, which changes the pressure by 0.4 % at most.
    assert_eq!(asked("0.002"), ("condensed = {}", false));
    assert!(asked("1e-6").1, "no model is as fine");
}

/// The weight of a ball that is laid down makes the contact ten times as wide as an impact at its speed, so models with the
/// first order of the finite size are not valid.
#[test]
fn the_weight_counts_for_the_width_of_the_contact() {
    let text = "
        material.stuff = { density = 6744, youngs_modulus = '5.5 GPa', poissons_ratio = 0.0,
            relaxation = { acts_on = 'all', terms = [{ weight = 0.48, decay_rate = 3 }] } }
        material.soft = { density = 9526, youngs_modulus = '1 GPa', poissons_ratio = 0.0 }
        body = [{ name = 'floor', sphere.diameter = '2 m', held = true, material = 'soft' },
                { name = 'ball', sphere.diameter = '2.66 m', material = 'stuff' }]
        start.gap = '0.2 um'
        gravity.acceleration = 13.2
        model.auto = {}";
    let case = Case::parse("laid.toml", text, Path::new("."), &[]).unwrap();
    let laid = Simulation::new(case).unwrap();
    assert_eq!(laid.run(&mut ()).stop(), None);
    for considered in laid.considered().iter().filter(|it| it.model.contains("finite_size")) {
        assert!(considered.reason.contains("outside the validity"), "{considered:?}");
    }
}

/// Where the contact of a first-order model is as wide as it may be, a run finds another width than the estimate, and no
/// chosen model stops there.
#[test]
fn no_chosen_model_stops_at_its_own_limit() {
    let is_first_order = |speed: f64| {
        let text = scene(RUBBER, ["10 mm", "10 mm"], &format!("{speed:?} m/s"));
        let auto = simulation(&text, &["model.auto={}", "accuracy.tolerance='20 %'"]);
        let chosen = auto.considered().iter().find(|it| it.chosen).unwrap();
        let is_first_order = chosen.model.contains("finite_size");
        assert!(!is_first_order || auto.run(&mut ()).stop().is_none(), "{speed}");
        is_first_order
    };
    let (mut low, mut high) = (0.1, 5.0);
    assert!(is_first_order(low) && !is_first_order(high));
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if is_first_order(middle) { low = middle } else { high = middle }
    }
}

/// Steel on rubber at 15 m/s, a contact as wide as the spheres, where the error of small strain cannot be estimated.
const FLAT: &str = r#"
    material.steel = { density = 7850, youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
    material.stuff = { density = 1171, youngs_modulus = 5.17e6, poissons_ratio = 0.256,
        relaxation = { acts_on = "all", terms = [{ weight = 0.05, relaxation_time = "6.1 ms" }] } }
    body = [{ name = "lower", sphere.diameter = "38.8 mm", material = "steel" },
            { name = "upper", sphere.diameter = "36.3 mm", material = "stuff", approach_speed = 14.57 }]
    model.auto = {}"#;

/// An error that cannot be estimated does not count as zero.
#[test]
fn a_model_with_an_unknown_error_is_not_chosen() {
    for set in [
        &[][..],
        &["body.1.approach_speed=25"],
        &["material.stuff.relaxation.terms.0.weight=0"],
        &["accuracy.tolerance='20 %'"],
    ] {
        let simulation = simulation(FLAT, set);
        for considered in simulation.considered() {
            let is_fem = considered.model.starts_with("fem");
            assert_eq!(considered.chosen, is_fem, "{set:?}: {considered:?}");
            let is_out_of_reach = considered.reason.contains("outside the validity");
            let is_unknown = considered.reason.contains("cannot be estimated");
            assert!(is_fem || is_unknown || is_out_of_reach, "{set:?}: {considered:?}");
            assert_eq!(considered.error.peak_pressure_pa.is_some(), is_fem, "{considered:?}");
        }
    }
}

/// The result of a chosen model does not advise another one, for spheres of many sizes, stiffnesses and speeds.
#[test]
fn no_choice_advises_another_model() {
    let mut state = 20_u64;
    let mut random = |least: f64, most: f64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = (state >> 11) as f64 / (1_u64 << 53) as f64;
        least * (most / least).powf(share)
    };
    for _ in 0..12 {
        let (modulus, mach) = (random(1e5, 1e11), random(1e-3, 0.5));
        let speed = mach * (modulus / 2.8 / 1100.0).sqrt();
        let material = format!(
            "material.stuff={{ density=1100, youngs_modulus={modulus}, poissons_ratio=0.4 }}"
        );
        let diameters = [10.0, 10.0 * random(1.0, 3.0)].map(|mm| format!("{mm} mm"));
        let text =
            scene(&material, diameters.each_ref().map(String::as_str), &format!("{speed} m/s"));
        let small = ["model.auto={}", "effects.finite_strain='off'", "accuracy.tolerance='5 %'"];
        let simulation = simulation(&text, &small);
        let warnings = simulation.warnings_before();
        let advises = |warning: &&String| warning.contains("use model fem");
        let chosen = simulation.considered().iter().find(|it| it.chosen).unwrap().model;
        assert_eq!(warnings.iter().find(advises), None, "{chosen} at {mach} of the shear waves");
    }
}

/// Half-spaces have an error of the peak pressure, which the error bar includes, and are not chosen for a smaller
/// tolerance. The reference pressures are recorded from explicit elements and condensed bodies at 0.05 %.
#[test]
fn the_bar_includes_the_pressure_error_of_half_spaces() {
    let like = |nu: f64, young: f64, density: f64, diameter: f64, speed: f64| {
        let material = format!(
            "material.stuff={{ density={density}, youngs_modulus={young}, poissons_ratio={nu} }}"
        );
        let diameter = format!("{diameter} m");
        scene(&material, [&diameter, &diameter], &format!("{speed} m/s"))
    };
    let auxetic = like(-0.08076, 1.801_58e10, 2450.94, 2.952_95e-3, 0.134_785);
    let relaxing =
        "material.stuff.relaxation={acts_on='all',terms=[{weight=0.3,relaxation_time=4.024e-5}]}";
    let more_auxetic = like(-0.2617, 3.889_26e10, 5921.74, 1.753_69e-4, 0.089_663_4);
    for (text, model, more, truth) in [
        (&auxetic, "model.hertz={}", "output.report=false", 216.57e6),
        (&more_auxetic, "model.ting={finite_size=true}", relaxing, 425.11e6),
    ] {
        let run = simulation(text, &[more, model]);
        let collision = run.run(&mut ());
        let status = EffectStatus::default();
        let error =
            FiniteSizeEffect.model_form_error(run.case().scene(), &run.setup().estimate, &status);
        let bar = error.size(QuantityOfInterest::PeakPressure).unwrap();
        let error = (collision.peak_pressure.unwrap() - truth).abs();
        // The truth is known to 0.3 %.
        assert!(error < bar + 0.003 * truth && bar < 3.0 * error, "{error} {bar}");
        let asked = simulation(text, &[more, "model.auto={}", "accuracy.tolerance='0.1 %'"]);
        let chosen = asked.considered().iter().find(|it| it.chosen).unwrap();
        assert!(
            chosen.model.starts_with("condensed") || chosen.model.starts_with("fem"),
            "{chosen:?}"
        );
    }
}
