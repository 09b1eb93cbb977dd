//! Largest eigenvalue of an element.
//!
//! Householder's reflections leave a tridiagonal matrix, whose characteristic polynomial
//!
//! ```math
//! p_k(x) = (x - d_k)\, p_{k-1}(x) - e_{k-1}^2\, p_{k-2}(x), \qquad p_0 = 1,
//! ```
//!
//! has only real roots. From above, Laguerre's method converges monotonically to the largest root (Wilkinson 1965,
//! chapter 7). Four or five steps are sufficient, in a quarter of the time for all eigenvalues.

use nalgebra::SVector;

use crate::stiffness::ElementMatrix;

/// Degrees of freedom of an element.
const N: usize = 8;
/// Upper limit on the number of steps. A double root takes about thirty, because each step leaves three fifths of the
/// error.
const MAX_STEPS: usize = 60;
/// Relative size below which a step is rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Returns the largest λ of K x = λ M x with M the lumped corner masses (kg), in 1/s².
///
/// Degrees of freedom of zero mass are left out, and so are the radial ones of
/// corners on the axis, which do not move; `on_axis` marks those.
///
/// By the theorem of Irons and Treharne (1971) the largest of these over all
/// elements bounds the assembled body's.
pub fn largest_eigenvalue(stiffness: &ElementMatrix, masses: &[f64; 4], on_axis: [bool; 4]) -> f64 {
    let scale: [f64; N] = std::array::from_fn(|i| {
        let corner = i / 2;
        let fixed = i % 2 == 0 && on_axis[corner];
        if fixed || masses[corner] <= 0.0 { 0.0 } else { masses[corner].sqrt().recip() }
    });
    let scaled = ElementMatrix::from_fn(|i, j| stiffness[(i, j)] * scale[i] * scale[j]);
    // The matrix is zero or not finite. Otherwise squares do not overflow.
    let size = scaled.amax();
    if !(size > 0.0 && size.is_finite()) {
        return size;
    }
    let (diagonal, beside) = (scaled / size).symmetric_tridiagonalize().unpack_tridiagonal();
    size * largest_of_tridiagonal(&diagonal, &beside)
}

/// Returns the largest eigenvalue of a symmetric tridiagonal matrix.
fn largest_of_tridiagonal(diagonal: &SVector<f64, N>, beside: &SVector<f64, { N - 1 }>) -> f64 {
    // Gershgorin's circles end below this.
    let reach = |k: usize| {
        let of = |k: usize| beside.get(k).map_or(0.0, |entry| entry.abs());
        diagonal[k].abs() + of(k) + if k > 0 { of(k - 1) } else { 0.0 }
    };
    let bound = (0..N).map(reach).fold(0.0, f64::max);
    let (diagonal, beside) = (diagonal / bound, beside / bound);
    let mut root = 1.0;
    for _ in 0..MAX_STEPS {
        let [p, slope, bend] = characteristic(&diagonal, &beside, root);
        // At the root, or below it by rounding.
        if p <= 0.0 {
            break;
        }
        let (g, n) = (slope / p, N as f64);
        let h = g * g - bend / p;
        let step = n / (g + ((n - 1.0) * (n * h - g * g)).max(0.0).sqrt());
        root -= step;
        if step <= ROUNDING * root {
            break;
        }
    }
    bound * root
}

/// Returns the characteristic polynomial of a tridiagonal matrix, its slope and its second derivative.
fn characteristic(
    diagonal: &SVector<f64, N>,
    beside: &SVector<f64, { N - 1 }>,
    x: f64,
) -> [f64; 3] {
    let (mut before, mut p) = ([0.0; 3], [1.0, 0.0, 0.0]);
    for k in 0..N {
        let (own, square) = (x - diagonal[k], if k > 0 { beside[k - 1].powi(2) } else { 0.0 });
        let next = [
            own * p[0] - square * before[0],
            p[0] + own * p[1] - square * before[1],
            2.0 * p[1] + own * p[2] - square * before[2],
        ];
        (before, p) = (p, next);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{QuadGeometry, mean_gradient};

    /// As all eigenvalues have it: of any element, with corners on the axis, without mass, and of a square,
    /// whose two directions are nearly alike.
    #[test]
    fn the_largest_of_all_eigenvalues() {
        let square = [[3.0, 0.0], [4.0, 0.0], [4.0, 1.0], [3.0, 1.0]];
        let wedge = [[0.0, 0.0], [1.0, 0.1], [0.9, 0.7], [0.0, 0.8]];
        let sliver = [[1e3, 0.0], [1001.0, 0.0], [1001.0, 0.05], [1000.0, 0.04]];
        for corners in [square, wedge, sliver] {
            let geometry = QuadGeometry::new(&corners);
            let on_axis = corners.map(|corner| corner[0] == 0.0);
            for shear in [1e-6, 0.5, 3.0] {
                let matrix = mean_gradient(&geometry).combine(1.0, shear);
                let mut masses = geometry.nodal_volumes;
                for _ in 0..2 {
                    let scaled = ElementMatrix::from_fn(|i, j| {
                        let of = |i: usize| match masses[i / 2] > 0.0
                            && !(i.is_multiple_of(2) && on_axis[i / 2])
                        {
                            true => masses[i / 2].sqrt().recip(),
                            false => 0.0,
                        };
                        matrix[(i, j)] * of(i) * of(j)
                    });
                    let all = scaled.symmetric_eigenvalues().max();
                    let largest = largest_eigenvalue(&matrix, &masses, on_axis);
                    // Rounding of eight reflections; where two roots lie together, its root.
                    assert!(
                        (largest / all - 1.0).abs() < 1e-13,
                        "{corners:?} {shear}: {largest} {all}"
                    );
                    masses[1] = 0.0;
                }
            }
        }
    }

    /// A double eigenvalue is accurate to the square root of machine precision; a zero matrix has the eigenvalue 0.
    #[test]
    fn largest_eigenvalue_handles_double_zero_and_huge_roots() {
        let diagonal = [2.0, 5.0, 5.0, 1.0, 0.0, 0.0, 0.5, 3.0];
        let of = |diagonal: [f64; 8]| {
            let matrix = ElementMatrix::from_diagonal(&SVector::from(diagonal));
            largest_eigenvalue(&matrix, &[1.0; 4], [false; 4])
        };
        assert!((of(diagonal) / 5.0 - 1.0).abs() < 1e-7, "{}", of(diagonal));
        assert_eq!(of([0.0; 8]), 0.0);
        // Squares of these numbers overflow.
        let huge = of([1e250; 8].map(|of_all| 0.5 * of_all)) / 0.5e250;
        assert!((huge - 1.0).abs() < 1e-2, "{huge}");
    }
}
