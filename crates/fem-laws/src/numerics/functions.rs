//! Elementary functions with the same bits on every machine.
//!
//! Libraries of different systems may differ in the last digit; that of a browser does. [`crate::Ting`]
//! chooses its steps by their error: there a last digit moves all steps that follow, and changes the
//! results by the error of the steps, about 1e-10, with waves 1e-6. Arithmetic and square roots are the same
//! everywhere.

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
