//! What the plan foretells of leaving an effect out, held against collisions with it and without it.

use std::path::Path;

use fem::effects::LeftOut;
use fem::{Case, Collision, Simulation};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");

fn simulation(text: &str, set: &[&str]) -> Simulation {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    Simulation::new(Case::parse("scene.toml", text, Path::new("."), &set).unwrap()).unwrap()
}

fn run(text: &str, set: &[&str]) -> Collision {
    simulation(text, set).run(&mut ())
}

fn foretold(text: &str, set: &[&str], effect: &str) -> LeftOut {
    let simulation = simulation(text, set);
    let setup = simulation.setup();
    let verdict = setup.decisions.verdicts.iter().find(|verdict| verdict.name == effect).unwrap();
    assert!(verdict.active, "{}", verdict.reason);
    simulation.left_out(verdict, &setup.estimate).unwrap()
}

/// Within a factor of three, where it is more than another error of the same number.
fn agree(foretold: Option<f64>, with: Option<f64>, without: Option<f64>, small: f64, what: &str) {
    let found = (with.unwrap() - without.unwrap()).abs();
    let foretold = foretold.unwrap();
    let near = |a: f64, b: f64| a <= 3.0 * b + small;
    assert!(
        near(foretold, found) && near(found, foretold),
        "{what}: {foretold:e}, found {found:e}"
    );
}

/// An effect switched off by force, the rest the same.
fn is_as_foretold(text: &str, set: &[&str], effect: &str) {
    let foretold = foretold(text, set, effect);
    let off = format!("effects.{}=\"off\"", effect.replace(' ', "_"));
    let without: Vec<&str> = set.iter().copied().chain([off.as_str()]).collect();
    let (with, without) = (run(text, set), run(text, &without));
    let what = format!("{effect} of {set:?}");
    agree(foretold.restitution, with.restitution, without.restitution, 1e-4, &what);
    let time = 1e-3 * with.contact_time.unwrap();
    agree(foretold.contact_time_s, with.contact_time, without.contact_time, time, &what);
    let force = 3e-3 * with.peak_force.unwrap();
    agree(foretold.peak_force_n, with.peak_force, without.peak_force, force, &what);
}

/// From relaxation that hardly begins within the contact to one that is over in a twentieth of it, of
/// glass and of rubber, of both moduli and of the shear modulus, in every model that has it.
#[test]
fn relaxation_is_worth_what_is_foretold() {
    let rate = |rate: &str| format!("material.glass.relaxation.terms.0.decay_rate='{rate} 1/s'");
    let weight = |weight: f64| format!("material.glass.relaxation.terms.0.weight={weight}");
    for (rates, weights) in [("200", 1.0), ("2708", 1.0), ("3e4", 0.5), ("3e5", 0.3)] {
        for acts_on in ["all", "shear"] {
            let acts_on = format!("material.glass.relaxation.acts_on=\"{acts_on}\"");
            let (rate, weight) = (rate(rates), weight(weights));
            for model in ["model.ting={}", "model.condensed={}"] {
                let set = [model, &rate, &weight, &acts_on, "mesh.contact_element_size='40 um'"];
                is_as_foretold(GLASS, &set, "viscoelasticity");
            }
        }
    }
    is_as_foretold(GLASS, &["mesh.contact_element_size='56 um'"], "viscoelasticity");
}

/// What is switched off is not there: to the bits, the case without it, and the user is told.
#[test]
fn relaxation_switched_off_is_the_elastic_case() {
    let (table, _) = GLASS.split_once("[material.glass.relaxation]").unwrap();
    let bodies = GLASS.find("[[body]]").unwrap();
    let elastic = format!("{table}\n{}", &GLASS[bodies..]);
    for model in ["model.hertz={}", "model.ting={}", "model.condensed={}"] {
        let off = simulation(GLASS, &[model, "effects.viscoelasticity=\"off\""]);
        assert_eq!(off.run(&mut ()), run(&elastic, &[model]), "{model}");
        let warnings = off.setup().warnings().join("\n");
        assert!(warnings.contains("viscoelasticity is called for, but switched off"), "{warnings}");
        assert!(warnings.contains("e-2 of the restitution"), "{warnings}");
        // It is what the resolved case says again.
        let again = Simulation::new(Case::of(off.resolved().clone()).unwrap()).unwrap();
        assert_eq!(again.run(&mut ()), off.run(&mut ()), "{model}");
    }
}

/// What a model cannot leave out, it does not pretend to leave out.
#[test]
fn what_cannot_be_left_out_is_refused() {
    for (set, key, why) in [
        (["model.fem={}", "effects.hourglass_control=\"off\""], "hourglass_control", "stiffness"),
        (["model.hertz={}", "effects.hourglass_control=\"on\""], "hourglass_control", "hertz"),
    ] {
        let set = set.map(str::to_string);
        let case = Case::parse("scene.toml", GLASS, Path::new("."), &set).unwrap();
        let error = Simulation::new(case).unwrap_err();
        assert_eq!(error.key(), Some(format!("effects.{key}").as_str()), "{error}");
        assert!(error.message().contains(why), "{error}");
    }
}
