//! Limits of the quantities of interest of a scene.
//!
//! Condensed bodies converge smoothly and at little cost, but have no waves and no large strains. Explicit
//! elements have both, but their results scatter. With the same springs between them both make the same errors
//! on the same mesh. So the limit is that of condensed bodies, L, plus the difference of explicit elements to
//! them on the same mesh with the same springs, D:
//!
//! ```math
//! q_\infty = L + D, \qquad L = \lim_{h\to 0} q^{\rm condensed}(h), \qquad
//! D = q^{\rm explicit}(h) - q^{\rm springs}(h)
//! ```
//!
//! with D of the finest mesh that both have. The uncertainty of the limit is that of L, found by leaving one level
//! out, plus the change of D from the next coarser mesh to the finest. If D is less than its own uncertainty, it
//! is left out and counts as uncertain. Condensed bodies with springs between them, whose stiffness grows as
//! elements become smaller, tend to the same L: the difference of both limits beyond their uncertainties adds
//! to the uncertainty of L.

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
    /// Estimates the limit from values (SI) over the element size (m), in any order: of condensed bodies, of
    /// those with springs, and of explicit elements; `None` without any value.
    pub fn of(
        condensed: &[(f64, f64)],
        springs: &[(f64, f64)],
        explicit: &[(f64, f64)],
    ) -> Option<Self> {
        let Some(Convergence { limit: value, uncertainty, .. }) = Convergence::of(condensed) else {
            let Convergence { limit: value, uncertainty, .. } = Convergence::of(explicit)?;
            return Some(Self { value, uncertainty, condensed: None, added: None });
        };
        let between_limits = Convergence::of(springs)
            .map_or(0.0, |other| (other.limit - value).abs() - other.uncertainty);
        let limit = Self {
            value,
            uncertainty: uncertainty.max(between_limits),
            condensed: Some(value),
            added: None,
        };
        let mut explicit = explicit.to_vec();
        explicit.sort_by(|a, b| a.0.total_cmp(&b.0));
        let added = explicit.iter().filter_map(|(size, value)| {
            let (_, springs) = springs.iter().find(|other| (other.0 / size - 1.0).abs() < 1e-9)?;
            Some(value - springs)
        });
        let added: Vec<f64> = added.take(2).collect();
        let Some(&fine) = added.first() else { return Some(limit) };
        // A single difference is as uncertain as it is large.
        let change = added.get(1).map_or(f64::INFINITY, |coarse| (fine - coarse).abs());
        let is_clear = fine.abs() > change;
        Some(Self {
            value: if is_clear { value + fine } else { value },
            uncertainty: limit.uncertainty + if is_clear { change } else { fine.abs() },
            added: Some(fine),
            ..limit
        })
    }
}
