//! The largest eigenvalue of an element.

use fem_element::{ElementMatrix, QuadGeometry, largest_eigenvalue, mean_gradient};
use nalgebra::SVector;

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
