//! Warnings about plastic yield, in every model.

use fem::effects::EffectDecision;

use crate::scene::{ELASTIC_GLASS, simulation_of};

/// Steel spheres of 5 mm at 5 m/s; real steel yields at some cm/s.
const STEEL: &str = r#"
[material.steel]
density = "7850 kg/m^3"
youngs_modulus = "210 GPa"
poissons_ratio = 0.3

[[body]]
name = "lower"
sphere = { diameter = "5 mm" }
material = "steel"
approach_speed = "5 m/s"

[[body]]
name = "upper"
sphere = { diameter = "5 mm" }
material = "steel"
"#;

const MODELS: [&str; 5] = [
    "model.fem={}",
    "model.condensed={}",
    "model.ting={}",
    "model.hertz={}",
    "model.law.falcon.c=0",
];

fn decision_on(text: &str, overrides: &[&str]) -> (EffectDecision, String) {
    let simulation = simulation_of(text, overrides);
    let decision = crate::scene::decision_on(&simulation, "plastic yield").clone();
    (decision, simulation.setup().warnings().join("\n"))
}

#[test]
fn an_impossible_pressure_is_reported() {
    for model in MODELS {
        let (decision, warnings) = decision_on(STEEL, &[model]);
        // The pressure is 9 GPa, a thirteenth of E*; the stress is 0.62 of it.
        assert!(warnings.contains("1/13 of the contact modulus"), "{model}: {warnings}");
        assert!(warnings.contains("yield_strength"), "{warnings}");
        assert!(!decision.active && decision.reason.contains("Pa"), "{}", decision.reason);
    }
}

#[test]
fn a_yield_strength_gives_the_speed_and_the_range() {
    for model in MODELS {
        let (decision, warnings) =
            decision_on(STEEL, &[model, "material.steel.yield_strength='1 GPa'"]);
        // Johnson's ½mv² = 53 R³Y⁵/E*⁴ is 0.067 m/s; then Thornton and Johnson at 72 times that.
        assert!(warnings.contains("yields from 69.1"), "{model}: {warnings}");
        assert!(warnings.contains("from 0.41 to 0.78"), "{warnings}");
        assert!(decision.reason.contains("lacks it"), "{}", decision.reason);
    }
}

/// Balls of steel that flow get the warning of yield alone; slow ones that of the loss that is not computed.
#[test]
fn yield_silences_what_it_makes_pointless() {
    let ball = |text: &str| text.replace("\"steel\"", "\"lib:steel\"");
    for model in &MODELS[..4] {
        let (_, fast) = decision_on(&ball(STEEL), &[model]);
        assert!(fast.contains("yields from"), "{model}: {fast}");
        assert_eq!(fast.lines().count(), 1, "{model}: {fast}");
        let (_, slow) = decision_on(&ball(STEEL), &[model, "body.0.approach_speed='1 mm/s'"]);
        assert!(slow.contains("no relaxation for"), "{model}: {slow}");
        assert_eq!(slow.lines().count(), 1, "{model}: {slow}");
    }
}

#[test]
fn no_warning_without_yield() {
    for overrides in [&[][..], &["material.glass.yield_strength='3 GPa'"]] {
        let (decision, warnings) = decision_on(ELASTIC_GLASS, overrides);
        assert_eq!(warnings, "");
        assert!(!decision.active);
    }
    // Not the library's steel, which has no relaxation.
    let slow = [
        "material.steel.yield_strength='1 GPa'",
        "material.steel.density=7800",
        "body.0.approach_speed='1 cm/s'",
    ];
    let (decision, warnings) = decision_on(STEEL, &slow);
    assert_eq!(warnings, "");
    assert!(decision.reason.contains("it yields from"), "{}", decision.reason);
}

#[test]
fn the_body_that_yields_first_is_named() {
    let soft = "material.soft={density=7850, youngs_modulus=210e9, poissons_ratio=0.3, \
                yield_strength=1e8}";
    let overrides = ["material.steel.yield_strength=1e9", soft, "body.1.material='soft'"];
    let (_, warnings) = decision_on(STEEL, &overrides);
    assert!(warnings.contains("upper yields from"), "{warnings}");
    assert!(!warnings.contains("lower yields"), "{warnings}");
}

/// Soft materials and those with a hyperelastic law are strained without yield and have no warning; their partner, and
/// materials with a yield strength, have one.
#[test]
fn rubber_does_not_yield() {
    let soft = "material.steel={density=1100, youngs_modulus='50 MPa', poissons_ratio=0.45}";
    let slow = "body.0.approach_speed='5 m/s'";
    let beside = "material.hard={density=1100, youngs_modulus='200 MPa', poissons_ratio=0.4}";
    let stiff = "material.hard={density=8000, youngs_modulus='200 GPa', poissons_ratio=0.3}";
    for model in MODELS {
        let (decision, warnings) = decision_on(STEEL, &[model, soft, slow]);
        assert!(!warnings.contains("plastic flow"), "{model}: {warnings}");
        assert!(decision.reason.contains("do not yield"), "{}", decision.reason);
        let (_, warnings) = decision_on(STEEL, &[model, "material.steel.hyperelastic='hencky'"]);
        assert!(!warnings.contains("plastic flow"), "{model}: {warnings}");
        // The stiffer body yields.
        let fast = "body.0.approach_speed='30 m/s'";
        let (_, warnings) =
            decision_on(STEEL, &[model, soft, beside, "body.1.material='hard'", fast]);
        assert!(warnings.contains("plastic flow: the stress reaches upper"), "{model}: {warnings}");
        // A body far stiffer than the rubber does not yield.
        let (_, warnings) =
            decision_on(STEEL, &[model, soft, stiff, "body.1.material='hard'", slow]);
        assert!(!warnings.contains("plastic flow"), "{model}: {warnings}");
        let strength = "material.steel.yield_strength='1 MPa'";
        let (_, warnings) = decision_on(STEEL, &[model, soft, slow, strength]);
        assert!(warnings.contains("yields from"), "{model}: {warnings}");
    }
}
