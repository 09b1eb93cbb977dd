//! How a sequence of results converges as what it is computed with grows finer.
//!
//! ```math
//! q(h) = q_0 + C\,h^p
//! ```
//!
//! with h the size of an element, the length of a step or a tolerance, in any unit, and q any result.
//! All three are fitted by least squares, every level with the same weight: for a given order p, q₀
//! and C are linear; p is searched between 0.2 and 4. Limits: one power must rule over all levels. A
//! sequence that has not begun to converge, or whose levels scatter, shows in
//! [`PowerLaw::uncertainty`] and in an order at the end of the range.

/// The limit of a sequence and its order of convergence.
///
/// ```
/// use fem_study::accuracy::PowerLaw;
///
/// let levels = [4.0, 2.8, 2.0, 1.4].map(|h: f64| (h, 0.9 + 0.01 * h * h));
/// let fit = PowerLaw::fit(&levels).expect("four levels");
/// assert!((fit.order - 2.0).abs() < 1e-4 && (fit.limit - 0.9).abs() < 1e-5);
/// assert!(fit.uncertainty < 1e-4);
/// ```
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

/// Orders that are tried.
const ORDERS: (f64, f64) = (0.2, 4.0);
/// Golden-section steps: the order is found to 1e-9 of the range.
const N_STEPS: usize = 45;

impl PowerLaw {
    /// The least-squares fit to levels (h, q) in any order, h > 0 and not all the same; `None` for
    /// fewer than four. With a q that is not a number, limit and factor are none.
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

/// Order, limit and factor with the least squares; for a given order limit and factor are linear.
fn best(levels: &[(f64, f64)]) -> (f64, f64, f64) {
    let squares = |order: f64| line(levels, order).2;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    // The minimum need not be the only one: start from the best of a scan.
    let n = 38;
    let scan = |k: usize| ORDERS.0 + (ORDERS.1 - ORDERS.0) * k as f64 / n as f64;
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

/// q₀, C and the sum of squares for a given order.
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn levels_come_in_any_order() {
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
}
