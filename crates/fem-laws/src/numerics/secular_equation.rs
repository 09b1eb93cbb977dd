//! Zeros of a sum of simple poles, and the slopes there.
//!
//! ```math
//! f(x) = f_\infty + \sum_k \frac{w_k}{x-d_k}, \qquad w_k > 0, \quad d_1 < d_2 < \dots,
//! \quad f_\infty \le 0
//! ```
//!
//! falls from +∞ to −∞ between neighbouring poles, so exactly one zero lies between each two, and
//! one beyond the last if f∞ < 0. This is the secular equation of a diagonal matrix plus one of
//! rank one; as in LAPACK's `dlaed4`, each zero is sought as its distance from the nearer pole,
//! which keeps f and its slope accurate to rounding however close to the pole the zero lies.

use crate::numerics::bisection::falling_zero;

/// The pole w/(x−d).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pole {
    /// Position d of the pole.
    pub at: f64,
    /// w > 0.
    pub weight: f64,
}

/// One zero of f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Zero {
    /// Position x of the zero.
    pub at: f64,
    /// −f′(x) = Σ w_k/(x−d_k)².
    pub slope: f64,
}

/// Poles closer than this, relatively, are one at their centre of weight, which moves f by the square of
/// it. A pair left apart costs digits as the inverse of its distance: at 1e-6 the sum of weights of a
/// series has an error of 2e-12.
const SAME_POLE: f64 = 1e-7;

/// Ratio of the ends of the interval in which a zero is sought.
const GROWTH: f64 = 4.0;

/// Returns sorted poles with non-zero weights, coinciding poles as one.
pub(crate) fn merged(mut poles: Vec<Pole>) -> Vec<Pole> {
    poles.retain(|pole| pole.weight > 0.0);
    poles.sort_by(|a, b| a.at.total_cmp(&b.at));
    let mut distinct: Vec<Pole> = Vec::with_capacity(poles.len());
    for pole in poles {
        match distinct.last_mut() {
            Some(last) if pole.at - last.at <= SAME_POLE * pole.at => {
                let weight = last.weight + pole.weight;
                last.at += (pole.at - last.at) * (pole.weight / weight);
                last.weight = weight;
            }
            _ => distinct.push(pole),
        }
    }
    distinct
}

/// Returns all zeros, ascending, of f with merged poles.
pub(crate) fn zeros(at_infinity: f64, poles: &[Pole]) -> Vec<Zero> {
    let between = (1..poles.len()).map(|right| zero_between(at_infinity, poles, right));
    let beyond = poles.last().filter(|_| at_infinity < 0.0).map(|last| {
        let total: f64 = poles.iter().map(|pole| pole.weight).sum();
        zero_near(at_infinity, poles, last.at, 1.0, total / -at_infinity)
    });
    between.chain(beyond).collect()
}

/// Returns the zero between the poles `right − 1` and `right`.
fn zero_between(at_infinity: f64, poles: &[Pole], right: usize) -> Zero {
    let (left, right) = (poles[right - 1].at, poles[right].at);
    let half_gap = 0.5 * (right - left);
    if value(at_infinity, poles, left, half_gap) > 0.0 {
        zero_near(at_infinity, poles, right, -1.0, half_gap)
    } else {
        zero_near(at_infinity, poles, left, 1.0, half_gap)
    }
}

/// Returns the zero at most `reach` from the pole at `origin`, on the side of the sign.
///
/// With the distance x from that pole, x f has no pole there, and is w at it. The secant method starts around the zero of its
/// tangent there if that is a bracket, so that the result has full relative accuracy however close to the pole it lies.
fn zero_near(at_infinity: f64, poles: &[Pole], origin: f64, side: f64, reach: f64) -> Zero {
    let without_pole = |distance: f64| {
        let term = |pole: &Pole| match pole.at == origin {
            true => side * pole.weight,
            false => pole.weight * distance / ((origin - pole.at) + side * distance),
        };
        side * (at_infinity * distance + poles.iter().map(term).sum::<f64>())
    };
    let weight = without_pole(0.0);
    let step = (0.5 * reach).min(reach * weight / (weight - without_pole(reach)).abs());
    let mut low = 0.0;
    let mut high = step;
    while high < reach && without_pole(high) > 0.0 {
        (low, high) = (high, (GROWTH * high).min(reach));
    }
    while low == 0.0 && high > f64::MIN_POSITIVE {
        match without_pole(high / GROWTH) > 0.0 {
            true => low = high / GROWTH,
            false => high /= GROWTH,
        }
    }
    let offset = side * falling_zero(low, high, without_pole);
    let slope = poles
        .iter()
        .map(|pole| {
            let distance = (origin - pole.at) + offset;
            pole.weight / distance / distance
        })
        .sum();
    Zero { at: origin + offset, slope }
}

/// Returns f at `origin + offset`.
fn value(at_infinity: f64, poles: &[Pole], origin: f64, offset: f64) -> f64 {
    let sum: f64 = poles.iter().map(|pole| pole.weight / ((origin - pole.at) + offset)).sum();
    at_infinity + sum
}
