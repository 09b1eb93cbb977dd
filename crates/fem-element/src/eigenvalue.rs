//! Largest eigenvalue of an element.

use crate::stiffness::ElementMatrix;

/// Largest λ of K x = λ M x with M the lumped corner masses (kg), in 1/s².
///
/// Degrees of freedom of zero mass are left out, and so are the radial ones of
/// corners on the axis, which do not move; `on_axis` marks those.
///
/// By the theorem of Irons and Treharne (1971) the largest of these over all
/// elements bounds the assembled body's.
pub fn largest_eigenvalue(stiffness: &ElementMatrix, masses: &[f64; 4], on_axis: [bool; 4]) -> f64 {
    let scale: [f64; 8] = std::array::from_fn(|i| {
        let corner = i / 2;
        let fixed = i % 2 == 0 && on_axis[corner];
        if fixed || masses[corner] <= 0.0 { 0.0 } else { masses[corner].sqrt().recip() }
    });
    let scaled = ElementMatrix::from_fn(|i, j| stiffness[(i, j)] * scale[i] * scale[j]);
    scaled.symmetric_eigenvalues().max()
}
