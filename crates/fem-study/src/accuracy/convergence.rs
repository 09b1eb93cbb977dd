//! The limit of a sequence of results on finer and finer meshes, estimated from its own levels.
//!
//! The limit is that of a [`PowerLaw`] through the finest levels where one rules over them; else the finest
//! level stands for it. The order follows from the differences of the levels to the finest, (h_f, q_f),
//! whose own error is not known:
//!
//! ```math
//! \ln|q-q_f| = \ln C + \ln(h^p-h_f^p)
//! ```
//!
//! by least squares through the levels that differ from it by more than twice what is known of the limit, and its
//! uncertainty is the standard error of p (of a fit that is not linear: Draper and Smith 1998, 24.2).

use fem_laws::bisection::last_where;

use super::power_law::PowerLaw;

/// Orders that a sequence is believed to have.
const ORDERS: std::ops::Range<f64> = 0.5..3.9;
/// Largest distance of the limit beyond the finest level, as a multiple of the last step.
const FARTHEST: f64 = 2.0;
/// Levels that a limit is made of.
const N_LEVELS: usize = 6;
/// Errors below this multiple of the limit's uncertainty are not used for the order.
const CLEAR: f64 = 2.0;
/// Errors that are less than this over the limit are rounding.
const ROUNDING: f64 = 1e-6;
/// Orders that are tried, and of that range what a slope is taken over.
const TRIED: (f64, f64) = (0.1, 8.0);
const SLOPE: f64 = 1e-5;
/// Number of levels from which an order is estimated.
const FEWEST: usize = 3;
/// A slope with a larger standard error is none.
const LOOSEST: f64 = 0.75;
/// Relative uncertainty of the remaining distance to the limit.
const LEFT: f64 = 0.2;

/// The limit of a sequence of levels (h, q), h in any unit and q in its own.
///
/// ```
/// use fem_study::accuracy::Convergence;
///
/// let levels = [4.0, 2.8, 2.0, 1.4].map(|h: f64| (h, 0.9 + 0.01 * h * h));
/// let found = Convergence::of(&levels).expect("levels");
/// assert!((found.limit - 0.9).abs() < found.uncertainty && found.is_extrapolated);
/// // Two levels tell of no order.
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

/// |q − q₀| = C hᵖ, as levels show it.
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
            Some(law) => (law.limit, law.uncertainty.max(LEFT * (law.limit - finest).abs())),
            None => (finest, step),
        };
        let is_extrapolated = law.is_some();
        let order = ObservedOrder::of(&levels, uncertainty);
        Some(Self { limit, uncertainty, is_extrapolated, order })
    }
}

impl ObservedOrder {
    /// Estimates the limit of levels, the finest first.
    fn of(levels: &[(f64, f64)], uncertainty: f64) -> Option<Self> {
        let [(finest, of_finest), others @ ..] = levels else { return None };
        let least = (CLEAR * uncertainty).max(ROUNDING * of_finest.abs());
        let differences = others.iter().map(|(h, q)| (h / finest, (q - of_finest).abs()));
        let points: Vec<(f64, f64)> =
            differences.filter(|(_, difference)| *difference > least).collect();
        if points.len() < FEWEST {
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
        let (from, to) = TRIED;
        let order = last_where(from, to, |p| {
            let step = (to - from) * SLOPE;
            spread(&residual(p + step)) < spread(&residual(p - step))
        });
        let slope = |x: f64, _: f64| x.powf(order) * x.ln() / (x.powf(order) - 1.0);
        let squares = spread(&residual(order));
        let standard_error = (squares / (n - 2.0) / spread(&slope)).sqrt();
        let factor = mean(&residual(order)).exp() / finest.powf(order);
        let is_seen = ORDERS.contains(&order) && standard_error < LOOSEST;
        is_seen.then_some(Self { order, standard_error, factor })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without order there is no extrapolation, and with one level no certainty.
    #[test]
    fn what_does_not_converge_is_not_extrapolated() {
        let noise = [(4.0, 1.0), (3.0, 1.2), (2.0, 0.9), (1.5, 1.15), (1.0, 1.05)];
        let found = Convergence::of(&noise).unwrap();
        assert_eq!((found.limit, found.is_extrapolated, found.order), (1.05, false, None));
        assert!((found.uncertainty - 0.1).abs() < 1e-12);
        assert_eq!(Convergence::of(&noise[..1]).unwrap().uncertainty, f64::INFINITY);
        assert_eq!(Convergence::of(&[]), None);
    }

    #[test]
    fn the_order_is_the_slope() {
        for order in [1.0, 2.0, 3.0] {
            let level = |h: f64| (h, 6.0 - 0.1 * h.powf(order));
            let levels = [4.0, 2.8, 2.0, 1.4, 1.0, 0.7].map(level);
            let seen = Convergence::of(&levels).unwrap().order.unwrap();
            assert!((seen.order - order).abs() < 1e-3, "{seen:?}");
            assert!((seen.factor - 0.1).abs() < 1e-3 && seen.standard_error < 1e-3, "{seen:?}");
        }
    }
}
