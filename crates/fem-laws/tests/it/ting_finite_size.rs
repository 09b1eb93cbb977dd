//! Viscoelastic impact of spheres of finite size: finite elements, an independent integration,
//! limits, robustness.

use crate::direct::direct;
use fem_laws::{FiniteSize, HertzImpact, LawError, Pair, PairRelaxation, Partner, Ting};
use fem_material::{ActsOn, Material};

use crate::common::{self, assert_close, assert_values, carson, decaying, relaxation_of, values};

/// Hertz' contact time of the elastic pair at 0.5 m/s, s.
const CONTACT_TIME: f64 = 63.235e-6;

const RADII: [f64; 2] = [11.1e-3, 7.95e-3];

fn elastic(youngs_modulus: f64, poissons_ratio: f64) -> Material {
    common::elastic([youngs_modulus, poissons_ratio, 2390.0])
}

fn relaxing(poissons_ratio: f64, acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    decaying([63e9, poissons_ratio, 2390.0], acts_on, terms)
}

fn glass(acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    relaxing(0.244, acts_on, terms)
}

/// The pair, and its relaxation.
fn pair_of(materials: [&Material; 2]) -> (Pair, PairRelaxation) {
    let [first, second] = [0, 1].map(|i| Partner::solid_sphere(2.0 * RADII[i], materials[i]));
    (Pair::new(first, second).unwrap(), relaxation_of(materials))
}

fn finite_size(materials: [&Material; 2]) -> FiniteSize {
    let [first, second] = [0, 1].map(|i| Some((RADII[i], materials[i])));
    FiniteSize::new(first, second).unwrap()
}

fn ting(materials: [&Material; 2]) -> Ting {
    let (pair, relaxation) = pair_of(materials);
    Ting::new(&pair, relaxation).with_finite_size(finite_size(materials))
}

fn restitution(material: &Material, speed: f64) -> f64 {
    ting([material, material]).impact(speed).unwrap().restitution
}

/// Quasi-static finite elements converged to h = 3.75 µm.
#[test]
fn elastic_spheres_meet_finite_elements() {
    let elastic = elastic(63e9, 0.244);
    let found = ting([&elastic, &elastic]).impact(0.5).unwrap();
    // First order in a/R: the next is (a/R)² = 8e-4 of the correction's own size, 7e-3.
    assert_values(&found, &[1.0, 62.818e-6, 107.99, 10.681e-6], 2e-4);
    assert_close(found.restitution, 1.0, 1e-9);
    // The project's older fit, c = −0.511 + …: it is 6 % weaker, 0.06 % of T.
    for (speed, change) in [(0.1, -0.0029), (0.25, -0.0044), (0.5, -0.0061), (1.0, -0.0085)] {
        let hertz = HertzImpact::new(&pair_of([&elastic; 2]).0, speed).unwrap().contact_time();
        let found = ting([&elastic; 2]).impact(speed).unwrap().contact_time.unwrap() / hertz - 1.0;
        assert!((found - change).abs() < 1e-3, "{speed}: {found}");
    }
}

/// Finite elements extrapolated to no element size.
#[test]
fn relaxing_spheres_meet_converged_finite_elements() {
    use ActsOn::{All, Shear};
    for (acts_on, rate_by_time, speed, restitution_fe) in [
        (All, 2708.0 * CONTACT_TIME, 0.5, 0.92763),
        (Shear, 2708.0 * CONTACT_TIME, 0.5, 0.94811),
        (All, 0.5, 0.5, 0.80425),
        (Shear, 0.5, 0.5, 0.85758),
        (All, 0.5, 0.01, 0.80300),
        (Shear, 0.5, 0.01, 0.85573),
        (Shear, 0.5, 1e-4, 0.85521),
    ] {
        let time = CONTACT_TIME * f64::powf(0.5 / speed, 0.2);
        let found = restitution(&glass(acts_on, &[(1.0, rate_by_time / time)]), speed);
        // The extrapolation is good to 1e-4; the pseudo-force in unloading is worth 2e-4. Without
        // the creep of the correction the shear cases are off by up to 1.6e-3.
        assert!((found - restitution_fe).abs() < 2.5e-4, "{acts_on:?} {rate_by_time} {found}");
    }
}

/// Finite elements of 14 µm at the contact, mesh included: G∞, rates, speeds, three terms.
#[test]
fn relaxing_spheres_meet_finite_elements() {
    let one = |weight: f64, rate: f64| vec![(weight, rate)];
    let three = || vec![(0.3, 790.7), (0.3, 7907.0), (0.2, 79070.0)];
    for (terms, speed, all, shear) in [
        (one(1.0, 79.07), 0.5, 0.997_797, 0.998_431),
        (one(1.0, 1581.3), 0.5, 0.957_069, 0.969_308),
        (one(1.0, 5730.9), 0.1, 0.804_116, 0.856_827),
        (one(1.0, 10433.0), 2.0, 0.805_762, 0.859_146),
        (one(1.0, 41733.0), 2.0, 0.424_301, 0.557_102),
        (one(0.5, 7907.0), 0.5, 0.905_140, 0.931_757),
        (one(0.2, 7907.0), 0.5, 0.962_742, 0.973_376),
        (one(0.8, 31628.0), 0.5, 0.559_452, 0.666_415),
        (three(), 0.1, 0.798_943, 0.850_184),
        (three(), 0.5, 0.816_344, 0.864_634),
        (three(), 2.0, 0.832_893, 0.878_056),
    ] {
        for (acts_on, expected) in [(ActsOn::All, all), (ActsOn::Shear, shear)] {
            let found = restitution(&glass(acts_on, &terms), speed);
            // The mesh, found by halving it, is worth 0.1 to 0.3 % of the loss, more at 0.1 m/s;
            // the pseudo-force in unloading up to 4e-4.
            let tolerance = 3e-4 + 3e-3 * (1.0 - expected);
            assert!((found - expected).abs() < tolerance, "{acts_on:?} {terms:?} {speed}: {found}");
        }
    }
}

/// m(t) by the correspondence principle taken at its word: added compliance and contact modulus
/// of elastic spheres with the moduli at s, and inversion by Gaver and Stehfest.
fn added(materials: [&Material; 2], time: f64) -> [f64; 2] {
    let pair = pair_of(materials).0;
    let scale = 4.0 / 3.0 * pair.effective_radius().sqrt();
    let at = |s: f64| {
        let spheres = materials.map(|material| at_laplace(material, s));
        let spheres = [&spheres[0], &spheres[1]];
        let (pair, size) = (pair_of(spheres).0, finite_size(spheres));
        let added = |contact: f64| size.added_approach(pair.contact_modulus() * scale, contact);
        // a = √(R* u): α at u = 1 m; ln a grows by 1 where ln u does by 2.
        let contact = pair.effective_radius().sqrt();
        let alpha = added(contact);
        [alpha, 0.5 * (alpha - added(contact * std::f64::consts::E))]
    };
    let n = STEHFEST.len();
    let mut sum = [0.0; 2];
    for (k, weight) in (1..=n).zip(STEHFEST) {
        let value = at(k as f64 * std::f64::consts::LN_2 / time);
        for i in 0..2 {
            sum[i] += weight / k as f64 * value[i];
        }
    }
    sum
}

/// The weights for n = 12: Σ_j (−1)^(k+6) j⁶ (2j)!/((6−j)! j! (j−1)! (k−j)! (2j−k)!).
const STEHFEST: [f64; 12] = [
    -0.016666666666666666,
    16.016666666666666,
    -1247.0,
    27554.333333333332,
    -263280.8333333333,
    1324138.7,
    -3891705.533333333,
    7053286.333333333,
    -8005336.5,
    5552830.5,
    -2155507.2,
    359251.2,
];

/// The elastic material with the moduli of Carson's transform at s.
fn at_laplace(material: &Material, s: f64) -> Material {
    let Some(series) = material.relaxation() else { return material.clone() };
    let fraction = carson(series.equilibrium_weight(), series.terms(), s);
    let shear = material.instantaneous().shear_modulus() * fraction;
    let all = series.acts_on() == ActsOn::All;
    let bulk = material.instantaneous().bulk_modulus() * if all { fraction } else { 1.0 };
    let youngs_modulus = 9.0 * bulk * shear / (3.0 * bulk + shear);
    elastic(youngs_modulus, youngs_modulus / (2.0 * shear) - 1.0)
}

/// The direct sums with that kernel converge to the collocation solution.
#[test]
fn ting_with_finite_size_equals_direct_integration() {
    let all = glass(ActsOn::All, &[(1.0, 0.5 / CONTACT_TIME)]);
    let solid = glass(ActsOn::All, &[(0.6, 1.0 / CONTACT_TIME)]);
    let shear = glass(ActsOn::Shear, &[(1.0, 0.5 / CONTACT_TIME)]);
    let three = glass(ActsOn::Shear, &[(0.3, 790.7), (0.3, 7907.0), (0.2, 79070.0)]);
    let steel = elastic(210e9, 0.3);
    for (materials, tolerance) in [
        // Nothing approximate in the transform: 1/2000² of the steps, and the inversion's 1e-5 of a
        // correction of some per cent.
        ([&all, &all], 1e-6),
        ([&solid, &steel], 1e-6),
        ([&all, &solid], 1e-6),
        // The interpolation in g, 0.4 % of the correction, which is worth some 1e-2.
        ([&shear, &shear], 1e-4),
        ([&three, &three], 1e-4),
        ([&three, &steel], 1e-4),
        ([&shear, &solid], 1e-4),
    ] {
        let (pair, relaxation) = pair_of(materials);
        let found = ting(materials).impact(0.5).unwrap();
        // Linear in √t between 300 entries.
        let end = 4.0 * HertzImpact::new(&pair, 0.5).unwrap().contact_time();
        let table: Vec<_> = (0..=300)
            .map(|i| added(materials, (f64::from(i) / 300.0).powi(2).max(1e-9) * end))
            .collect();
        let kernel = |time: f64| {
            let place = 300.0 * (time / end).sqrt();
            let index = (place as usize).min(299);
            let part = place - index as f64;
            [0, 1].map(|i| table[index][i] + part * (table[index + 1][i] - table[index][i]))
        };
        let fine = direct(&pair, &relaxation, Some(&kernel), 0.5, 2000, 0.0);
        let found = values(&found);
        // The time ends on a step.
        let place = [0, 1, 2, 4];
        for (k, tolerance) in [tolerance, 6e-4, tolerance, tolerance].into_iter().enumerate() {
            assert_close(found[k], fine[place[k]], tolerance);
        }
    }
}

#[test]
fn finite_size_fades_with_the_contact() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let rate = 0.5 / CONTACT_TIME * (1e-9f64 / 0.5).powf(0.2);
        let material = glass(acts_on, &[(1.0, rate)]);
        let (pair, relaxation) = pair_of([&material; 2]);
        let half_space = Ting::new(&pair, relaxation).impact(1e-9).unwrap();
        let found = ting([&material; 2]).impact(1e-9).unwrap();
        // a/R falls as v^(2/5): from 3e-2 at 0.5 m/s by 3e-4; the change of e, 2.4e-3, with it, but
        // for ln(R/a), which grows from 4 to 12.
        assert_close(found.contact_time.unwrap(), half_space.contact_time.unwrap(), 1e-5);
        assert_close(found.restitution, half_space.restitution, 4e-6);
    }
}

/// Relaxed before the collision begins, and never: elastic, with Poisson's ratio of then.
#[test]
fn ting_with_finite_size_has_elastic_limits() {
    let relaxed = at_laplace(&glass(ActsOn::Shear, &[(0.6, 1.0)]), 1e-30);
    for (rate, expected) in [(1e-6, elastic(63e9, 0.244)), (1e13, relaxed)] {
        let found = ting([&glass(ActsOn::Shear, &[(0.6, rate)]); 2]).impact(0.5).unwrap();
        let expected = ting([&expected; 2]).impact(0.5).unwrap();
        // βT is 6e-11, or its inverse 2e-9.
        assert_close(found.restitution, 1.0, 1e-8);
        assert_close(found.contact_time.unwrap(), expected.contact_time.unwrap(), 1e-7);
        assert_close(found.max_approach, expected.max_approach, 1e-7);
    }
}

/// With a bulk modulus so large that ν stays at 1/2, it does not matter which moduli relax.
#[test]
fn relaxing_moduli_do_not_matter_for_incompressible_bodies() {
    let of = |acts_on| restitution(&relaxing(0.499_999, acts_on, &[(1.0, 1e4)]), 0.5);
    // 1 − 2ν.
    assert_close(of(ActsOn::Shear), of(ActsOn::All), 1e-5);
}

/// From elastic to viscous, like bodies and very unlike ones, auxetic to incompressible: always an
/// answer, or a contact that is too large.
#[test]
fn ting_with_finite_size_returns_a_valid_result_at_all_rates() {
    let soft = elastic(1e5, 0.1);
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for nu in [-0.9, 0.0, 0.244, 0.499_999_9] {
            for weight in [1e-9, 0.9, 1.0] {
                // A Maxwell fluid that flows for 1e15 contact times may end in a refusal.
                let fastest = if weight < 1.0 { 17 } else { 7 };
                for exponent in (-16..=fastest).step_by(3) {
                    let rate = 1.6 * 10f64.powi(exponent);
                    let terms = [(0.5 * weight, rate), (0.5 * weight, rate * (1.0 + 1e-6))];
                    let material = relaxing(nu, acts_on, &terms);
                    for other in [&material, &soft] {
                        match ting([&material, other]).impact(1e-3) {
                            Ok(found) => assert!((0.0..1.0 + 1e-8).contains(&found.restitution)),
                            Err(LawError::OutsideValidity { .. }) => {}
                            Err(error) => panic!("{acts_on:?} {nu} {weight} {rate:e}: {error}"),
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn ting_with_finite_size_rejects_impossible_data() {
    let material = glass(ActsOn::All, &[(1.0, 2708.0)]);
    let found = ting([&material; 2]).impact(100.0);
    assert!(matches!(found, Err(LawError::OutsideValidity { .. })));
    assert!(FiniteSize::new(Some((0.0, &material)), None).is_err());
}
