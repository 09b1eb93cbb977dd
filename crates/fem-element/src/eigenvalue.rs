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
