//! Convergence and limits of the accuracy study.

use fem_study::accuracy::{Convergence, Limit, PowerLaw};

#[test]
fn order_and_limit_of_a_power_law_are_found() {
    for (order, limit, factor) in [(1.0, 62.8, 0.3), (2.0, -3.0, -0.7), (0.5, 1.0, 0.01)] {
        let levels: Vec<_> =
            [4.0f64, 2.8, 2.0, 1.4, 1.0].map(|h| (h, limit + factor * h.powf(order))).into();
        let fit = PowerLaw::fit(&levels).unwrap();
        assert!((fit.order - order).abs() < 1e-4, "{fit:?}");
        assert!((fit.limit - limit).abs() < 1e-5, "{fit:?}");
        assert!(fit.uncertainty < 1e-4, "{fit:?}");
    }
}

#[test]
fn noise_shows_in_the_uncertainty() {
    let levels = [(4.0, 1.41), (2.8, 1.27), (2.0, 1.21), (1.4, 1.13), (1.0, 1.105)];
    let fit = PowerLaw::fit(&levels).unwrap();
    assert!(fit.uncertainty > 5e-3 && (fit.limit - 1.0).abs() < 0.1, "{fit:?}");
    assert_eq!(PowerLaw::fit(&levels[..3]), None);
}

#[test]
fn power_law_fit_is_independent_of_level_order() {
    let mut levels = [(4.0, 1.41), (2.8, 1.27), (2.0, 1.21), (1.4, 1.13), (1.0, 1.105)];
    let fit = PowerLaw::fit(&levels).unwrap();
    levels.reverse();
    let reversed = PowerLaw::fit(&levels).unwrap();
    // The sums are rounded in another order; a golden section sees half the digits.
    assert!((fit.order - reversed.order).abs() < 1e-6, "{fit:?} {reversed:?}");
    assert!((fit.limit - reversed.limit).abs() < 1e-7, "{fit:?} {reversed:?}");
    levels[2].1 = f64::NAN;
    let spoilt = PowerLaw::fit(&levels).unwrap();
    assert!(spoilt.limit.is_nan() && spoilt.factor.is_nan());
}

#[test]
fn a_sequence_without_order_is_not_extrapolated() {
    let noise = [(4.0, 1.0), (3.0, 1.2), (2.0, 0.9), (1.5, 1.15), (1.0, 1.05)];
    let found = Convergence::of(&noise).unwrap();
    assert_eq!((found.limit, found.is_extrapolated, found.order), (1.05, false, None));
    assert!((found.uncertainty - 0.1).abs() < 1e-12);
    assert_eq!(Convergence::of(&noise[..1]).unwrap().uncertainty, f64::INFINITY);
    assert_eq!(Convergence::of(&[]), None);
}

#[test]
fn the_observed_order_is_that_of_the_sequence() {
    for order in [1.0, 2.0, 3.0] {
        let level = |h: f64| (h, 6.0 - 0.1 * h.powf(order));
        let levels = [4.0, 2.8, 2.0, 1.4, 1.0, 0.7].map(level);
        let seen = Convergence::of(&levels).unwrap().order.unwrap();
        assert!((seen.order - order).abs() < 1e-3, "{seen:?}");
        assert!((seen.factor - 0.1).abs() < 1e-3 && seen.standard_error < 1e-3, "{seen:?}");
    }
}

fn levels(sizes: &[f64], value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    sizes.iter().map(|size| (*size, value(*size))).collect()
}

/// Errors that both models share cancel: the limit does not depend on the coarse explicit meshes.
#[test]
fn explicit_and_condensed_results_are_compared_on_the_same_mesh() {
    let condensed = levels(&[8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0], |h| 3.0 + 0.01 * h * h);
    let springs = levels(&[8.0, 4.0], |h| 3.0 + 0.01 * h * h + 0.1 * h);
    let explicit = levels(&[8.0, 4.0], |h| 3.5 + 0.01 * h * h + 0.1 * h + 1e-4 * h);
    let limit = Limit::of(&condensed, &springs, &explicit).unwrap();
    assert!((limit.value - 3.5).abs() <= limit.uncertainty, "{limit:?}");
    assert!(limit.uncertainty < 5e-3, "{limit:?}");
    assert!((limit.condensed.unwrap() - 3.0).abs() < 1e-4, "{limit:?}");
}

/// A difference within the scatter is left out, and increases the uncertainty of the limit.
#[test]
fn scatter_enters_the_uncertainty_and_not_the_limit() {
    let condensed = levels(&[8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0], |h| 3.0 + 0.01 * h * h);
    let explicit = vec![(8.0, 3.64 - 0.02), (4.0, 3.16 + 0.01)];
    let limit = Limit::of(&condensed, &condensed, &explicit).unwrap();
    assert!((limit.value - 3.0).abs() < 1e-4 && limit.uncertainty >= 0.01, "{limit:?}");
}

/// Levels that seem converged but are not are detected by the other estimate of the same limit.
#[test]
fn a_different_limit_with_springs_adds_uncertainty() {
    let sizes = [8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0];
    let condensed = levels(&sizes, |h| 3.0 + 0.01 * h * h);
    let springs = levels(&sizes, |h| 3.1 - 0.02 * h * h);
    let limit = Limit::of(&condensed, &springs, &[]).unwrap();
    assert!((limit.uncertainty - 0.1).abs() < 0.02, "{limit:?}");
    let springs = levels(&sizes, |h| 3.0 - 0.02 * h * h);
    let limit = Limit::of(&condensed, &springs, &[]).unwrap();
    assert!(limit.uncertainty < 0.01, "{limit:?}");
}

#[test]
fn limit_of_one_level_has_infinite_uncertainty() {
    assert_eq!(Limit::of(&[], &[], &[(1.0, 2.0)]).unwrap().uncertainty, f64::INFINITY);
    assert_eq!(Limit::of(&[], &[], &[]), None);
}
