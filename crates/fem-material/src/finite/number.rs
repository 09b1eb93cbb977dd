//! Numbers of the laws: one number, or several on lanes.
//!
//! A law that is written over [`Number`] runs on plain numbers and on the lanes of vector units. It uses operations
//! that IEEE 754 defines: additions, multiplications, fused products, divisions, square roots and bit operations, but
//! no functions of a mathematical library, whose results differ. So all lanes give the same bits. Lanes round a
//! product and a sum once, plain numbers twice; the two agree to rounding.

use std::ops::{Add, Div, Mul, Sub};

/// One number of double precision, or several on lanes.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Returns a number with one value in all lanes.
    fn splat(value: f64) -> Self;

    /// Returns self + x y, of lanes rounded once.
    fn plus_product(self, x: Self, y: Self) -> Self;

    /// Returns self − x y, of lanes rounded once.
    fn minus_product(self, x: Self, y: Self) -> Self;

    /// Returns [`inverse_cube_root_estimate`] of each lane.
    fn inverse_cube_root_estimate(self) -> Self;

    /// Returns [`power_of_two`] of each lane.
    fn power_of_two(self) -> (Self, Self);

    /// Returns the square root of each lane.
    fn sqrt(self) -> Self;

    /// Returns whether every lane lies within ± a bound.
    fn all_within(self, bound: f64) -> bool;

    /// Returns `inside` in lanes that lie within ± a bound, `outside` in the others.
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn plus_product(self, x: Self, y: Self) -> Self {
        self + x * y
    }

    #[inline(always)]
    fn minus_product(self, x: Self, y: Self) -> Self {
        self - x * y
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        inverse_cube_root_estimate(self)
    }

    #[inline(always)]
    fn power_of_two(self) -> (Self, Self) {
        power_of_two(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn all_within(self, bound: f64) -> bool {
        self.abs() <= bound
    }

    #[inline(always)]
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
        if self.abs() <= bound { inside } else { outside }
    }
}

/// Returns 1/x and 1/y by one division, which costs as much as a dozen products.
#[inline(always)]
pub(super) fn inverses<N: Number>(x: N, y: N) -> (N, N) {
    let both = N::splat(1.0) / (x * y);
    (both * y, both * x)
}

/// Difference of the bits of 1 and √½. Added to the bits of a number, it makes the exponent change at √½ and √2.
pub const POWER_OFFSET: u64 = 1f64.to_bits() - std::f64::consts::FRAC_1_SQRT_2.to_bits();
/// Bits of 2⁵², whose last bits count units.
pub const UNITS: u64 = 0x4330_0000_0000_0000;
/// 2⁵² plus the offset of exponents.
pub const UNITS_AND_OFFSET: f64 = 4_503_599_627_370_496.0 + 1023.0;

/// Returns k and 2^(−k) for a positive normal number x, with x 2^(−k) between √½ and √2.
#[inline(always)]
pub fn power_of_two(x: f64) -> (f64, f64) {
    let exponent = x.to_bits().wrapping_add(POWER_OFFSET) >> 52;
    let power = f64::from_bits(exponent | UNITS) - UNITS_AND_OFFSET;
    (power, f64::from_bits(2046u64.wrapping_sub(exponent) << 52))
}

/// Estimates x^(−1/3) of a positive normal number to 3.5 % from its bits.
///
/// The upper half of a number's bits grows about as its logarithm, so that a third of it is taken
/// from a constant, the one whose errors up and down are the same. On lanes the upper half is a
/// shift by 32, and the third a product of 32-bit numbers with 0xAAAA_AAAB and a shift by 33.
#[inline(always)]
pub fn inverse_cube_root_estimate(x: f64) -> f64 {
    let upper = x.to_bits() >> 32;
    let third = (upper * 0xAAAA_AAAB) >> 33;
    f64::from_bits(0x553E_F0FFu64.wrapping_sub(third) << 32)
}

/// Returns x^(−1/3) of a positive normal number to two units in the last place.
///
/// With e = 1 − x y³ the root is y (1 − e)^(−1/3) = y (1 + e/3 + 2e²/9 + 14e³/81 + 35e⁴/243 + …).
/// The estimate's |e| < 0.11 becomes 5e-6 by the series up to e⁴, and 1e-16 by that up to e².
#[inline(always)]
pub fn inverse_cube_root<N: Number>(x: N) -> N {
    let one = N::splat(1.0);
    let (c_1, c_2) = (N::splat(1.0 / 3.0), N::splat(2.0 / 9.0));
    let (c_3, c_4) = (N::splat(14.0 / 81.0), N::splat(35.0 / 243.0));
    let y = x.inverse_cube_root_estimate();
    let e = one.minus_product(x * y, y * y);
    let series = c_1.plus_product(e, c_2).plus_product(e * e, c_3.plus_product(e, c_4));
    let y = y.plus_product(y * e, series);
    let e = one.minus_product(x * y, y * y);
    y.plus_product(y * e, c_1.plus_product(e, c_2))
}

/// Returns J^(−1/3) − 1 for J − 1, exact to its last place also for J near 1: one more step of Newton's method,
/// for the difference.
#[inline(always)]
pub(super) fn inverse_cube_root_change<N: Number>(volume_change: N) -> N {
    let (one, three) = (N::splat(1.0), N::splat(3.0));
    let jacobian = one + volume_change;
    let z = inverse_cube_root(jacobian) - one;
    let cube = z * three.plus_product(three + z, z);
    let error = volume_change.plus_product(jacobian, cube);
    z.minus_product((one + z) * N::splat(1.0 / 3.0), error)
}

/// Where the series takes the place of the root: its first term left out is 8e-20 of the result.
const SERIES_BOUND: f64 = 1e-3;

/// Returns J^(−1/3) − 1 for J − 1 by the binomial series where J is near 1, in a quarter of the time, and by the
/// root elsewhere.
#[inline(always)]
pub(super) fn inverse_cube_root_change_near_one<N: Number>(d: N) -> N {
    let (c_1, c_2) = (N::splat(-1.0 / 3.0), N::splat(2.0 / 9.0));
    let (c_3, c_4) = (N::splat(-14.0 / 81.0), N::splat(35.0 / 243.0));
    let (c_5, c_6) = (N::splat(-91.0 / 729.0), N::splat(728.0 / 6561.0));
    let square = d * d;
    let tail = c_3.plus_product(d, c_4).plus_product(square, c_5.plus_product(d, c_6));
    let series = d * c_1.plus_product(d, c_2).plus_product(square, tail);
    if d.all_within(SERIES_BOUND) {
        return series;
    }
    d.choose_within(SERIES_BOUND, series, inverse_cube_root_change(d))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ways, where they meet, and between.
    #[test]
    fn inverse_cube_root_change_is_exact_to_two_units_of_the_last_digit() {
        for size in [1e-12f64, 1e-6, 9.99e-4, 1.001e-3, 0.1, 0.6] {
            for d in [size, -size] {
                let exact = (-d.ln_1p() / 3.0).exp_m1();
                for found in [inverse_cube_root_change(d), inverse_cube_root_change_near_one(d)] {
                    assert!((found / exact - 1.0).abs() < 4.0 * f64::EPSILON, "{d}: {found}");
                }
            }
        }
        assert_eq!(inverse_cube_root_change_near_one(0.0), 0.0);
    }

    #[test]
    fn the_power_of_two_leaves_a_number_near_one() {
        use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
        for k in 0..20_000 {
            let x = 10f64.powf(-100.0 + 0.01 * f64::from(k));
            let (power, inverse) = power_of_two(x);
            assert_eq!(inverse, 2f64.powf(-power), "{x}");
            assert!((FRAC_1_SQRT_2..=SQRT_2).contains(&(x * inverse)), "{x}: {power}");
        }
        assert_eq!(power_of_two(1.0), (0.0, 1.0));
    }

    /// Three binades: the estimate repeats itself eight-fold.
    #[test]
    fn the_inverse_cube_root_is_right_to_two_units_of_the_last_digit() {
        for k in 0..300_000 {
            let x = 0.5 * (1.0 + f64::from(k) * 1e-5 * 7.0 / 3.0);
            for x in [x, x * 2f64.powi(-60), x * 2f64.powi(60)] {
                let exact = 1.0 / x.cbrt();
                assert!((x.inverse_cube_root_estimate() / exact - 1.0).abs() < 0.035, "{x}");
                assert!((inverse_cube_root(x) / exact - 1.0).abs() < 2.0 * f64::EPSILON, "{x}");
            }
        }
    }
}
