//! Inverse problems compared with published values and with the laws themselves.

use crate::common::{glass, glass_model};
use fem_data::estimate::{
    FitError, Model, Point, Problem, check_value, find_parameter, invert, loss_parameter,
    parse_value,
};
use fem_laws::{EndRule, LawFamily};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

/// A restitution of 0.92 at 0.5 m/s needs β = 2982 1/s with constant ν, 4173 1/s with an elastic bulk modulus (the
/// project's reference calculation, by another program).
#[test]
fn decay_rate_of_the_glass() {
    for (acts_on, expected) in [(ActsOn::All, 2982.0), (ActsOn::Shear, 4173.0)] {
        let model = glass_model(LawFamily::Ting, Some((2708.0, acts_on)));
        let found = invert(&model, 0, &[2708.0], 0.5, 0.92).unwrap();
        assert_eq!(found.solutions.len(), 1);
        // Printed to a unit.
        assert!((found.solutions[0] - expected).abs() < 0.5, "{:?}", found.solutions);
        let rates = model.decay_rates(found.solutions[0]);
        assert!(rates.iter().flatten().all(|rate| (rate / found.solutions[0] - 1.0).abs() < 1e-14));
    }
}

/// For every law and every damping parameter the values that are found give the wanted restitution.
#[test]
fn every_law_has_an_inverse() {
    for family in LawFamily::ALL.into_iter().filter(|family| *family != LawFamily::Ting) {
        // Nothing of Hertz' is lost.
        let Some(index) = family.loss_parameter() else { continue };
        let model = glass_model(family, None);
        let mut values = Problem::new(&model, &[Point::new(0.5, 0.9)], &[]).unwrap().values;
        for wanted in [0.99, 0.92, 0.5, 0.1] {
            // Their coefficient is first order in 1 − e: the smallest e entered makes 0.66. `mdr` jumps from 1 at first yield.
            let is_out_of_reach = match family {
                LawFamily::HuntCrossley => wanted < 0.7,
                LawFamily::Mdr => wanted > 0.95,
                _ => false,
            };
            if is_out_of_reach {
                let error = invert(&model, index, &values, 0.5, wanted).unwrap_err();
                assert!(matches!(error, FitError::NoSolution { .. }));
                continue;
            }
            let found = invert(&model, index, &values, 0.5, wanted).unwrap();
            assert_eq!(found.solutions.len(), 1, "{family:?} {wanted}");
            values[index] = found.solutions[0];
            let e = model.outcome(&values, 0.5).unwrap().restitution;
            // The search ends at 1e-14 of a quarter of a decade; e is computed to 1e-10.
            assert!((e - wanted).abs() < 1e-8, "{family:?} {wanted}: {e}");
        }
    }
}

/// Tsuji's law has e = exp(−πζ/√(1−ζ²)) with α = √5 ζ.
#[test]
fn tsujis_law_has_its_closed_form() {
    let glass = glass(None);
    let pair = *glass_model(LawFamily::Tsuji, None).pair();
    let materials = [Some(glass.clone()), Some(glass)];
    let model = Model::new(&pair, materials, LawFamily::Tsuji, EndRule::ZeroOverlap).unwrap();
    let found = invert(&model, 0, &[0.1], 0.5, 0.92).unwrap().solutions[0];
    let loss = 0.92f64.ln().abs();
    let exact = 5f64.sqrt() * loss / std::f64::consts::PI.hypot(loss);
    assert!((found / exact - 1.0).abs() < 1e-7);
}

/// A solid that keeps half its modulus loses most at one rate: a smaller loss has two rates, a larger one
/// none.
#[test]
fn a_solid_has_two_rates_or_none() {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let term = PronyTerm { weight: 0.5, relaxation_time: 1e-5 };
    let series = PronySeries::new(vec![term], ActsOn::All).unwrap();
    let solid = Material::new(2390.0, moduli, Some(series)).unwrap();
    let pair = *glass_model(LawFamily::Tsuji, None).pair();
    let materials = [Some(solid.clone()), Some(solid)];
    let model = Model::new(&pair, materials, LawFamily::Ting, EndRule::ZeroForce).unwrap();
    let found = invert(&model, 0, &[1e5], 0.5, 0.92).unwrap();
    assert_eq!(found.solutions.len(), 2);
    for rate in &found.solutions {
        let e = model.outcome(&[*rate], 0.5).unwrap().restitution;
        // Ting is good to 1e-8 at its best.
        assert!((e - 0.92).abs() < 1e-6, "{rate}: {e}");
    }
    let error = invert(&model, 0, &[1e5], 0.5, 0.3).unwrap_err();
    assert!(matches!(error, FitError::NoSolution { least, .. } if least > 0.5), "{error}");
}

#[test]
fn impossible_restitutions_are_rejected() {
    let model = glass_model(LawFamily::KuwabaraKono, None);
    for wanted in [0.0, 1.0, -0.5, 1.1, f64::NAN] {
        let error = invert(&model, 0, &[1e-6], 0.5, wanted).unwrap_err();
        assert!(matches!(error, FitError::OutOfRange { quantity: "restitution", .. }));
    }
    assert!(invert(&model, 0, &[1e-6], 0.0, 0.9).is_err());
    let pair = *model.pair();
    let elastic = Model::new(&pair, [Some(glass(None)), None], LawFamily::Ting, EndRule::ZeroForce);
    assert_eq!(elastic.unwrap_err(), FitError::NoRelaxation);
}

#[test]
fn parameters_are_found_and_their_values_are_checked() {
    let family = LawFamily::BordbarHyppanen;
    assert_eq!(find_parameter(family, " n "), Ok(1));
    let error = find_parameter(family, "b").unwrap_err();
    assert_eq!(error.help().unwrap(), "its parameters are a, n");
    assert_eq!(loss_parameter(family), Ok(0));
    let error = loss_parameter(LawFamily::Hertz).unwrap_err();
    assert_eq!(error.to_string(), "hertz loses nothing: it has no parameter to find");
    let [a, n] = family.parameters() else { panic!("two parameters") };
    assert_eq!(parse_value(n, "'0.65'"), Ok(0.65));
    for (parameter, value, allowed) in [
        (a, 0.0, "it must be greater than 0"),
        (a, f64::INFINITY, "it must be greater than 0"),
        (n, 7.0, "it must be from 0 to 3"),
        (n, f64::NAN, "it must be from 0 to 3"),
    ] {
        assert_eq!(check_value(parameter, value).unwrap_err().help().unwrap(), allowed);
    }
}
