//! Convergence of a sequence of results: its limit, its order, and the uncertainty of both.
//!
//! ```math
//! q(h) = q_0 + C\,h^p
//! ```
//!
//! with h the size of an element, the length of a step or a tolerance, in any unit, and q any result.
//! [`PowerLaw`] fits q₀, C and p by least squares, every level with the same weight. It assumes that one power
//! rules over all levels: a sequence that has not begun to converge, or whose levels scatter, shows in
//! [`PowerLaw::uncertainty`] and in an order at the end of the range.
//!
//! [`Convergence`] takes the limit of a power law through the finest levels, or the finest level if no
//! power law fits. The [`ObservedOrder`] follows from the differences of the levels to the finest, (h_f, q_f), whose
//! own error is not known:
//!
//! ```math
//! \ln|q-q_f| = \ln C + \ln(h^p-h_f^p)
//! ```
//!
//! by least squares through the levels that differ from it by more than twice the uncertainty of the limit. Its
//! uncertainty is the standard error of p in a nonlinear fit (Draper and Smith 1998, 24.2).
//!
//! The [`Limit`] of a quantity of interest of a scene uses two models.
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

use fem_laws::bisection::last_where;

/// The limit of a sequence and its order of convergence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// The order p.
    pub order: f64,
    /// The limit q₀, in the unit of q.
    pub limit: f64,
    /// The factor C, in the unit of q over that of hᵖ.
    pub factor: f64,
    /// Largest move of the limit when one of the levels is left out, in the unit of q.
    pub uncertainty: f64,
}

/// Orders among which that of a power law is searched.
const FITTED_ORDERS: (f64, f64) = (0.2, 4.0);
/// Golden-section steps: the order is found to 1e-9 of the range.
const N_STEPS: usize = 45;

impl PowerLaw {
    /// Returns the least-squares fit to levels (h, q) in any order, h > 0 and not all the same; `None` for
    /// fewer than four. If a q is not a number, limit and factor are not either.
    pub fn fit(levels: &[(f64, f64)]) -> Option<Self> {
        if levels.len() < 4 {
            return None;
        }
        let (order, limit, factor) = best(levels);
        let without = |k: usize| {
            let mut others = levels.to_vec();
            others.remove(k);
            (best(&others).1 - limit).abs()
        };
        let uncertainty = (0..levels.len()).map(without).fold(0.0, f64::max);
        Some(Self { order, limit, factor, uncertainty })
    }
}

/// Returns order, limit and factor with the least squares; for a given order limit and factor are linear.
fn best(levels: &[(f64, f64)]) -> (f64, f64, f64) {
    let squares = |order: f64| line(levels, order).2;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    // The minimum need not be the only one: start from the best of a scan.
    let n = 38;
    let (first, last) = FITTED_ORDERS;
    let scan = |k: usize| first + (last - first) * k as f64 / n as f64;
    let k = (0..=n).min_by(|a, b| squares(scan(*a)).total_cmp(&squares(scan(*b)))).unwrap_or(0);
    let (mut low, mut high) = (scan(k.saturating_sub(1)), scan((k + 1).min(n)));
    for _ in 0..N_STEPS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if squares(a) < squares(b) { high = b } else { low = a }
    }
    let order = 0.5 * (low + high);
    let (limit, factor, _) = line(levels, order);
    (order, limit, factor)
}

/// Returns q₀, C and the sum of squares for a given order.
fn line(levels: &[(f64, f64)], order: f64) -> (f64, f64, f64) {
    let n = levels.len() as f64;
    let x = |h: f64| h.powf(order);
    let mean_x = levels.iter().map(|(h, _)| x(*h)).sum::<f64>() / n;
    let mean_q = levels.iter().map(|(_, q)| q).sum::<f64>() / n;
    let (mut xx, mut xq) = (0.0, 0.0);
    for (h, q) in levels {
        xx += (x(*h) - mean_x).powi(2);
        xq += (x(*h) - mean_x) * (q - mean_q);
    }
    let factor = xq / xx;
    let limit = mean_q - factor * mean_x;
    let squares = levels.iter().map(|(h, q)| (q - limit - factor * x(*h)).powi(2)).sum();
    (limit, factor, squares)
}

/// Observed orders outside this range are taken as coincidence.
const ORDERS: std::ops::Range<f64> = 0.5..3.9;
/// Largest distance of the limit beyond the finest level, as a multiple of the last step.
const FARTHEST: f64 = 2.0;
/// Number of finest levels that the limit is extrapolated from.
const N_LEVELS: usize = 6;
/// Smallest error that is used for the order, as a multiple of the limit's uncertainty.
const CLEAR: f64 = 2.0;
/// Smaller relative errors are rounding.
const ROUNDING: f64 = 1e-6;
/// Range in which the observed order is searched, and the step of its derivative over that range.
const SEARCHED_ORDERS: (f64, f64) = (0.1, 8.0);
const DERIVATIVE_STEP: f64 = 1e-5;
/// Fewest levels in addition to the finest that determine an order.
const MIN_LEVELS: usize = 3;
/// Largest standard error of an order.
const MAX_STANDARD_ERROR: f64 = 0.75;
/// Relative uncertainty of the remaining distance to the limit.
const EXTRAPOLATION_UNCERTAINTY: f64 = 0.2;

/// The limit of a sequence of levels (h, q), h in any unit and q in its own.
///
/// ```
/// use fem_study::accuracy::Convergence;
///
/// let levels = [4.0, 2.8, 2.0, 1.4].map(|h: f64| (h, 0.9 + 0.01 * h * h));
/// let found = Convergence::of(&levels).expect("levels");
/// assert!((found.limit - 0.9).abs() < found.uncertainty && found.is_extrapolated);
/// // Two levels do not determine an order.
/// assert_eq!(Convergence::of(&levels[2..]).map(|found| found.order), Some(None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// The limit, in the unit of q.
    pub limit: f64,
    /// Uncertainty of the limit, in the unit of q; infinite for a single level.
    pub uncertainty: f64,
    /// Whether it is extrapolated; else the finest level stands for it.
    pub is_extrapolated: bool,
    /// The observed order; none where the levels scatter or are too few.
    pub order: Option<ObservedOrder>,
}

/// The observed order of convergence: |q − q₀| = C hᵖ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservedOrder {
    /// The order p.
    pub order: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// The factor C > 0, in the unit of q over that of hᵖ.
    pub factor: f64,
}

impl Convergence {
    /// Estimates the limit of levels (h, q) in any order, h > 0; `None` without any level.
    pub fn of(levels: &[(f64, f64)]) -> Option<Self> {
        let mut levels = levels.to_vec();
        levels.sort_by(|a, b| a.0.total_cmp(&b.0));
        let finest = levels.first()?.1;
        let Some(step) = levels.get(1).map(|(_, next)| (finest - next).abs()) else {
            return Some(Self {
                limit: finest,
                uncertainty: f64::INFINITY,
                is_extrapolated: false,
                order: None,
            });
        };
        let law = PowerLaw::fit(&levels[..levels.len().min(N_LEVELS)]);
        let is_sound = |law: &PowerLaw| {
            ORDERS.contains(&law.order) && (law.limit - finest).abs() <= FARTHEST * step
        };
        let law = law.filter(is_sound);
        let (limit, uncertainty) = match law {
            Some(law) => (
                law.limit,
                law.uncertainty.max(EXTRAPOLATION_UNCERTAINTY * (law.limit - finest).abs()),
            ),
            None => (finest, step),
        };
        let is_extrapolated = law.is_some();
        let order = ObservedOrder::of(&levels, uncertainty);
        Some(Self { limit, uncertainty, is_extrapolated, order })
    }
}

impl ObservedOrder {
    /// Estimates the order from levels, the finest first, and the uncertainty of their limit.
    fn of(levels: &[(f64, f64)], uncertainty: f64) -> Option<Self> {
        let [(finest, of_finest), others @ ..] = levels else { return None };
        let least = (CLEAR * uncertainty).max(ROUNDING * of_finest.abs());
        let differences = others.iter().map(|(h, q)| (h / finest, (q - of_finest).abs()));
        let points: Vec<(f64, f64)> =
            differences.filter(|(_, difference)| *difference > least).collect();
        if points.len() < MIN_LEVELS {
            return None;
        }
        let n = points.len() as f64;
        let mean =
            |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|(x, d)| of(*x, *d)).sum::<f64>() / n;
        let spread = |of: &dyn Fn(f64, f64) -> f64| {
            let middle = mean(of);
            points.iter().map(|(x, d)| (of(*x, *d) - middle).powi(2)).sum::<f64>()
        };
        let residual =
            |p: f64| move |x: f64, difference: f64| difference.ln() - (x.powf(p) - 1.0).ln();
        let (from, to) = SEARCHED_ORDERS;
        let order = last_where(from, to, |p| {
            let step = (to - from) * DERIVATIVE_STEP;
            spread(&residual(p + step)) < spread(&residual(p - step))
        });
        let slope = |x: f64, _: f64| x.powf(order) * x.ln() / (x.powf(order) - 1.0);
        let squares = spread(&residual(order));
        let standard_error = (squares / (n - 2.0) / spread(&slope)).sqrt();
        let factor = mean(&residual(order)).exp() / finest.powf(order);
        let is_seen = ORDERS.contains(&order) && standard_error < MAX_STANDARD_ERROR;
        is_seen.then_some(Self { order, standard_error, factor })
    }
}

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
