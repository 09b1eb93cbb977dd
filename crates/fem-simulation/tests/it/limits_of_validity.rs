//! Limits of validity: where a correction or an effect's estimate ends, its error bar stays as large or becomes unknown.

use fem_collision::QuantityOfInterest;
use fem_simulation::Simulation;
use fem_simulation::effects::{EFFECTS, EffectStatus};

use crate::scene::{refused_of, simulation_of, summary_of};

const METAL: &str =
    "density = 7800, youngs_modulus = '210 GPa', poissons_ratio = 0.3, hyperelastic = 'hencky',
    relaxation = { acts_on = 'all', terms = [{ weight = 1e-3, relaxation_time = '10 us' }] }";
const RUBBER: &str =
    "density = 1100, youngs_modulus = '10 MPa', poissons_ratio = 0.45, hyperelastic = 'neo-hooke',
    relaxation = { acts_on = 'all', terms = [{ weight = 0.4, relaxation_time = '0.5 ms' }] }";

/// Returns the case of a ball of a metal, with the keys of the material and of the partner.
fn on(material: &str, partner: &str) -> String {
    format!(
        "material.metal = {{ {material} }}
        body = [{{ name = 'partner', {partner} }},
                {{ name = 'ball', sphere.diameter = '10 mm', material = 'metal', approach_speed = '1 m/s' }}]"
    )
}

/// A sweep of one key of a scene, with the values of its key, ascending.
struct Sweep {
    scene: String,
    key: &'static str,
    values: Vec<f64>,
}

/// Returns values from the first to the last, each 5 % above the one before.
fn values(from: f64, to: f64) -> Vec<f64> {
    let n = ((to / from).ln() / 1.05_f64.ln()) as i32;
    (0..=n).map(|k| from * 1.05_f64.powi(k)).collect()
}

/// An effect, whether the model lacks it, and its errors.
type Errors = ((&'static str, bool), [Option<f64>; 3]);

/// Returns the model-form error of each effect in restitution, contact time and peak force, the last two over Hertz'.
fn errors_of(simulation: &Simulation) -> Vec<Errors> {
    let (scene, setup) = (simulation.case().scene(), simulation.setup());
    let decisions = setup.decisions.all.iter();
    let error = decisions.map(|decision| {
        let effect = EFFECTS.into_iter().find(|effect| effect.name() == decision.name).unwrap();
        let neglect_error = simulation.neglect_error(decision, &setup.estimate);
        let status = EffectStatus { is_lacking: decision.is_lacking, neglect_error };
        let errors = effect.model_form_error(scene, &setup.estimate, &status);
        let hertz = &setup.estimate.hertz;
        let quantities = [
            (QuantityOfInterest::Restitution, 1.0),
            (QuantityOfInterest::ContactTime, hertz.contact_time()),
            (QuantityOfInterest::PeakForce, hertz.peak_force()),
        ];
        let of = |(quantity, scale)| Some(errors.size(quantity)? / scale);
        ((decision.name, decision.is_lacking), quantities.map(of))
    });
    error.collect()
}

/// As a contact grows through the limits of the corrections (a/R of 0.1, a quarter of the approach, waves that do not return, a
/// plate neither thin nor thick), no bar of an effect falls by a third from one scene to the next, 5 % apart, unless the model
/// begins or ends to compute the effect, or the bar is below 0.1 % or unknown. (On 2.8 mm the thickness of the plate and the size
/// of the ball cancel in the contact time.)
#[test]
fn no_bar_shrinks_where_an_effect_ends() {
    let plate = |mm: u32| on(METAL, &format!("plate.thickness = '{mm} mm', material = 'metal'"));
    let speed = "body.1.approach_speed";
    let sweeps = [
        Sweep { scene: plate(12), key: speed, values: values(4.0, 10.0) },
        Sweep { scene: plate(3), key: speed, values: values(4.0, 10.0) },
        Sweep { scene: plate(3), key: "body.0.plate.thickness", values: values(4e-3, 0.09) },
        Sweep { scene: on(METAL, "wall = {}"), key: speed, values: values(3.0, 20.0) },
        Sweep { scene: on(RUBBER, "wall = {}"), key: speed, values: values(0.3, 8.0) },
        Sweep {
            scene: on(METAL, "sphere.diameter = '2 cm', material = 'metal'"),
            key: "body.0.sphere.diameter",
            values: values(0.01, 0.3),
        },
    ];
    for Sweep { scene, key, values } in sweeps {
        for model in ["model.hertz={}", "model.ting={}", "model.law.hertz={}"] {
            let mut before: Vec<Errors> = Vec::new();
            for value in &values {
                let now = errors_of(&simulation_of(&scene, &[model, &format!("{key}={value}")]));
                for (name, errors) in &now {
                    let Some((_, last)) = before.iter().find(|(other, _)| other == name) else {
                        continue;
                    };
                    for (error, last) in errors.iter().zip(last) {
                        let falls = error
                            .zip(*last)
                            .is_some_and(|(error, last)| last > 1e-3 && error < 0.67 * last);
                        assert!(!falls, "{model} {key}={value} {name:?}: {last:?} → {error:?}");
                    }
                }
                before = now;
            }
        }
    }
}

/// A plate that would bend by more than half of its thickness has no known error in any model, and is told to stretch. A long
/// contact on a plate with an edge has its waves back.
#[test]
fn a_film_is_told_to_stretch() {
    let film = on(METAL, "plate.thickness = '60 um', material = 'metal'");
    for model in ["model.ting={}", "model.hertz={}", "model.condensed={}"] {
        let summary = summary_of(&film, &[model]);
        // By hand: β m v of 1.5 mm.
        let warnings = summary.warnings.join("\n");
        assert!(warnings.contains("partner would bend by"), "{model}: {warnings}");
        let parts = summary.uncertainty.of(QuantityOfInterest::Restitution);
        assert_eq!(parts.model, None, "{model}");
    }
    let edge = |set: &str| summary_of(&film, &["model.ting={}", set]).warnings.join("\n");
    let told = "waves return from the edge";
    assert!(edge("body.0.plate.diameter='1 m'").contains(told), "the contact lasts");
    assert!(!edge("model.ting.finite_size=false").contains(told), "no edge");
    // 2 mm bend by 0.007 of them.
    let thick = summary_of(&film, &["model.ting={}", "body.0.plate.thickness='2 mm'"]);
    assert!(!thick.warnings.join("").contains("would bend"));
}

/// A bonded plate that is too thin for elements has no model, whichever is asked; one that is thick enough has elements.
#[test]
fn advice_on_bonded_plates_does_not_go_in_circles() {
    let bonded =
        on(METAL, "plate = { thickness = '0.4 mm', support = 'bonded' }, material = 'metal'");
    let models =
        ["model.fem={}", "model.auto={}", "model.ting={}", "model.condensed={}", "model.hertz={}"];
    for model in models {
        let found = refused_of(&bonded, &[model]).to_string();
        assert!(found.contains("no model computes a thinner bonded plate"), "{model}: {found}");
    }
    let thick = "body.0.plate.thickness='5 mm'";
    for model in &models[2..] {
        let found = refused_of(&bonded, &[*model, thick]).to_string();
        assert!(found.contains("use model fem, or auto"), "{model}: {found}");
    }
}

/// The automatic choice leaves elements out where their mesh cannot be made or their run exceeds a limit.
#[test]
fn auto_takes_what_can_be_computed() {
    let plate = on(METAL, "plate.thickness = '5 mm', material = 'metal'");
    let chosen = |set: &[&str]| {
        let set: Vec<&str> = ["model.auto={}"].into_iter().chain(set.iter().copied()).collect();
        let simulation = simulation_of(&plate, &set);
        simulation.considered().iter().find(|one| one.chosen).unwrap().model
    };
    let strict = "accuracy.tolerance='0.3 %'";
    assert_eq!(chosen(&[strict]), "fem = {}");
    assert_ne!(chosen(&[strict, "limits.element_updates=1e5"]), "fem = {}");
    assert_ne!(chosen(&[strict, "body.0.plate.thickness='60 um'"]), "fem = {}");
}
