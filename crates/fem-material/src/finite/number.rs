//! What a law computes with: one number, or several side by side.
//!
//! A law that is written over [`Number`] runs on plain numbers and on the lanes of a vector unit,
//! to the same bits: additions, multiplications, divisions and one estimate from the bits of a
//! number, which IEEE 754 fixes, and no function of a mathematical library, which differ.

use std::ops::{Add, Div, Mul, Sub};

/// A number of double precision, or several of them.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The same number in all lanes.
    fn splat(value: f64) -> Self;

    /// [`inverse_cube_root_estimate`] of each lane.
    fn inverse_cube_root_estimate(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        inverse_cube_root_estimate(self)
    }
}

/// x^(−1/3) of a positive normal number to 3.5 %, from its bits.
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

/// x^(−1/3) of a positive normal number to two units of the last digit.
///
/// With e = 1 − x y³ the root is y (1 − e)^(−1/3) = y (1 + e/3 + 2e²/9 + 14e³/81 + 35e⁴/243 + …).
/// The estimate's |e| < 0.11 becomes 5e-6 by the series up to e⁴, and 1e-16 by that up to e².
#[inline(always)]
pub fn inverse_cube_root<N: Number>(x: N) -> N {
    let one = N::splat(1.0);
    let (c_1, c_2) = (N::splat(1.0 / 3.0), N::splat(2.0 / 9.0));
    let (c_3, c_4) = (N::splat(14.0 / 81.0), N::splat(35.0 / 243.0));
    let y = x.inverse_cube_root_estimate();
    let e = one - x * y * (y * y);
    let y = y + y * e * ((c_1 + e * c_2) + e * e * (c_3 + e * c_4));
    let e = one - x * y * (y * y);
    y + y * e * (c_1 + e * c_2)
}

/// J^(−1/3) − 1 of J − 1, to its own last digit also where J is near 1: one more step of Newton's,
/// for the difference.
#[inline(always)]
pub(super) fn inverse_cube_root_change<N: Number>(volume_change: N) -> N {
    let (one, three) = (N::splat(1.0), N::splat(3.0));
    let jacobian = one + volume_change;
    let z = inverse_cube_root(jacobian) - one;
    let cube = z * (three + three * z + z * z);
    z - (one + z) * (volume_change + jacobian * cube) * N::splat(1.0 / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

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
