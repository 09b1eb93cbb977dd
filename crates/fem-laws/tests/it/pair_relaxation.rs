//! E*(t) of a pair: limits, known series, the rational identity in s, Laplace inversion.

use fem_laws::{LawError, PairRelaxation};
use fem_material::{ActsOn, Material};

use crate::common::{self, carson, relaxing};

fn material(modulus: f64, nu: f64, acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    relaxing([modulus, nu, 1000.0], acts_on, terms)
}

fn elastic(modulus: f64, nu: f64) -> Material {
    common::elastic([modulus, nu, 1000.0])
}

/// Ten decades, a weight of 0, a tiny one, two equal and two nearly equal times.
const WIDE: [(f64, f64); 9] = [
    (0.1, 1e-8),
    (0.0, 1e-7),
    (0.2, 1e-6),
    (0.05, 1e-6),
    (1e-9, 1e-5),
    (0.15, 1e-4),
    (0.1, 1.000001e-4),
    (0.2, 1e-1),
    (0.1, 1e2),
];

/// Times that differ by 1e-6 cost 1e-16/1e-6 at worst (found: 1e-11); without them 1e-14 is met.
const NEAR_TIMES: f64 = 1e-10;

const FLUID: [(f64, f64); 3] = [(0.5, 1e-5), (0.3, 1e-3), (0.2, 1.0)];

fn pairs() -> Vec<(Option<Material>, Option<Material>)> {
    let wide = || material(2e9, 0.3, ActsOn::Shear, &WIDE);
    let wide_all = || material(5e9, 0.4, ActsOn::All, &WIDE);
    let fluid = || material(1e9, 0.45, ActsOn::Shear, &FLUID);
    let cork = || material(1e8, -0.3, ActsOn::Shear, &[(0.7, 3e-4)]);
    vec![
        (Some(wide()), None),
        (Some(wide_all()), None),
        (Some(wide()), Some(wide_all())),
        (Some(wide()), Some(fluid())),
        (Some(fluid()), Some(fluid())),
        (Some(fluid()), Some(elastic(7e10, 0.2))),
        (Some(cork()), Some(wide_all())),
        (Some(material(1e9, 0.4999, ActsOn::Shear, &FLUID)), Some(elastic(1e5, 0.0))),
    ]
}

/// s-multiplied Laplace transform of a body's contact compliance, from the elastic formula.
fn body_compliance(material: Option<&Material>, s: f64) -> f64 {
    let Some(material) = material else { return 0.0 };
    let series = material.relaxation();
    let fraction =
        series.map_or(1.0, |series| carson(series.equilibrium_weight(), series.terms(), s));
    let moduli = material.instantaneous();
    let shear = moduli.shear_modulus() * fraction;
    let all = material.relaxation().is_some_and(|series| series.acts_on() == ActsOn::All);
    let bulk = moduli.bulk_modulus() * if all { fraction } else { 1.0 };
    (3.0 * bulk + 4.0 * shear) / (4.0 * shear * (3.0 * bulk + shear))
}

fn exact_carson(pair: &(Option<Material>, Option<Material>), s: f64) -> f64 {
    let compliance = |s| body_compliance(pair.0.as_ref(), s) + body_compliance(pair.1.as_ref(), s);
    let instantaneous: f64 = [&pair.0, &pair.1]
        .into_iter()
        .flatten()
        .map(|material| material.instantaneous().plane_strain_modulus().recip())
        .sum();
    instantaneous / compliance(s)
}

fn relaxation(pair: &(Option<Material>, Option<Material>)) -> PairRelaxation {
    PairRelaxation::new(pair.0.as_ref(), pair.1.as_ref()).unwrap()
}

/// A rational function that agrees on 400 points with one of some tens of coefficients is it.
#[test]
fn series_is_the_rational_function_in_s() {
    for pair in pairs() {
        let found = relaxation(&pair);
        for i in 0..400 {
            let s = 10f64.powf(-12.0 + 24.0 * f64::from(i) / 399.0);
            let carson = carson(found.equilibrium_weight(), found.terms(), s);
            let deviation = carson / exact_carson(&pair, s) - 1.0;
            assert!(deviation.abs() < NEAR_TIMES, "s {s:e}: {deviation:e}");
        }
    }
}

#[test]
fn pair_relaxation_has_instantaneous_and_equilibrium_limits() {
    for pair in pairs() {
        let found = relaxation(&pair);
        assert!((found.relaxation(0.0) - 1.0).abs() < NEAR_TIMES);
        assert!((found.relaxation(-1.0) - 1.0).abs() < NEAR_TIMES);
        // Elastic solution with the equilibrium moduli, reached from s = 1e-30.
        let equilibrium = exact_carson(&pair, 1e-30);
        assert!((found.relaxation(1e30) - equilibrium).abs() < 1e-13);
        let flows = [&pair.0, &pair.1].into_iter().flatten().any(|material| {
            material.relaxation().is_some_and(|series| series.equilibrium_weight() < 1e-15)
        });
        assert_eq!(found.equilibrium_weight() < 1e-15, flows);
        for term in found.terms() {
            assert!(term.weight > 0.0 && term.relaxation_time > 0.0);
        }
        assert!(found.terms().is_sorted_by(|a, b| a.relaxation_time > b.relaxation_time));
    }
}

/// A body of constant Poisson's ratio on the wall, or two equal ones, relax as their material.
#[test]
fn constant_poissons_ratio_keeps_the_series() {
    let terms = [(0.3, 1e-6), (0.2, 1e-3), (1e-6, 2e-3), (0.1, 10.0)];
    let one = material(2e9, 0.3, ActsOn::All, &terms);
    for second in [None, Some(&one)] {
        let found = PairRelaxation::new(Some(&one), second).unwrap();
        assert_eq!(found.terms().len(), terms.len());
        for (found, (weight, time)) in found.terms().iter().rev().zip(terms) {
            // A pole's weight comes out of the others' to rounding of the largest.
            assert!((found.weight - weight).abs() < 1e-13);
            assert!((found.relaxation_time / time - 1.0).abs() < 1e-9);
        }
        assert!((found.equilibrium_weight() - 0.399999).abs() < 1e-14);
    }
}

/// One Maxwell term in shear on a wall: the quadratic in s solved by hand.
#[test]
fn maxwell_shear_on_a_wall_equals_the_closed_form() {
    let found = PairRelaxation::new(Some(&material(2.5, 0.25, ActsOn::Shear, &[(1.0, 1.0)])), None)
        .unwrap();
    // G = 1, K = 5/3, with σ = s/(s+1): E* = 4σ(5+σ)/(5+4σ) = 4s(6s+5)/((s+1)(9s+5)).
    let poles = [5.0 / 9.0, 1.0];
    let at_0 = 24.0 / 9.0;
    // Residues of E*/s = 4(6s+5)/((s+1)(9s+5)) over E*(∞).
    let weights = [4.0 * (5.0 - 10.0 / 3.0) / (4.0 / 9.0) / 9.0 / at_0, 1.0 / at_0];
    for i in 0..2 {
        assert!((found.terms()[i].relaxation_time * poles[i] - 1.0).abs() < 1e-14);
        assert!((found.terms()[i].weight - weights[i]).abs() < 1e-14);
    }
    assert_eq!(found.equilibrium_weight(), 0.0);
}

/// Gaver & Stehfest's inversion of E*(s)/s, which uses real s only.
#[test]
fn pair_relaxation_equals_numerical_laplace_inversion() {
    const N: usize = 14;
    let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
    let weights: Vec<f64> = (1..=N)
        .map(|i| {
            let sum: f64 = (i.div_ceil(2)..=i.min(N / 2))
                .map(|k| {
                    (k as f64).powi(N as i32 / 2) * factorial(2 * k)
                        / (factorial(N / 2 - k)
                            * factorial(k)
                            * factorial(k - 1)
                            * factorial(i - k)
                            * factorial(2 * k - i))
                })
                .sum();
            sum * if (i + N / 2).is_multiple_of(2) { 1.0 } else { -1.0 }
        })
        .collect();
    for pair in pairs() {
        let found = relaxation(&pair);
        for i in 0..60 {
            let time = 10f64.powf(-10.0 + 14.0 * f64::from(i) / 59.0);
            let unit = 2f64.ln() / time;
            // E*(s)/s times ln 2/t is the Carson transform over the index.
            let inverted: f64 = (1..=N)
                .map(|j| weights[j - 1] * exact_carson(&pair, j as f64 * unit) / j as f64)
                .sum();
            // The method is good to 1e-4 of a function that falls within a decade.
            assert!((inverted - found.relaxation(time)).abs() < 5e-4, "t {time:e}");
        }
    }
}

#[test]
fn elastic_pairs_do_not_relax() {
    let glass = elastic(63e9, 0.244);
    for second in [None, Some(&glass)] {
        let found = PairRelaxation::new(Some(&glass), second).unwrap();
        assert_eq!((found.equilibrium_weight(), found.terms().len()), (1.0, 0));
    }
    let silent = material(1e9, 0.3, ActsOn::Shear, &[(0.0, 1.0), (0.0, 2.0)]);
    let found = PairRelaxation::new(Some(&silent), Some(&glass)).unwrap();
    assert!(found.terms().is_empty() && (found.equilibrium_weight() - 1.0).abs() < 1e-15);
}

#[test]
fn order_of_the_bodies_does_not_matter() {
    for pair in pairs() {
        let (one, other) = (relaxation(&pair), relaxation(&(pair.1.clone(), pair.0.clone())));
        for time in [0.0, 1e-6, 1e-3, 1.0] {
            assert!((one.relaxation(time) - other.relaxation(time)).abs() < NEAR_TIMES);
        }
    }
}

#[test]
fn pair_relaxation_rejects_impossible_data() {
    assert_eq!(PairRelaxation::new(None, None), Err(LawError::TwoWalls));
    let instant = material(1e9, 0.3, ActsOn::All, &[(0.5, 1e-310)]);
    assert!(PairRelaxation::new(Some(&instant), None).is_err());
}
