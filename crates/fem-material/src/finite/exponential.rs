//! The exponential from additions, multiplications and divisions: the same bits on every machine, on one number or on
//! lanes.
//!
//! ```math
//! e^x - 1 = \left(1 + a\right)^{32} - 1, \quad a = e^{x/32} - 1, \qquad
//! e^S = e^m \left[\cosh\rho\; 1 + \frac{\sinh\rho}{\rho} (S - m 1)\right]
//! ```
//!
//! with Taylor's series of a, and for a symmetric tensor S of the plane with the mean m of its eigenvalues m ± ρ.

use super::number::Number;
use super::tensor::SymmetricTensor;

/// Number of times that the argument is halved.
const N_HALVINGS: i32 = 5;

/// Returns eˣ − 1 for |x| ≤ 8 to 1e-13 of its value, and to some units in the last place for |x| ≤ 4.
#[inline(always)]
pub(super) fn exp_less_one<N: Number>(x: N) -> N {
    let (one, two) = (N::splat(1.0), N::splat(2.0));
    let small = x * N::splat(0.5f64.powi(N_HALVINGS));
    let mut series = one;
    for order in (2..=10).rev() {
        series = one.plus_product(small * N::splat(1.0 / f64::from(order)), series);
    }
    let mut a = small * series;
    for _ in 0..N_HALVINGS {
        a = a * (two + a);
    }
    a
}

/// Returns e^S − 1 of a symmetric tensor whose eigenvalues in the meridian differ by at most 2, to 1e-12.
#[inline(always)]
pub(super) fn exp_less_one_of<N: Number>(s: &SymmetricTensor<N>) -> SymmetricTensor<N> {
    let (one, half) = (N::splat(1.0), N::splat(0.5));
    let (mean, difference) = (half * (s.rr + s.yy), half * (s.rr - s.yy));
    let square = (difference * difference).plus_product(s.ry, s.ry);
    let (cosh_less_one, sinh_over_root) = hyperbolic_of_square(square);
    let scale_less_one = exp_less_one(mean);
    let scale = one + scale_less_one;
    let common = scale_less_one.plus_product(scale, cosh_less_one);
    let factor = scale * sinh_over_root;
    SymmetricTensor {
        rr: common.plus_product(factor, difference),
        yy: common.minus_product(factor, difference),
        tt: exp_less_one(s.tt),
        ry: factor * s.ry,
    }
}

/// Returns cosh ρ − 1 and sinh ρ/ρ of ρ², by their series.
#[inline(always)]
fn hyperbolic_of_square<N: Number>(square: N) -> (N, N) {
    let one = N::splat(1.0);
    let (mut cosh, mut sinh) = (one, one);
    for order in (2..=8).rev() {
        let pair = f64::from(2 * order);
        cosh = one.plus_product(square * N::splat(1.0 / (pair * (pair - 1.0))), cosh);
        sinh = one.plus_product(square * N::splat(1.0 / ((pair - 1.0) * (pair - 2.0))), sinh);
    }
    (N::splat(0.5) * square * cosh, sinh)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the library of the machine that runs the test.
    #[test]
    fn exponentials_are_right_to_some_units_of_their_last_digit() {
        for k in 0..=2000 {
            let size = 10f64.powf(-12.0 + 0.0063 * f64::from(k));
            for x in [size, -size] {
                let (found, exact) = (exp_less_one(x), x.exp_m1());
                // Every doubling rounds once more.
                let tolerance = if size <= 4.0 { 32.0 * f64::EPSILON } else { 1e-13 };
                assert!(
                    size > 4.2 || (found / exact - 1.0).abs() < tolerance,
                    "{x}: {found} {exact}"
                );
            }
        }
        assert_eq!(exp_less_one(0.0), 0.0);
    }

    /// Against the eigenvalues.
    #[test]
    fn the_exponential_of_a_tensor_has_its_eigenvalues() {
        for rho in [0.0, 1e-9, 0.01, 0.3, 1.0f64] {
            for mean in [-0.4, 1e-6, 0.2f64] {
                let angle = 0.3f64;
                let (c, s) = ((2.0 * angle).cos(), (2.0 * angle).sin());
                let tensor = SymmetricTensor {
                    rr: mean + rho * c,
                    yy: mean - rho * c,
                    tt: mean,
                    ry: rho * s,
                };
                let e = exp_less_one_of(&tensor);
                let (first, second) = ((mean + rho).exp_m1(), (mean - rho).exp_m1());
                let (sum, difference) = (0.5 * (first + second), 0.5 * (first - second));
                let exact =
                    [sum + difference * c, sum - difference * c, mean.exp_m1(), difference * s];
                for (found, exact) in [e.rr, e.yy, e.tt, e.ry].into_iter().zip(exact) {
                    assert!((found - exact).abs() < 1e-12 * (mean.abs() + rho), "{tensor:?}");
                }
            }
        }
    }
}
