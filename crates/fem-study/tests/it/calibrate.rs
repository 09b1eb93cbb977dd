//! The target of a calibration, and the single Maxwell term that it starts from.

use fem_case::schema::{self, BodyTable, MaterialTable};
use fem_case::{Case, CaseFile};
use fem_material::{ActsOn, PronyTerm};
use fem_study::calibrate::{
    Beyond, Calibration, CalibrationFault, CalibrationModel, Maxwell, Settings, Target,
};
use fem_study::fit::FitError;
use fem_study::measured::Restitutions;

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
    let settings = Settings { model: CalibrationModel::Ting, n_terms: 1, ..Settings::default() };
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
