//! Folded relaxation terms: terms much faster or slower than the contact are not integrated.

use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::effects::{EFFECTS, Support};
use fem_simulation::{Regime, SharedModels, Simulation, Summary, method_of};

use crate::scene::{decision_on, simulation_of as simulation, summary_of};

/// Ten terms over as many decades, like the fit of a polymer's master curve.
const POLYMER: &str = "
    material.polymer = { density = 1200, youngs_modulus = '3 GPa', poissons_ratio = 0.35,
        relaxation = { acts_on = 'shear', terms = [
            { weight = 0.05, relaxation_time = '1e-11 s' },
            { weight = 0.05, relaxation_time = '1e-10 s' },
            { weight = 0.05, relaxation_time = '1e-9 s' },
            { weight = 0.1, relaxation_time = '1e-7 s' },
            { weight = 0.1, relaxation_time = '1e-5 s' },
            { weight = 0.1, relaxation_time = '1e-3 s' },
            { weight = 0.1, relaxation_time = '1e-1 s' },
            { weight = 0.1, relaxation_time = '10 s' },
            { weight = 0.05, relaxation_time = '1e3 s' },
            { weight = 0.05, relaxation_time = '1e5 s' },
        ] } }
    body = [{ name = 'floor', wall = {} },
            { name = 'ball', sphere.diameter = '10 mm', material = 'polymer', approach_speed = '0.5 m/s' }]
    output.snapshots = []";

/// The same without relaxation.
const ELASTIC: &str =
    "material.polymer={density='1200 kg/m^3',youngs_modulus='3 GPa',poissons_ratio=0.35}";

fn changes(a: &Collision, b: &Collision) -> [f64; 3] {
    let relative = |a: Option<f64>, b: Option<f64>| a.unwrap() / b.unwrap() - 1.0;
    [
        a.restitution.unwrap() - b.restitution.unwrap(),
        relative(a.contact_time, b.contact_time),
        relative(a.peak_force, b.peak_force),
    ]
}

#[test]
fn folded_terms_change_less_than_their_stated_error() {
    // The mesh is the same, since other moduli would move the contact's edge between nodes.
    let mesh = "mesh.contact_element_size='10 um'";
    for model in ["model.ting={}", "model.condensed={}"] {
        let folded = simulation(POLYMER, &[model, mesh]);
        let decision = decision_on(&folded, "viscoelasticity");
        assert!(decision.active && decision.reason.contains("of 10 terms remain"));
        let all = simulation(POLYMER, &[model, mesh, "effects.viscoelasticity='on'"]);
        assert!(!decision_on(&all, "viscoelasticity").reason.contains("terms remain"));
        for change in changes(&folded.run(&mut ()), &all.run(&mut ())) {
            assert!(change.abs() < 1.5e-4, "{model}: {change:e}");
        }
    }
}

/// Explicit elements store one field per integrated term and none for folded ones.
#[test]
fn folded_terms_are_not_stored() {
    let set = ["mesh.contact_element_size='0.1 mm'"];
    let folded = simulation(POLYMER, &set);
    let all = simulation(POLYMER, &[set[0], "effects.viscoelasticity='on'"]);
    let bytes = |simulation: &Simulation| match simulation.setup().cost {
        fem_simulation::Cost::Steps { memory, .. } => memory,
        _ => panic!("explicit elements"),
    };
    assert!(bytes(&folded) < bytes(&all), "{} {}", bytes(&folded), bytes(&all));
    for change in changes(&folded.run(&mut ()), &all.run(&mut ())) {
        // Contact springs follow the stiffness of the bodies, which lack the fast terms.
        assert!(change.abs() < 5e-3, "{change:e}");
    }
}

/// Small losses are accurate to two per cent.
#[test]
fn small_losses_are_accurate() {
    for (time, weight) in [("1 s", 0.5), ("30 ms", 0.2), ("1 ns", 0.2)] {
        let terms = format!(
            "material.polymer.relaxation.terms=[{{weight={weight},relaxation_time='{time}'}}]"
        );
        let set = ["model.ting={}", terms.as_str()];
        let found = 1.0 - simulation(POLYMER, &set).run(&mut ()).restitution.unwrap();
        let on = [set[0], set[1], "effects.viscoelasticity='on'"];
        let exact = 1.0 - simulation(POLYMER, &on).run(&mut ()).restitution.unwrap();
        assert!((found - exact).abs() < (0.02 * exact).max(2e-7), "{time}: {found:e} {exact:e}");
    }
}

/// Models without relaxation lack it whether or not terms are folded: their bars reach Ting's impact.
#[test]
fn models_without_relaxation_lack_it_beside_folded_terms() {
    let two = "material.polymer.relaxation.terms=[{weight=0.3,relaxation_time='50 us'},\
               {weight=0.05,relaxation_time='1 h'}]";
    for terms in [two, "title='ten'"] {
        let ting = summary_of(POLYMER, &["model.ting={}", terms]).collision;
        for model in ["model.hertz={}", "model.law.falcon.c=0"] {
            let found = simulation(POLYMER, &[model, terms]);
            let decision = decision_on(&found, "viscoelasticity");
            assert!(!decision.active && decision.is_lacking, "{}", decision.reason);
            assert!(decision.reason.contains("terms remain"), "{}", decision.reason);
            let warnings = found.setup().warnings().join("\n");
            assert!(warnings.contains("neglects: it uses the instantaneous moduli"), "{warnings}");
            let summary = summary_of(POLYMER, &[model, terms]);
            let numbers = [
                (summary.collision.restitution, ting.restitution, QuantityOfInterest::Restitution),
                (
                    summary.collision.contact_time_s,
                    ting.contact_time_s,
                    QuantityOfInterest::ContactTime,
                ),
                (summary.collision.peak_force_n, ting.peak_force_n, QuantityOfInterest::PeakForce),
            ];
            for (own, known, quantity) in numbers {
                let bar = summary.uncertainty.of(quantity).model.unwrap();
                let off = (own.unwrap() - known.unwrap()).abs();
                assert!(off <= bar, "{model} {quantity:?}: {bar:e} for {off:e}");
                // Other effects change the others.
                let is_wide = quantity == QuantityOfInterest::Restitution && bar > 1.2 * off;
                assert!(!is_wide, "{model}: {bar:e} for {off:e}");
            }
        }
    }
}

/// The error bar of a law that takes its damping from the materials as their slow limit reaches Ting's impact where they relax within
/// the contact.
#[test]
fn the_slow_limit_has_an_error_bar() {
    for time in ["1 us", "5 us", "20 us", "60 us"] {
        let terms = format!(
            "material.polymer.relaxation.terms=[{{weight=0.2,relaxation_time='{time}'}},{{weight=0.05,relaxation_time='1 d'}}]"
        );
        let ting = summary_of(POLYMER, &["model.ting={}", &terms]).collision;
        let law = summary_of(POLYMER, &["model.law.kuwabara_kono={}", &terms]);
        let bar = law.uncertainty.of(QuantityOfInterest::Restitution).model.unwrap();
        let off = (law.collision.restitution.unwrap() - ting.restitution.unwrap()).abs();
        assert!(off < 1.01 * bar && bar < 1.5 * off + 0.01, "{time}: {bar} for {off}");
    }
}

/// Fast terms that are folded are in the moduli, and no error of a model without relaxation.
#[test]
fn folded_fast_terms_are_no_error() {
    let fast = "material.polymer.relaxation.terms=[{weight=0.3,relaxation_time='1e-13 s'}]";
    for model in ["model.hertz={}", "model.ting={}"] {
        let found = summary_of(POLYMER, &[model, fast]);
        let on = summary_of(POLYMER, &["model.ting={}", fast, "effects.viscoelasticity='on'"]);
        let off =
            (found.collision.peak_force_n.unwrap() / on.collision.peak_force_n.unwrap()) - 1.0;
        assert!(off.abs() < 1e-3, "{model}: {off:e}");
        let none = summary_of(POLYMER, &[model, ELASTIC, "material.polymer.elastic=true"]);
        let bar = |summary: &Summary| {
            let bar = summary.uncertainty.of(QuantityOfInterest::PeakForce).model.unwrap();
            bar / summary.collision.peak_force_n.unwrap()
        };
        // Softer bodies are strained a little more.
        assert!(
            bar(&found) < 1.3 * bar(&none) + 1e-3,
            "{model}: {:e} {:e}",
            bar(&found),
            bar(&none)
        );
    }
}

/// An effect that a model lacks is lacking in every simplified scene, too: each effect that transforms the scene, with each method.
#[test]
fn no_transformation_replaces_the_support_of_a_model() {
    let steel = "material.steel={density=7800,youngs_modulus=210e9,poissons_ratio=0.3}";
    let plate = "body.0={name='floor',plate={thickness='1 m'},material='steel'}";
    let anvil = "body.0={name='floor',sphere.diameter='1 m',material='steel'}";
    let gel = "material.polymer.youngs_modulus='2 MPa'";
    let flow = "material.polymer.yield_strength='10 GPa'";
    let scenes: [(&str, &[&str]); 4] = [
        ("viscoelasticity", &["title='x'"]),
        ("plate bending", &[steel, plate]),
        ("rigid partner", &[steel, anvil, gel]),
        ("plastic flow", &[ELASTIC, flow, "material.polymer.flow={}"]),
    ];
    for (name, set) in scenes {
        for model in [
            "model.hertz={}",
            "model.law.falcon.c=0",
            "model.ting={}",
            "model.condensed={}",
            "model.fem={}",
        ] {
            let coarse = ["mesh.contact_element_size='0.1 mm'", model];
            let set: Vec<&str> = set.iter().copied().chain(coarse).collect();
            let found = simulation(POLYMER, &set);
            let (scene, estimate) = (found.case().scene(), &found.setup().estimate);
            let transforms = |effect: &&&dyn fem_simulation::effects::Effect| {
                effect.transform(scene, estimate).unwrap().is_some()
            };
            let transformed: Vec<_> = EFFECTS.iter().filter(transforms).collect();
            assert!(transformed.iter().any(|effect| effect.name() == name), "{name} {model}");
            // The model of the scene as it is given.
            let regime = Regime::of(scene.clone()).unwrap();
            let Ok(given) = method_of(scene).build(&regime, &SharedModels::default()) else {
                continue;
            };
            for effect in transformed {
                let lacks = match given.support(*effect, estimate) {
                    Some(Support::Lacks) => true,
                    Some(Support::Is { active, .. }) => !active,
                    _ => false,
                };
                let is_needed = effect.relevance(scene, estimate).is_some_and(|it| it.is_needed);
                let decision = decision_on(&found, effect.name());
                let text = format!("{name} {model} {}: {}", effect.name(), decision.reason);
                assert!(!lacks || !is_needed || decision.is_lacking, "{text}");
            }
        }
    }
}
