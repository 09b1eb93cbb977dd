//! Prony terms that relax much faster or slower than the contact: Ting's model with and without them.

use fem_laws::{
    FastSlowLimits, HertzImpact, Impact, ImpactDifference, LawError, Pair, Partner, RelativeError,
    Ting,
};
use fem_material::{ActsOn, Material, PronyTerm};

use crate::common::{self, GLASS, relaxation_of, relaxing, steel};

const SPEED: f64 = 0.5;

/// `terms` of weight and T/τ at the contact time.
fn glass(terms: &[(f64, f64)], acts_on: ActsOn) -> Material {
    let time = hertz([&common::glass(); 2]).contact_time();
    let terms: Vec<_> = terms.iter().map(|(weight, ratio)| (*weight, time / ratio)).collect();
    relaxing(GLASS, acts_on, &terms)
}

fn pair(materials: [&Material; 2]) -> Pair {
    let [first, second] = materials.map(|material| Partner::solid_sphere(2e-2, material));
    Pair::new(first, second).unwrap()
}

fn hertz(materials: [&Material; 2]) -> HertzImpact {
    HertzImpact::new(&pair(materials), SPEED).unwrap()
}

fn ting(materials: [&Material; 2]) -> Impact {
    Ting::new(&pair(materials), relaxation_of(materials)).impact(SPEED).unwrap()
}

fn of_each(tolerance: f64) -> RelativeError {
    RelativeError { restitution: tolerance, contact_time: tolerance, peak_force: tolerance }
}

fn folded(materials: [&Material; 2], tolerance: f64) -> FastSlowLimits {
    let time = hertz(materials).contact_time();
    FastSlowLimits::new(materials.map(Some), time, &of_each(tolerance)).unwrap()
}

/// Estimate and result, each as restitution, relative time, relative force.
fn estimate_and_result(materials: [&Material; 2], tolerance: f64) -> [[f64; 3]; 2] {
    let folded = folded(materials, tolerance);
    let without = folded.materials.each_ref().map(|material| material.as_ref().unwrap());
    let reference = ting(materials);
    let ImpactDifference { restitution, contact_time, peak_force } =
        ImpactDifference::of(&ting(without), &reference);
    let time = contact_time.unwrap() / reference.contact_time.unwrap();
    let error = folded.error;
    [
        [error.restitution, error.contact_time, error.peak_force],
        [restitution, time, peak_force / reference.peak_force],
    ]
}

/// Perturbation theory to its own order: weak terms, very slow or fast.
#[test]
fn first_order_is_that_of_tings_model() {
    let steel = steel();
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for (weight, ratio) in [(0.5, 1e-4), (1.0, 1e-5), (0.05, 1e4), (0.5, 1e5), (0.9, 1e6)] {
            let glass = glass(&[(weight, ratio)], acts_on);
            for materials in [[&glass, &glass], [&glass, &steel], [&steel, &glass]] {
                let [estimate, found] = estimate_and_result(materials, 1e-2);
                for i in 0..3 {
                    // The loss itself at T/τ = 1e-4; √(τ/T) of first touch at 1e4, of T.
                    let relative = found[i] / estimate[i] - 1.0;
                    assert!(relative.abs() < 0.02, "{acts_on:?} {weight} {ratio} {i}: {relative}");
                }
            }
        }
    }
}

/// As far as an error of 1e-2 the first order is good to a fifth, be the terms many.
#[test]
fn errors_are_as_estimate() {
    let steel = steel();
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for terms in [
            &[(0.3, 0.02)][..],
            &[(0.3, 3e3)],
            &[(0.1, 0.01), (0.3, 1.0), (0.2, 3e3)],
            &[(0.05, 0.01), (0.05, 0.1), (0.05, 3e2), (0.05, 3e3), (0.05, 3e4)],
        ] {
            let glass = glass(terms, acts_on);
            for materials in [[&glass, &glass], [&glass, &steel]] {
                let [estimate, found] = estimate_and_result(materials, 1e-2);
                assert!(estimate[0] > 1e-4 && estimate[0] < 1e-2);
                // A lasting term of T/τ = 1 damps the pulse that the others see.
                let tolerance = if terms.len() == 3 { 0.5 } else { 0.2 };
                for i in [0, 2] {
                    let relative = found[i] / estimate[i] - 1.0;
                    assert!(relative.abs() < tolerance, "{acts_on:?} {terms:?} {i}: {relative}");
                }
                // Of the time slow and fast terms differ by a factor of twelve, and what remains of the
                // second order is of the size of a slow term's first.
                assert!((found[1] - estimate[1]).abs() < 0.2 * estimate[2], "{terms:?} {found:?}");
            }
        }
    }
}

/// In between the estimate is a bound, of the time a third of one.
#[test]
fn weak_terms_are_never_worse_than_estimate() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for ratio in [0.1, 0.3, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 100.0, 300.0] {
            let glass = glass(&[(1e-3, ratio)], acts_on);
            let [estimate, found] = estimate_and_result([&glass; 2], 1e-2);
            assert!(estimate[0] > 0.0);
            for (i, bound) in [(0, 1.02), (1, 3.0), (2, 1.02)] {
                assert!(found[i].abs() < bound * estimate[i], "{ratio} {i} {found:?} {estimate:?}");
            }
        }
    }
}

#[test]
fn fast_terms_are_removed_from_the_moduli() {
    let terms = [(0.25, 1e7), (0.25, 1.0), (0.125, 1e-7)];
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let glass = glass(&terms, acts_on);
        let folded = folded([&glass; 2], 1e-4);
        assert_eq!((folded.n_fast, folded.n_slow), ([1; 2], [1; 2]));
        let found = folded.materials[0].as_ref().unwrap();
        let (before, after) = (glass.instantaneous(), found.instantaneous());
        assert_eq!(after.shear_modulus(), 0.75 * before.shear_modulus());
        let bulk_factor = if acts_on == ActsOn::All { 0.75 } else { 1.0 };
        assert_eq!(after.bulk_modulus(), bulk_factor * before.bulk_modulus());
        let series = found.relaxation().unwrap();
        assert_eq!(series.terms(), [PronyTerm { weight: 0.25 / 0.75, ..series.terms()[0] }]);
        // What it relaxes to is G∞ and the slow term's.
        let slow = 0.125 * before.shear_modulus();
        let expected = glass.equilibrium_shear_modulus() + slow;
        assert!((found.equilibrium_shear_modulus() / expected - 1.0).abs() < 1e-15);
    }
}

#[test]
fn terms_near_the_contact_time_are_not_folded() {
    // A fluid's only term, however fast; and a term of the contact time.
    for terms in [&[(1.0, 1e9)][..], &[(0.3, 3.0)]] {
        let glass = glass(terms, ActsOn::Shear);
        let folded = folded([&glass; 2], 1e-4);
        assert_eq!(folded.materials, [Some(glass.clone()), Some(glass)]);
        assert_eq!((folded.n_fast, folded.n_slow), ([0; 2], [0; 2]));
        assert_eq!(folded.error, RelativeError::default());
    }
    // Beside something that stays, a fluid's fast term may go.
    let fluid = glass(&[(0.5, 1e9), (0.5, 3.0)], ActsOn::All);
    assert_eq!(folded([&fluid; 2], 1e-4).n_fast, [1; 2]);
}

/// All folded terms together keep the tolerance, and the tighter one folds less.
#[test]
fn folded_terms_together_stay_within_the_tolerance() {
    let terms: Vec<(f64, f64)> = (-8..=8).map(|k| (0.05, 10f64.powi(k))).collect();
    let glass = glass(&terms, ActsOn::Shear);
    let mut before = usize::MAX;
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let folded = folded([&glass, &glass], tolerance);
        let RelativeError { restitution, contact_time, peak_force } = folded.error;
        assert!(restitution.max(contact_time).max(peak_force) <= tolerance);
        let n = folded.n_fast[0] + folded.n_slow[0];
        assert!(n > 0 && n < before);
        before = n;
        let [estimate, found] = estimate_and_result([&glass; 2], tolerance);
        // What relaxes beside them halves the modulus within the contact. Ting is good to 1e-8.
        assert!(found[0] < 1.5 * estimate[0] + 1e-8, "{tolerance} {found:?} {estimate:?}");
    }
}

#[test]
fn rigid_and_elastic_bodies_have_no_terms() {
    let steel = steel();
    let folded = FastSlowLimits::new([Some(&steel), None], 1e-5, &of_each(1e-4)).unwrap();
    assert_eq!(folded.materials, [Some(steel), None]);
    assert_eq!(folded.error, RelativeError::default());
}

#[test]
fn fast_slow_limits_reject_impossible_data() {
    let steel = steel();
    assert_eq!(FastSlowLimits::new([None; 2], 1e-5, &of_each(1e-4)), Err(LawError::TwoWalls));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(FastSlowLimits::new([Some(&steel); 2], bad, &of_each(1e-4)).is_err());
        assert!(FastSlowLimits::new([Some(&steel); 2], 1e-5, &of_each(bad)).is_err());
    }
}

#[test]
fn impact_difference_is_found_minus_reference() {
    let (elastic, relaxing) = (steel(), glass(&[(0.3, 1.0)], ActsOn::All));
    let (found, reference) = (ting([&elastic; 2]), ting([&relaxing; 2]));
    let difference = ImpactDifference::of(&found, &reference);
    assert_eq!(difference.restitution, found.restitution - reference.restitution);
    assert!(difference.restitution > 0.0 && difference.contact_time.unwrap() < 0.0);
    assert_eq!(difference.peak_force, found.peak_force - reference.peak_force);
    let fluid = ting([&glass(&[(1.0, 1e6)], ActsOn::All); 2]);
    assert_eq!(ImpactDifference::of(&fluid, &reference).contact_time, None);
}
