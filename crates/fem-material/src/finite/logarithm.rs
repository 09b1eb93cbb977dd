//! Logarithms from additions, multiplications and divisions: the same bits on every machine.
//!
//! ```math
//! \ln(1+d) = 2\,\mathrm{artanh}\,\frac{d}{2+d}, \qquad
//! \mathrm{artanh}\, x = x \left(1 + \tfrac13 x^2 + \tfrac15 x^4 + \dots\right)
//! ```
//!
//! after a power of two is taken out, so that x² ≤ 0.0295.

use std::f64::consts::{LN_2, SQRT_2};

/// Of 1 + d between √½ and √2.
const LARGEST_SQUARE: f64 = 0.0295;

/// artanh(x)/x of x², x² ≤ 0.0295: the first term left out is 3e-19.
#[inline]
fn series(x_squared: f64) -> f64 {
    (1..=10).rev().fold(1.0 / 23.0, |sum, k| sum * x_squared + 1.0 / f64::from(2 * k + 1))
        * x_squared
        + 1.0
}

/// ln(1 + d) for d > −1, to some units of its own last digit also where d is small.
#[inline]
pub(super) fn ln_of_one_plus(d: f64) -> f64 {
    if (1.0 / SQRT_2 - 1.0..=SQRT_2 - 1.0).contains(&d) {
        let t = d / (2.0 + d);
        return 2.0 * t * series(t * t);
    }
    let x = 1.0 + d;
    // With the bits of √½ taken off, the exponent's field counts the powers of two.
    let offset = x.to_bits().wrapping_sub((1.0 / SQRT_2).to_bits());
    let power = (offset as i64) >> 52;
    let mantissa = f64::from_bits(x.to_bits().wrapping_sub((power << 52) as u64));
    let t = (mantissa - 1.0) / (mantissa + 1.0);
    power as f64 * LN_2 + 2.0 * t * series(t * t)
}

/// artanh(x)/x of x², 0 ≤ x² < 1.
#[inline]
pub(super) fn artanh_over(x_squared: f64) -> f64 {
    if x_squared <= LARGEST_SQUARE {
        return series(x_squared);
    }
    let x = x_squared.sqrt();
    0.5 * ln_of_one_plus(2.0 * x / (1.0 - x)) / x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the library of the machine that runs the test, which is right to a unit.
    #[test]
    fn logarithms_are_right_to_some_units_of_their_last_digit() {
        for k in 1..=4000 {
            let size = 10f64.powf(-12.0 + 0.005 * f64::from(k));
            for d in [size, -size / (1.0 + size)] {
                let (found, exact) = (ln_of_one_plus(d), d.ln_1p());
                assert!((found / exact - 1.0).abs() < 4.0 * f64::EPSILON, "{d}: {found} {exact}");
            }
            let x = size / (1.0 + size);
            if x < 0.999 {
                // 1 − x² rounds once more, which artanh feels 500-fold at the end.
                let (found, exact) = (artanh_over(x * x), x.atanh() / x);
                assert!((found / exact - 1.0).abs() < 1e-13, "{x}: {found} {exact}");
            }
        }
        assert_eq!((ln_of_one_plus(0.0), artanh_over(0.0)), (0.0, 1.0));
    }
}
