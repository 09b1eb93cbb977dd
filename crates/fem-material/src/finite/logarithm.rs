//! The logarithm from additions, multiplications and divisions: the same bits on every machine, on one
//! number or on lanes.
//!
//! ```math
//! \ln(1+d) = k \ln 2 + 2\,\mathrm{artanh}\,t, \qquad 2\,\mathrm{artanh}\,t = 2t + t\,R(t^2), \qquad
//! t = \frac{m - 1}{m + 1}, \quad m = 2^{-k}(1 + d)
//! ```
//!
//! with k so that √½ ≤ m ≤ √2, hence t² ≤ 0.0295, where R is 2t²/3 + 2t⁴/5 + … to 2^(−58) (FreeBSD,
//! msun/src/e_log.c, by Sun Microsystems).

use std::f64::consts::LN_2;

use super::number::Number;

/// Coefficients of t², t⁴, … in R.
const SERIES: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// Returns ln(1 + d) for d > −1, exact to a few units in the last place also for small d. It is undefined elsewhere.
#[inline(always)]
pub(super) fn ln_of_one_plus<N: Number>(d: N) -> N {
    let (one, two) = (N::splat(1.0), N::splat(2.0));
    let x = one + d;
    let (power, inverse) = x.power_of_two();
    // What 1 + d lost of d.
    let lost = d - (x - one);
    let change = (x * inverse - one).plus_product(lost, inverse);
    let t = change / (two + change);
    (t + t).plus_product(t, remainder(t * t)).plus_product(power, N::splat(LN_2))
}

/// Largest t² of the series: that of a number of 2.
const SERIES_BOUND: f64 = 0.029_437_251_522_859_42;

/// Returns artanh(y)/y for 0 ≤ y² < 1, exact to a few units in the last place; it is undefined elsewhere.
///
/// The series serves while the larger of two numbers that y² = ((a − b)/(a + b))² compares is twice the
/// other at most.
#[inline(always)]
pub(super) fn artanh_over_root<N: Number>(square: N) -> N {
    let (one, two) = (N::splat(1.0), N::splat(2.0));
    let series = one.plus_product(N::splat(0.5), remainder(square));
    if square.all_within(SERIES_BOUND) {
        return series;
    }
    let y = square.sqrt();
    let twice = ln_of_one_plus((y + y) / (one - y));
    square.choose_within(SERIES_BOUND, series, twice / (two * y))
}

/// Returns R, as a sum of two independent halves.
#[inline(always)]
fn remainder<N: Number>(z: N) -> N {
    let [c_1, c_2, c_3, c_4, c_5, c_6, c_7] = SERIES;
    let w = z * z;
    let even = N::splat(c_4).plus_product(w, N::splat(c_6));
    let even = w * N::splat(c_2).plus_product(w, even);
    let odd = N::splat(c_5).plus_product(w, N::splat(c_7));
    let odd = N::splat(c_1).plus_product(w, N::splat(c_3).plus_product(w, odd));
    even.plus_product(z, odd)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On both sides of where the series ends, and near the ends of what is asked for.
    #[test]
    fn artanh_is_right_to_some_units_of_its_last_digit() {
        for k in 0..=4000 {
            let y = 1.0 - 10f64.powf(-0.003 * f64::from(k));
            let exact = if y < 1e-5 { 1.0 + y * y / 3.0 } else { y.atanh() / y };
            let found = artanh_over_root(y * y);
            // Near 1 what the square of y has lost counts as much as 1/(1 − y²).
            let tolerance = 8.0 * f64::EPSILON / (1.0 - y * y).min(1.0);
            assert!((found / exact - 1.0).abs() < tolerance, "{y}: {found} {exact}");
        }
        assert_eq!(artanh_over_root(0.0), 1.0);
    }

    /// Against the library of the machine that runs the test, which is right to a unit.
    #[test]
    fn logarithms_are_right_to_some_units_of_their_last_digit() {
        for k in 1..=4000 {
            let size = 10f64.powf(-12.0 + 0.005 * f64::from(k));
            for d in [size, -size / (1.0 + size)] {
                let (found, exact) = (ln_of_one_plus(d), d.ln_1p());
                assert!((found / exact - 1.0).abs() < 4.0 * f64::EPSILON, "{d}: {found} {exact}");
            }
        }
        assert_eq!(ln_of_one_plus(0.0), 0.0);
    }
}
