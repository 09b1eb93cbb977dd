//! Warnings about plastic flow, in every model.

use fem::QuantityOfInterest;
use fem::effects::EffectDecision;
use fem_laws::ImpactQuantities;

use crate::scene::{ELASTIC_GLASS, simulation_of, summary_of};

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
    let decision = crate::scene::decision_on(&simulation, "plastic flow").clone();
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

/// The estimate of closed forms leads in all models but a contact law, whose loss is the user's, and only beyond first yield.
#[test]
fn the_estimate_leads_but_for_contact_laws() {
    for model in MODELS {
        let strength = "material.steel.yield_strength='1 GPa'";
        let estimate = |set: &[&str]| {
            summary_of(STEEL, &[&[model, strength, "output.snapshots=[]"], set].concat()).estimate
        };
        let leads = estimate(&[]).map(|it| it.range(QuantityOfInterest::Restitution).unwrap());
        let expected = (!model.contains("law")).then_some([0.35, 0.8]);
        assert_eq!(leads.is_some(), expected.is_some(), "{model}");
        if let (Some([low, high]), Some([least, most])) = (leads, expected) {
            assert!(least < low && low < high && high < most, "{model}: {low} {high}");
        }
        assert!(estimate(&["body.0.approach_speed='5 cm/s'"]).is_none(), "{model}");
    }
}

/// The strength that is asked for first is that of the softer body; a harder or rubber-like one, and one with a strength, is
/// not asked for.
#[test]
fn the_softer_body_is_asked_for_its_strength_first() {
    let lead =
        "material.lead={ density='11340 kg/m^3', youngs_modulus='16 GPa', poissons_ratio=0.44 }";
    let strength = "material.steel.yield_strength='1 GPa'";
    let warnings = |set: &[&str]| {
        let set = [&[lead, strength, "model.hertz={}", "body.1.material='lead'"][..], set].concat();
        decision_on(STEEL, &set).1
    };
    let question =
        "for plastic flow give upper, which is softer, its material.NAME.yield_strength first";
    let asked = warnings(&["body.0.approach_speed='20 m/s'"]);
    assert!(asked.contains(question), "{asked}");
    for set in [
        "material.lead.yield_strength='12 MPa'",
        "material.lead.youngs_modulus='120 GPa'",
        "material.lead.youngs_modulus='50 MPa'",
    ] {
        let other = warnings(&["body.0.approach_speed='20 m/s'", set]);
        assert!(!other.contains("which is softer"), "{set}: {other}");
    }
}

/// The advice to compute flow names what has to leave the material for it: a relaxation, or a named hyperelastic law.
#[test]
fn advice_to_compute_flow_names_what_it_excludes() {
    let relaxation = "material.steel.relaxation={ acts_on='all', terms=[{ weight=0.1, relaxation_time='1 ms' }] }";
    let law = "material.steel.hyperelastic='neo-hooke'";
    for (set, words) in [
        (vec![], "[material.NAME.flow] with model fem"),
        (vec![relaxation], "[material.NAME.flow] in place of its relaxation with model fem"),
        (vec![law], "[material.NAME.flow] in place of material.NAME.hyperelastic with model fem"),
    ] {
        let strength = "material.steel.yield_strength='1 GPa'";
        let (_, warnings) = decision_on(STEEL, &[&[strength, "model.fem={}"], &set[..]].concat());
        assert!(warnings.contains(words), "{warnings}");
    }
}

/// If one body flows and the other yields too, the advice names the other: elements compute flow if every body that yields
/// has a rule.
#[test]
fn a_body_that_yields_beside_a_flowing_one_is_named() {
    let soft = "material.soft={ density='2700 kg/m^3', youngs_modulus='70 GPa', poissons_ratio=0.33, yield_strength='0.9 GPa' }";
    let flow = "material.steel.flow={ yield_strength='0.5 GPa' }";
    let (_, warnings) = decision_on(STEEL, &["model.fem={}", flow, soft, "body.1.material='soft'"]);
    let advice =
        "upper yields too: with its own [material.NAME.flow] model fem computes plastic flow";
    assert!(warnings.contains("lower yields from") && warnings.contains(advice), "{warnings}");
}

#[test]
fn a_yield_strength_gives_the_speed_and_an_estimate() {
    for model in MODELS {
        let (decision, warnings) =
            decision_on(STEEL, &[model, "material.steel.yield_strength='1 GPa'"]);
        // Johnson's ½mv² = 53 R³Y⁵/E*⁴ is 0.067 m/s; then the mean-pressure law at 72 times that.
        assert!(warnings.contains("yields from 69.1"), "{model}: {warnings}");
        assert!(warnings.contains("a restitution of 0.59 to 0.62"), "{warnings}");
        assert!(decision.reason.contains("not computed"), "{}", decision.reason);
    }
}

/// Balls of steel that flow get the warning of yield alone; slow ones get none.
#[test]
fn yield_silences_what_it_makes_pointless() {
    let ball = |text: &str| text.replace("\"steel\"", "\"lib:steel\"");
    for model in &MODELS[..4] {
        let (_, fast) = decision_on(&ball(STEEL), &[model]);
        assert!(fast.contains("yields from"), "{model}: {fast}");
        assert_eq!(fast.lines().count(), 1, "{model}: {fast}");
        let (_, slow) = decision_on(&ball(STEEL), &[model, "body.0.approach_speed='1 mm/s'"]);
        assert_eq!(slow, "", "{model}");
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
        "material.steel.poissons_ratio=0.29",
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

/// Restitution of an elastic–perfectly plastic sphere at E*/Y = 230, over the speed in speeds of first yield: finite elements at
/// finite strain, which agree with three other programs.
const RESTITUTION: [(f64, f64); 3] = [(1.5, 0.99), (2.0, 0.98), (5.0, 0.91)];
/// Speed in speeds of first yield, and restitution, contact time, peak force, approach and contact radius over Hertz' values
/// at E*/Y = 230: rows of `validation/data/flow_map.csv`.
const IMPACTS: [(f64, [f64; 5]); 4] = [
    (3.0, [0.94717, 0.97417, 0.98303, 1.0013, 1.0277]),
    (10.0, [0.83024, 0.95587, 0.92322, 1.0328, 1.1184]),
    (30.0, [0.70948, 0.95384, 0.84974, 1.0907, 1.2496]),
    (100.0, [0.5695, 0.98046, 0.75127, 1.1942, 1.4181]),
];

const BALL: &str = "
[material.metal]
density = 1000
youngs_modulus = 209.3e6
poissons_ratio = 0.3
yield_strength = 1e6

[[body]]
name = 'wall'
wall = {}

[[body]]
name = 'ball'
sphere = { diameter = 0.02 }
material = 'metal'
approach_speed = 1

[model.hertz]
";

/// The part of plastic flow in the error bars of a model without it covers impacts of an elastic–perfectly plastic sphere on a rigid wall.
#[test]
fn error_bars_cover_plastic_impacts() {
    let first = simulation_of(BALL, &[""; 0]).setup().estimate.hertz;
    let (modulus, yield_strength) = (first.pair().contact_modulus(), 1e6);
    assert!((modulus / yield_strength / 230.0 - 1.0).abs() < 1e-3, "{modulus}");
    // p₀ = 1.61 Y at first yield.
    let yields_at = (1.61 * yield_strength / first.peak_pressure()).powf(2.5);
    let speeds = RESTITUTION.map(|(over, restitution)| (over, vec![restitution]));
    let impacts = IMPACTS.map(|(over, of_hertz)| (over, of_hertz.to_vec()));
    for (over, of_hertz) in speeds.into_iter().chain(impacts) {
        let speed = over * yields_at;
        let simulation = simulation_of(BALL, &[&format!("body.1.approach_speed={speed}")]);
        let summary = simulation.summary(&simulation.run(&mut ()));
        let hertz = ImpactQuantities::from(&simulation.setup().estimate.hertz).in_order();
        for (k, plastic) in of_hertz.into_iter().enumerate() {
            let quantity = QuantityOfInterest::ALL[k];
            let computed = summary.collision.number(quantity).unwrap();
            let bar = summary.uncertainty.parts(quantity).model.unwrap();
            let plastic = plastic * hertz[k];
            assert!(
                (computed - plastic).abs() <= bar,
                "{over} v_y: {quantity:?} {computed} ± {bar}, plastic {plastic}"
            );
        }
    }
}

/// The error of each law that dents covers its distance from elements, is of the size of that, and is there however the law is given
/// its strength.
#[test]
fn laws_that_dent_carry_their_errors() {
    let first = simulation_of(BALL, &[""; 0]).setup().estimate.hertz;
    let yields_at = (1.61 * 1e6 / first.peak_pressure()).powf(2.5);
    for (law, strength) in [
        ("thornton", "yield_pressure='1.61 MPa'"),
        ("johnson", "hardness='3 MPa'"),
        ("jackson_green", "yield_strength='1 MPa'"),
        ("brake", ""),
        ("mdr", ""),
        ("mean_pressure", ""),
    ] {
        for (over, of_hertz) in &IMPACTS[1..] {
            let speed = format!("body.1.approach_speed={}", over * yields_at);
            let model = format!("model={{ law={{ {law}={{ {strength} }} }} }}");
            let simulation = simulation_of(BALL, &[speed, model]);
            let summary = simulation.summary(&simulation.run(&mut ()));
            let hertz = ImpactQuantities::from(&simulation.setup().estimate.hertz).in_order();
            for k in 0..3 {
                let quantity = QuantityOfInterest::ALL[k];
                let bar = summary.uncertainty.parts(quantity).model.unwrap();
                let elements = of_hertz[k] * hertz[k];
                let error = (summary.collision.number(quantity).unwrap() - elements).abs();
                // The law that stands for elements is within 3 % of them, and says so.
                assert!(
                    error <= bar && bar < error + 0.1 * elements,
                    "{law} {over}: {quantity:?} {error} {bar}"
                );
            }
        }
    }
}
