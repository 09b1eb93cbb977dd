//! A ball on spheres so large that waves do not come back: the loss that the plan foretells is what
//! elements lose, and models without waves say so.

use std::path::Path;

use fem::Simulation;
use fem_case::Case;

/// A 10 mm ball of a soft, light glass, on one of the same material.
const BALL: &str = r#"
[material.glass]
density = "2390 kg/m^3"
youngs_modulus = "63 GPa"
poissons_ratio = 0.25

[[body]]
name = "block"
sphere = { diameter = "3 m" }
material = "glass"

[[body]]
name = "ball"
sphere = { diameter = "10 mm" }
material = "glass"
approach_speed = "3 m/s"

[output]
snapshots = []
"#;

fn simulation(overrides: &[&str]) -> Simulation {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case = Case::parse("ball.toml", BALL, Path::new("."), &overrides).unwrap();
    Simulation::new(case).unwrap()
}

/// What the plan says, as the number in "they take … of the restitution".
fn foretold(simulation: &Simulation) -> f64 {
    let warnings = simulation.setup().warnings().join("\n");
    let (_, rest) = warnings.split_once("of the energy, ").unwrap_or_else(|| panic!("{warnings}"));
    rest.split_once(' ').unwrap().0.parse().unwrap()
}

#[test]
fn elements_lose_what_is_foretold() {
    let fem = simulation(&["mesh.contact_element_size='40 um'"]);
    let lost = 1.0 - fem.run(&mut ()).restitution.unwrap();
    let foretold = foretold(&simulation(&["model.condensed={}"]));
    // A ball of finite size, and a speed that is no limit: v/c₀ = 6e-4.
    assert!((foretold / lost - 1.0).abs() < 0.15, "{foretold:e} {lost:e}");
    // And the model that has no waves loses nothing.
    let blind = simulation(&["model.condensed={}"]).run(&mut ()).restitution.unwrap();
    assert!(1.0 - blind < 1e-4);
}

#[test]
fn models_without_waves_say_so_and_the_others_need_not() {
    for model in ["model.condensed={}", "model.ting={}", "model.hertz={}", "model.law.hertz={}"] {
        assert!(foretold(&simulation(&[model])) > 1e-3, "{model}");
        // In a pair of like size waves run to and fro many times.
        let pair = simulation(&[model, "body.0.sphere.diameter='20 mm'"]);
        assert!(!pair.setup().warnings().join("").contains("waves"), "{model}");
    }
    let fem = simulation(&[]);
    assert!(fem.setup().warnings().is_empty(), "{:?}", fem.setup().warnings());
    let verdict =
        fem.setup().decisions.verdicts.iter().find(|v| v.name == "partner waves").unwrap();
    assert!(verdict.active && verdict.reason.contains("block"), "{}", verdict.reason);
}
