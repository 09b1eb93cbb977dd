//! Numerical tools of the closed forms: zeros of functions, integrals, and elementary functions with the same bits on every machine.
//!
//! Libraries of different systems may differ in the last digit; that of a browser does. [`crate::Ting`]
//! chooses its steps by their error: there a last digit moves all steps that follow, and changes the
//! results by the error of the steps, about 1e-10, with waves 1e-6. Arithmetic and square roots are the same
//! everywhere.

pub mod bisection;
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

/// Returns the exponential eˣ.
pub(crate) fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Returns eˣ − 1, also of a small x.
pub(crate) fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Returns ln x for x > 0.
pub(crate) fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Returns xʸ of x ≥ 0.
pub(crate) fn power(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// Returns sine and cosine of an angle in radians.
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each has an error below one unit in the last place.
    #[test]
    fn own_functions_agree_with_the_system_to_the_last_digit() {
        let same = |own: f64, system: f64| {
            assert!((own - system).abs() <= 2.0 * f64::EPSILON * system.abs(), "{own} {system}");
        };
        for k in -300..=300 {
            let x = 0.1 * f64::from(k);
            same(exp(x), x.exp());
            same(ln(1e-3 + x.abs()), (1e-3 + x.abs()).ln());
            same(exp_m1(1e-3 * x), (1e-3 * x).exp_m1());
            same(power(x.abs(), 0.4), x.abs().powf(0.4));
            same(sin_cos(x).0, x.sin());
            same(sin_cos(x).1, x.cos());
        }
        assert_eq!((exp(-800.0), exp(0.0), power(0.0, 0.2)), (0.0, 1.0, 0.0));
    }

    /// The system's library usually rounds this one to the nearest, one digit lower: it is not asked.
    #[test]
    fn exp_does_not_call_the_system_library() {
        assert_eq!(exp(1.0), std::f64::consts::E + 2.0 * f64::EPSILON);
    }
}
