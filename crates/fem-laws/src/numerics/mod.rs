//! Numerical tools of the closed forms: zeros of functions, and functions with the same bits everywhere.

pub mod bisection;
pub(crate) mod functions;
pub(crate) mod runge_kutta;
pub(crate) mod secular_equation;

/// Places and weights of Gauss' quadrature with five points between −1 and 1, the middle one first.
const GAUSS: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Returns the integral of a smooth function between two places by Gauss' quadrature with five points.
pub(crate) fn gauss(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let [(_, centre), outer @ ..] = GAUSS;
    let pair = |(place, weight): (f64, f64)| {
        weight * (value(middle - half * place) + value(middle + half * place))
    };
    half * (centre * value(middle) + outer.into_iter().map(pair).sum::<f64>())
}

/// Returns the integral of a smooth function from 0 to 1 by the midpoint rule, which asks for neither end.
pub(crate) fn midpoint_sum(value: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 400;
    let width = f64::from(PANELS).recip();
    (0..PANELS).map(|k| value((f64::from(k) + 0.5) * width)).sum::<f64>() * width
}
