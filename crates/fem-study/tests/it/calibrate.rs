//! The target of a calibration, and the single Maxwell term that it starts from.

use fem_case::schema::{self, BodyTable, MaterialTable, SceneTable};
use fem_case::{Case, CaseFile};
use fem_data::estimate::FitError;
use fem_data::table::Restitutions;
use fem_material::{ActsOn, PronyTerm};
use fem_study::calibrate::{
    Beyond, Calibration, CalibrationFault, CalibrationModel, Maxwell, Settings, Target,
};

fn case(lower: &str, upper: &str) -> Case {
    let material = || MaterialTable::from_youngs_modulus_poissons_ratio(2390.0, "63 GPa", 0.244);
    let ball = |name, of| BodyTable::sphere(name, "1 cm", of).approaching("1 m/s");
    let file = CaseFile::of_bodies(ball("lower", lower), ball("upper", upper));
    Case::of(file.with_material(lower, material()).with_material("ice", material())).unwrap()
}

#[test]
fn the_only_material_needs_no_name() {
    let target = Target::of(&case("glass", "glass"), None, None).unwrap();
    assert_eq!((target.material.as_str(), target.sides), ("glass", [true, true]));
    assert_eq!(target.acts_on, ActsOn::All);
}

#[test]
fn one_of_two_materials_is_named() {
    let case = case("glass", "ice");
    let target = Target::of(&case, Some("ice"), Some(schema::ActsOn::Shear)).unwrap();
    assert_eq!((target.sides, target.acts_on), ([false, true], ActsOn::Shear));
    let materials = vec!["glass".to_string(), "ice".to_string()];
    let refused = Target::of(&case, None, None);
    assert_eq!(refused, Err(CalibrationFault::TwoMaterials { materials: materials.clone() }));
    let refused = Target::of(&case, Some("steel"), None);
    let name = "steel".to_string();
    assert_eq!(refused, Err(CalibrationFault::OtherMaterial { name, materials }));
}

/// A name that is no bare key of TOML is quoted in the printed table.
#[test]
fn printed_table_quotes_a_material_name() {
    let settings =
        Settings { model: Some(CalibrationModel::Ting), n_terms: 1, ..Settings::default() };
    for (name, key) in [("soda-lime_1", "soda-lime_1"), ("a \"b\"", "\"a \\\"b\\\"\"")] {
        let measured = Restitutions::of("e", &[(0.5, 0.9)]);
        let found = Calibration::of(&case(name, name), measured.into(), &settings).unwrap();
        let table = found.relaxation_toml();
        assert!(table.contains(&format!("[material.{key}.relaxation]\n")), "{table}");
    }
}

/// 1 − e = 1/(1 + τ): for each mean one τ.
fn restitutions(terms: &[PronyTerm]) -> Result<Vec<f64>, FitError> {
    let lost = 1.0 / (1.0 + terms[0].relaxation_time);
    Ok(vec![1.0 - 1.5 * lost, 1.0 - 0.5 * lost])
}

#[test]
fn the_term_has_the_measured_mean_or_an_end_of_the_search() {
    let found =
        |wanted: [f64; 2]| Maxwell::of_mean(&restitutions, &wanted, None, (0.1, 0.1)).unwrap();
    let one = found([0.7, 0.9]);
    // Means within 1e-6 are the same, and dτ = (1 + τ)² de.
    assert!((one.time - 4.0).abs() < 1e-4 && one.beyond.is_none(), "{one:?}");
    assert!(one.rms < 1e-6);
    assert_eq!(found([1.0, 1.0]).beyond, Some(Beyond::Slower));
    assert_eq!(found([0.0, 0.0]).beyond, Some(Beyond::Faster));
}

#[test]
fn a_failed_collision_is_an_error() {
    let failed = || FitError::Collision { reason: "none".to_string() };
    let never = |_: &[PronyTerm]| Err(failed());
    assert_eq!(Maxwell::of_mean(&never, &[0.9], None, (0.1, 0.1)), Err(failed()));
}

/// A ball of the measured polymer at this temperature.
fn polymer(temperature: &str) -> Case {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/data");
    let case = Case::load(&folder.join("polymer_ball.toml"), &[]).unwrap();
    let scene = SceneTable { temperature: Some(temperature.into()) };
    case.edited(|file| file.scene = Some(scene)).unwrap()
}

fn with_prior(case: &Case, data: &[(f64, f64)], uncertainty: f64) -> Calibration {
    let model = CalibrationModel::Ting;
    let settings = Settings { model: Some(model), uses_prior: true, ..Settings::default() };
    let material = case.file().body[0].material.clone();
    let settings = Settings { material, ..settings };
    let mut measured = Restitutions::of("e", data);
    measured.set_uncertainty(uncertainty).unwrap();
    Calibration::of(case, measured.into(), &settings).unwrap()
}

const SPEEDS: [f64; 2] = [0.1, 0.4];

fn data_of(restitutions: &[f64]) -> Vec<(f64, f64)> {
    SPEEDS.into_iter().zip(restitutions.iter().copied()).collect()
}

/// Data without precision leave the measured weights, and data of much precision are met.
#[test]
fn prior_and_data_are_the_limits_of_a_calibration_with_both() {
    let case = polymer("-10 degC");
    let vague = with_prior(&case, &data_of(&[0.9; 2]), 0.9);
    let parts = vague.fit.parts.as_ref().unwrap();
    for (weight, own) in parts.weights.iter().zip(&vague.fit.weights) {
        assert!((weight.value - own).abs() < 0.01 * weight.error, "{parts:?}");
    }
    assert!(parts.n_of_data < 1e-3, "{}", parts.n_of_data);
    let [prior, _, both] = parts.restitution;
    assert!((prior.value - both.value).abs() < 0.01 * prior.error, "{parts:?}");

    let shifted: Vec<f64> = parts.restitutions.iter().map(|e| e - 0.5 * prior.error).collect();
    let precise = with_prior(&case, &data_of(&shifted), 0.01 * prior.error);
    let [_, data, both] = precise.fit.parts.as_ref().unwrap().restitution;
    assert!((data.value - both.value).abs() < 2.0 * data.error, "{data:?} {both:?}");
}

/// Restitutions of a series that goes on beyond the band of the instrument narrow the weights there.
#[test]
fn restitutions_narrow_the_tail_that_was_not_measured() {
    let case = polymer("-10 degC");
    let vague = with_prior(&case, &data_of(&[0.9; 2]), 0.9);
    let parts = vague.fit.parts.as_ref().unwrap();
    let prior = parts.restitution[0];
    let times = &vague.times;
    let tail: Vec<usize> = (0..times.len()).filter(|k| parts.weights[*k].value == 0.0).collect();
    assert!(!tail.is_empty());
    let true_weight = |k: usize| {
        parts.weights[k].value.max(if tail.contains(&k) { parts.weights[k].error } else { 0.0 })
    };
    let truth: Vec<PronyTerm> = (0..times.len())
        .map(|k| PronyTerm { weight: true_weight(k), relaxation_time: times[k] })
        .filter(|term| term.weight > 0.0)
        .collect();
    let data = vague.experiments[0].restitutions(&truth).unwrap();
    let found = with_prior(&case, &data_of(&data), prior.error);
    let both = found.fit.parts.as_ref().unwrap();
    let [before, of_data, after] = both.restitution;
    assert!(after.error < of_data.error && after.error < before.error, "{both:?}");
    let sum = |of: &dyn Fn(usize) -> f64| tail.iter().map(|k| of(*k)).sum::<f64>();
    let (true_sum, found_sum) = (sum(&true_weight), sum(&|k| found.fit.weights[k]));
    assert!(0.2 * true_sum < found_sum && found_sum < 1.5 * true_sum, "{found_sum} {true_sum}");
    assert!(tail.iter().all(|k| both.errors[*k] <= both.weights[*k].error));
    let error = |e: f64| (e - of_data.value).abs();
    assert!(error(after.value) < error(before.value), "{both:?}");

    // The table keeps the shift, and the restitutions of a run are those of the calibration.
    let table = found.relaxation_toml();
    assert!(table.contains("reference_temperature") && table.contains("shift = {"), "{table}");
    let pasted = case.edited(|file| {
        let material = file.material.get_mut(&found.target.material).unwrap();
        material.relaxation = found.relaxation();
    });
    let pasted = pasted.unwrap();
    let body = pasted.scene().bodies().iter().find(|body| body.measured().is_some()).unwrap();
    let terms = body.material().unwrap().relaxation().unwrap().terms();
    for (term, own) in terms.iter().zip(found.terms()) {
        assert!((term.relaxation_time / own.relaxation_time - 1.0).abs() < 1e-9);
    }
}

#[test]
fn prior_needs_a_measured_relaxation_and_uncertainties() {
    let settings =
        Settings { model: Some(CalibrationModel::Ting), uses_prior: true, ..Settings::default() };
    let refused = |case: &Case, settings: &Settings, uncertainty: Option<f64>| {
        let mut measured = Restitutions::of("e", &[(0.5, 0.9)]);
        if let Some(uncertainty) = uncertainty {
            measured.set_uncertainty(uncertainty).unwrap();
        }
        Calibration::of(case, measured.into(), settings).unwrap_err()
    };
    let glass = case("glass", "glass");
    assert_eq!(refused(&glass, &settings, None), CalibrationFault::NoUncertainties);
    let material = "glass".to_string();
    assert_eq!(refused(&glass, &settings, Some(0.01)), CalibrationFault::NoPrior { material });
}
