//! Limits of the quantities of interest of a scene.
//!
//! Condensed bodies converge smoothly and at little cost, but have no waves and no large strains;
//! explicit elements have all, and scatter. With the same springs between them both make the same errors
//! on the same mesh. So the limit is that of condensed bodies, L, and what explicit elements add to them
//! on the same mesh with the same springs, D:
//!
//! ```math
//! q_\infty = L + D, \qquad L = \lim_{h\to 0} q^{\rm condensed}(h), \qquad
//! D = q^{\rm explicit}(h) - q^{\rm springs}(h)
//! ```
//!
//! with D of the finest mesh that both have. Its uncertainty is that of L, found by leaving one level out,
//! and how far D moves from the next coarser mesh to the finest. Where D is less than its own uncertainty
//! it is left out and counts as uncertain. Condensed bodies with springs between them, whose stiffness
//! grows as elements become smaller, tend to the same L: the difference of both limits beyond their
//! uncertainties adds to the uncertainty of L.

use super::convergence::Convergence;

/// The limit of a quantity of interest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The limit, SI.
    pub value: f64,
    /// Uncertainty of the limit, SI.
    pub uncertainty: f64,
    /// Limit of condensed bodies alone, SI; `None` where they were not computed.
    pub condensed: Option<f64>,
    /// Difference of explicit elements to them, SI: waves, vibrations, large strains.
    pub added: Option<f64>,
}

impl Limit {
    /// Estimates the limit from values over the element size (m, SI), in any order: of condensed bodies, of
    /// those with springs, of explicit elements; `None` without any value.
    pub fn of(
        condensed: &[(f64, f64)],
        springs: &[(f64, f64)],
        explicit: &[(f64, f64)],
    ) -> Option<Self> {
        let explicit = finest_first(explicit);
        let Some(Convergence { limit: value, uncertainty: own, .. }) = Convergence::of(condensed)
        else {
            let Convergence { limit: value, uncertainty, .. } = Convergence::of(&explicit)?;
            return Some(Self { value, uncertainty, condensed: None, added: None });
        };
        let beside = Convergence::of(springs)
            .map_or(0.0, |other| (other.limit - value).abs() - other.uncertainty);
        let uncertainty = own.max(beside);
        let own = |size: f64| {
            let same = |other: &&(f64, f64)| (other.0 / size - 1.0).abs() < 1e-9;
            springs.iter().find(same).map(|(_, value)| *value)
        };
        let both = explicit.iter().filter_map(|(size, value)| Some(value - own(*size)?));
        let added: Vec<f64> = both.take(2).collect();
        let limit = Self { value, uncertainty, condensed: Some(value), added: None };
        Some(match added[..] {
            [] => limit,
            [only] => Self { uncertainty: uncertainty + only.abs(), added: Some(only), ..limit },
            [fine, coarse, ..] => {
                let moved = (fine - coarse).abs();
                let added = Some(fine);
                match fine.abs() > moved {
                    true => Self {
                        value: value + fine,
                        uncertainty: uncertainty + moved,
                        added,
                        ..limit
                    },
                    false => Self { uncertainty: uncertainty + fine.abs(), added, ..limit },
                }
            }
        })
    }
}

fn finest_first(levels: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted = levels.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(sizes: &[f64], value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        sizes.iter().map(|size| (*size, value(*size))).collect()
    }

    /// Errors that both models share cancel: the limit is right however coarse the explicit meshes.
    #[test]
    fn what_explicit_elements_add_is_taken_on_the_same_mesh() {
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
    fn a_difference_that_is_scatter_is_no_part_of_the_limit() {
        let condensed = levels(&[8.0, 5.6, 4.0, 2.8, 2.0, 1.4, 1.0], |h| 3.0 + 0.01 * h * h);
        let explicit = vec![(8.0, 3.64 - 0.02), (4.0, 3.16 + 0.01)];
        let limit = Limit::of(&condensed, &condensed, &explicit).unwrap();
        assert!((limit.value - 3.0).abs() < 1e-4 && limit.uncertainty >= 0.01, "{limit:?}");
    }

    /// Levels that seem converged but are not are detected by the other estimate of the same limit.
    #[test]
    fn a_limit_that_springs_do_not_share_is_less_certain() {
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
    fn one_level_is_not_certain() {
        assert_eq!(Limit::of(&[], &[], &[(1.0, 2.0)]).unwrap().uncertainty, f64::INFINITY);
        assert_eq!(Limit::of(&[], &[], &[]), None);
    }
}
