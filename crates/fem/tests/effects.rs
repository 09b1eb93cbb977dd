//! `[effects]`: what the case forces and no model has.

use std::path::Path;

use fem::Simulation;
use fem::effects::EFFECTS;
use fem_case::{Case, EffectsTable, Switch};

const GLASS: &str = include_str!("../../../cases/glass_0.5ms.toml");

fn case(overrides: &[&str]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap()
}

#[test]
fn an_effect_that_is_forced_on_and_lacking_is_refused_at_its_switch() {
    for model in ["fem", "condensed", "ting", "hertz", "law.falcon.c=300"] {
        let model = if model.contains('=') { model.into() } else { format!("{model}={{}}") };
        for effect in ["finite_strain", "mirror_symmetry", "bulk_viscosity"] {
            let forced = |switch: &str| {
                case(&[&format!("model.{model}"), &format!("effects.{effect}='{switch}'")])
            };
            let error = Simulation::new(forced("on")).unwrap_err();
            assert!(error.message().contains("is not available"), "{error}");
            assert_eq!(error.key(), Some(format!("effects.{effect}").as_str()));
            assert!(error.help().unwrap().contains("\"off\""), "{error}");
            for switch in ["off", "auto"] {
                Simulation::new(forced(switch)).unwrap();
            }
        }
    }
}

/// Every key of `[effects]` is the switch of an effect, under the effect's name.
#[test]
fn every_switch_has_its_effect() {
    let on = EffectsTable {
        finite_strain: Some(Switch::On),
        mirror_symmetry: Some(Switch::On),
        bulk_viscosity: Some(Switch::On),
    };
    let switched = EFFECTS.iter().filter(|effect| effect.switch(&on) == Some(Switch::On));
    assert_eq!(switched.count(), 3);
}
