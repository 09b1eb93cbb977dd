//! Which bodies yield, and what each model says of it.

use fem_collision::QuantityOfInterest;
use fem_laws::ImpactQuantities;
use fem_simulation::effects::EffectDecision;
use fem_simulation::results::Side;

use crate::scene::{ELASTIC_GLASS, simulation_of};

/// Steel spheres of 5 mm at 5 m/s; real steel yields at some cm/s.
const STEEL: &str = r#"
    material.steel = { density = "7850 kg/m^3", youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
    body = [{ name = "lower", sphere.diameter = "5 mm", material = "steel", approach_speed = "5 m/s" },
            { name = "upper", sphere.diameter = "5 mm", material = "steel" }]"#;

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

fn decision_words(text: &str, overrides: &[&str]) -> String {
    simulation_of(text, overrides).setup().warnings().join("\n")
}

/// A material without a strength is judged by the library's material of its stiffness and density, which is named.
#[test]
fn an_unknown_strength_is_that_of_the_nearest_material() {
    for model in &MODELS[..4] {
        let (decision, warnings) = decision_on(STEEL, &[model]);
        // Johnson's ½mv² = 53 R³Y⁵/E*⁴ with 235 MPa is 1.85 mm/s, printed with two digits.
        let told = "as stiff and heavy as steel, which yields from 1.8 mm/s";
        assert!(warnings.contains(told), "{model}: {warnings}");
        let keys = "set material.steel.yield_strength, or material.steel.elastic = true";
        assert!(warnings.ends_with(keys), "{warnings}");
        assert!(!decision.active && decision.reason.contains("lib:steel"), "{}", decision.reason);
        let meant = decision_on(STEEL, &[model, "material.steel.elastic=true"]);
        assert!(!meant.1.contains("yields"), "{model}: {}", meant.1);
    }
}

/// Elements compute the flow of a known strength without further keys; other models give bounds and name both ways out, and a
/// contact law is the user's.
#[test]
fn a_known_strength_is_computed_or_makes_bounds() {
    for model in MODELS {
        let strength = "material.steel.yield_strength='1 GPa'";
        let simulation = simulation_of(STEEL, &[model, strength]);
        let warnings = simulation.setup().warnings().join("\n");
        let of = |name: &str| {
            simulation.setup().decisions.all.iter().find(|it| it.name == name).cloned()
        };
        let flow = of("plastic flow");
        if model.contains("law") {
            assert_eq!(flow, None);
        } else if model.contains("fem") {
            assert!(flow.unwrap().active && !warnings.contains("yields"), "{warnings}");
        } else {
            assert!(flow.unwrap().reason.contains("the results are bounds"));
            assert!(warnings.contains("lower yields from 69 mm/s"), "{model}: {warnings}");
            assert!(warnings.contains("use model fem, or law mean_pressure"), "{warnings}");
            assert_eq!(warnings.lines().count(), 1, "{model}: {warnings}");
        }
        let slow = [model, strength, "body.0.approach_speed='5 cm/s'"];
        assert!(!decision_words(STEEL, &slow).contains("yields"), "{model}");
    }
}

/// A material that relaxes, or has a hyperelastic law, does not flow: the warning names what is in the way.
#[test]
fn what_is_in_the_way_of_flow_is_named() {
    let relaxation = "material.steel.relaxation={ acts_on='all', terms=[{ weight=0.1, relaxation_time='1 ms' }] }";
    let law = "material.steel.hyperelastic='neo-hooke'";
    for (set, key) in [(relaxation, "relaxation"), (law, "hyperelastic")] {
        let strength = "material.steel.yield_strength='1 GPa'";
        let (decision, warnings) = decision_on(STEEL, &[strength, "model.fem={}", set]);
        let words = format!("remove material.steel.{key}");
        assert!(warnings.contains(&words), "{warnings}");
        assert!(!decision.active);
    }
}

/// A body yields where the pressure that its partner bears reaches its own strength: hardened steel beside structural steel
/// does not, and a body that is a little stronger than its partner does.
#[test]
fn a_hard_body_beside_a_soft_one_does_not_yield() {
    let soft = "material.soft={ density=7850, youngs_modulus=210e9, poissons_ratio=0.3, yield_strength='235 MPa' }";
    // A hyperelastic body has no flow rule, so that it is told of if it yields.
    let hard = |strength: &str| format!("material.steel.yield_strength='{strength}'");
    let law = "material.steel.hyperelastic='neo-hooke'";
    for (strength, yields) in [("2.3 GPa", false), ("0.5 GPa", false), ("300 MPa", true)] {
        let set = [soft, &hard(strength), law, "body.1.material='soft'", "model.fem={}"];
        let (decision, warnings) = decision_on(STEEL, &set);
        assert_eq!(warnings.contains("lower yields"), yields, "{strength}: {warnings}");
        assert_eq!(decision.active, !yields, "{strength}");
    }
}

/// Balls of steel that flow in elements have no warning of yield; slow ones are elastic, with an unknown loss.
#[test]
fn yield_silences_what_it_makes_pointless() {
    let ball = |text: &str| text.replace("\"steel\"", "\"lib:steel\"");
    for model in &MODELS[..4] {
        let fast = decision_words(&ball(STEEL), &[model]);
        let expected = if model.contains("fem") { "typical steel" } else { "yields from" };
        assert!(fast.contains(expected), "{model}: {fast}");
        assert_eq!(fast.lines().count(), 1, "{model}: {fast}");
        let slow = decision_words(&ball(STEEL), &[model, "body.0.approach_speed='1 mm/s'"]);
        assert!(slow.starts_with("the damping of lower"), "{model}: {slow}");
        assert_eq!(slow.lines().count(), 1, "{model}: {slow}");
    }
}

#[test]
fn elastic_bodies_have_no_warning() {
    let (decision, warnings) = decision_on(ELASTIC_GLASS, &[""; 0]);
    assert_eq!(warnings, "");
    assert!(!decision.active);
}

#[test]
fn the_body_that_yields_first_is_named() {
    let soft = "material.soft={density=7850, youngs_modulus=210e9, poissons_ratio=0.3, \
                yield_strength=1e8}";
    let overrides =
        ["material.steel.yield_strength=1e9", soft, "body.1.material='soft'", "model.hertz={}"];
    let (_, warnings) = decision_on(STEEL, &overrides);
    assert!(warnings.contains("upper yields from"), "{warnings}");
    assert!(!warnings.contains("lower yields"), "{warnings}");
}

/// Soft materials are strained without yield, unless they have a strength, and so are polymers that relax or have a hyperelastic
/// law. A metal is none of these, whatever else its table has.
#[test]
fn rubber_does_not_yield() {
    let soft = "material.steel={density=1100, youngs_modulus='50 MPa', poissons_ratio=0.45}";
    let slow = "body.0.approach_speed='5 m/s'";
    for model in &MODELS[..4] {
        let (decision, warnings) = decision_on(STEEL, &[model, soft, slow]);
        assert!(!warnings.contains("yields"), "{model}: {warnings}");
        assert!(decision.reason.contains("not known to yield"), "{}", decision.reason);
        let relaxing = "material.steel.relaxation={acts_on='all', terms=[{weight=0.01, relaxation_time='1 ms'}]}";
        for key in ["material.steel.hyperelastic='hencky'", relaxing] {
            let metal = decision_words(STEEL, &[model, key]);
            assert!(metal.contains("as stiff and heavy as steel"), "{model}, {key}: {metal}");
            let stiff =
                "material.steel={density=1200, youngs_modulus='3 GPa', poissons_ratio=0.37}";
            let polymer = decision_words(STEEL, &[model, stiff, key]);
            assert!(!polymer.contains("yields"), "{model}, {key}: {polymer}");
        }
        let strength =
            ["material.steel.yield_strength='1 MPa'", "material.steel.hyperelastic='neo-hooke'"];
        let strong = decision_words(STEEL, &[&[model, soft, slow][..], &strength].concat());
        assert!(strong.contains("yields from"), "{model}: {strong}");
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
    material.metal = { density = 1000, youngs_modulus = 209.3e6, poissons_ratio = 0.3, yield_strength = 1e6 }
    body = [{ name = 'wall', wall = {} },
            { name = 'ball', sphere.diameter = 0.02, material = 'metal', approach_speed = 1 }]
    model.hertz = {}";

/// The bounds of a model without flow hold for impacts of an elastic–perfectly plastic sphere on a rigid wall.
#[test]
fn bounds_hold_for_plastic_impacts() {
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
            let plastic = plastic * hertz[k];
            let holds = match summary.uncertainty.of(quantity).bound {
                Some(Side::AtMost) => plastic <= computed,
                Some(Side::AtLeast) => plastic >= computed,
                // Flow first shortens and then lengthens the contact.
                None => quantity == QuantityOfInterest::ContactTime,
            };
            assert!(holds, "{over} v_y: {quantity:?} {computed}, plastic {plastic}");
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
                let bar = summary.uncertainty.of(quantity).model.unwrap();
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
