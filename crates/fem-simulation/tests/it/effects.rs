//! `[effects]`: forced effects, the keys of switches, and the support of every model.

use fem_case::{EffectsTable, Switch};
use fem_simulation::Simulation;
use fem_simulation::effects::EFFECTS;
use serde_json::json;

use crate::scene::{ELASTIC_GLASS, GLASS, case_of, refused_of, simulation_of};

#[test]
fn a_forced_effect_that_the_model_lacks_is_rejected() {
    for model in ["condensed={}", "ting={}", "hertz={}", "law.falcon.c=300"] {
        for effect in ["finite_strain", "bulk_viscosity"] {
            let switched = |switch: &str| {
                let text = format!("{GLASS}\n[effects]\n{effect} = \"{switch}\"\n");
                (case_of(&text, &[format!("model.{model}")]), text)
            };
            let (forced, text) = switched("on");
            let error = Simulation::new(forced).unwrap_err();
            assert!(error.message().contains("is not available"), "{error}");
            assert_eq!(error.key(), Some(format!("effects.{effect}").as_str()));
            assert!(error.help().unwrap().contains("\"off\""), "{error}");
            // It underlines the value, in the last line.
            assert_eq!(&text[error.span().unwrap()], "\"on\"", "{error}");
            assert_eq!(error.line(), Some(text.lines().count()), "{error}");
            assert_eq!(error.source_text(), Some(text.as_str()));
            for switch in ["off", "auto"] {
                Simulation::new(switched(switch).0).unwrap();
            }
        }
    }
}

/// A switch that a model cannot obey is rejected with its reason.
#[test]
fn a_switch_that_a_model_cannot_obey_is_rejected() {
    for (model, effect, switch, reason) in [
        ("fem", "hourglass_control", "off", "stiffness"),
        ("hertz", "hourglass_control", "on", "hertz"),
        ("hertz", "partner_waves", "on", ""),
        ("fem", "partner_waves", "off", ""),
    ] {
        let block = "body.0.sphere.diameter='3 m'".to_string();
        let set =
            [format!("model={{{model}={{}}}}"), format!("effects.{effect}='{switch}'"), block];
        let error = refused_of(GLASS, &set);
        assert_eq!(error.key(), Some(format!("effects.{effect}").as_str()), "{error}");
        assert!(error.message().contains(reason), "{error}");
    }
}

/// Every key of `[effects]` is the switch of one effect, whose name is the key with spaces.
#[test]
fn every_effects_key_is_the_switch_of_one_effect() {
    let on = EffectsTable {
        viscoelasticity: Some(Switch::On),
        finite_strain: Some(Switch::On),
        plastic_flow: Some(Switch::On),
        surface_slip: Some(Switch::On),
        plate_bending: Some(Switch::On),
        partner_waves: Some(Switch::On),
        mirror_symmetry: Some(Switch::On),
        rigid_partner: Some(Switch::On),
        hourglass_control: Some(Switch::On),
        bulk_viscosity: Some(Switch::On),
    };
    let tree = serde_json::to_value(on).unwrap();
    let keys: Vec<&String> = tree.as_object().unwrap().keys().collect();
    for key in &keys {
        let alone: EffectsTable = serde_json::from_value(json!({ key.as_str(): "on" })).unwrap();
        let switched = EFFECTS.iter().filter(|effect| effect.switch(&alone) == Some(Switch::On));
        let names: Vec<String> = switched.map(|effect| effect.name().replace(' ', "_")).collect();
        assert_eq!(names, [key.as_str()]);
    }
    let switched = EFFECTS.iter().filter(|effect| effect.switch(&on).is_some());
    assert_eq!(switched.count(), keys.len(), "a switch that is no key");
}

/// Every model supports an effect or has no use for it, so that a new effect must be added to one of the two lists of each
/// model.
#[test]
fn every_model_supports_or_excludes_every_effect() {
    let reduced = "viscoelasticity, dashpot, finite size, finite strain, surface slip, plastic flow, adhesion, partner waves, \
                   rigid partner, vibration, gravity";
    let law = reduced.replace("plastic flow, adhesion, ", "");
    let no_elements = "material loss, friction, tangential coupling, plate bending, rate dependence, mirror symmetry, hourglass control, bulk viscosity, penalty springs, contact search, mass scaling";
    // Elements always include inertia, and modes of vibration resolve no fronts.
    for (model, answered, foreign) in [
        (
            "fem={}",
            "viscoelasticity, finite strain, surface slip, plastic flow, adhesion, partner waves, mirror symmetry, rigid partner, \
             hourglass control, bulk viscosity, gravity, contact search, mass scaling",
            "material loss, friction, tangential coupling, plate bending, dashpot, finite size, rate dependence, vibration, penalty springs",
        ),
        (
            "condensed={}",
            "viscoelasticity, finite strain, surface slip, plastic flow, adhesion, partner waves, mirror symmetry, rigid partner, \
             vibration, penalty springs, gravity, contact search",
            "material loss, friction, tangential coupling, plate bending, dashpot, finite size, rate dependence, hourglass control, bulk viscosity, mass scaling",
        ),
        ("hertz={}", reduced, no_elements),
        ("ting={}", reduced, no_elements),
        // Without a surface energy all losses of a law are the user's.
        ("law.falcon.c=300", &law, &format!("{no_elements}, plastic flow, adhesion")),
    ] {
        let simulation = simulation_of(GLASS, &[format!("model.{model}")]);
        let decisions = simulation.setup().decisions.all.iter();
        let found: Vec<&str> = decisions.map(|decision| decision.name).collect();
        assert_eq!(found.join(", "), answered, "{model}");
        for effect in EFFECTS {
            let name = effect.name();
            let is_in = |list: &str| list.split(", ").any(|one| one == name);
            assert!(is_in(answered) != is_in(foreign), "{model}: {name}");
        }
    }
}

/// Physics that is computed or that the scene needs matters; parts of the computation and idle effects do not.
#[test]
fn mattering_effects_are_those_of_the_scene() {
    for (text, model, expected) in [
        (ELASTIC_GLASS, "fem={}", &[][..]),
        (GLASS, "fem={}", &["viscoelasticity"]),
        (GLASS, "ting={}", &["viscoelasticity"]),
        // It lacks what the scene needs.
        (GLASS, "hertz={}", &["viscoelasticity"]),
    ] {
        let simulation = simulation_of(text, &[format!("model.{model}")]);
        let decisions = simulation.setup().decisions.all.iter();
        let mattering = decisions.filter(|decision| decision.matters);
        assert_eq!(
            mattering.map(|decision| decision.name).collect::<Vec<_>>(),
            expected,
            "{model}"
        );
    }
}
