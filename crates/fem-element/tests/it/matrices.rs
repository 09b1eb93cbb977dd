//! Matrices of single elements, and the two kinds against each other.

use crate::common::{BULK, DISTORTED, KINDS, SHEAR};
use fem_element::{ElementMatrix, QuadGeometry, b_bar, mean_gradient, mean_gradient_stiffness};
use nalgebra::SVector;

type Displacement = SVector<f64, 8>;

fn field(corners: &[[f64; 2]; 4], field: impl Fn([f64; 2]) -> [f64; 2]) -> Displacement {
    Displacement::from_fn(|i, _| field(corners[i / 2])[i % 2])
}

fn energy(matrix: &ElementMatrix, u: &Displacement) -> f64 {
    0.5 * u.dot(&(matrix * u))
}

/// The mean-gradient element sees four strains and two hourglass amplitudes. The motions without
/// strain are the axial translation and, away from the axis, the rolling of the
/// ring u_r = y − ȳ, u_y = −r, whose hoop strain vanishes in the mean. B-bar sees that too.
#[test]
fn matrices_are_symmetric_and_semidefinite_with_the_right_nullity() {
    for ((name, kind), nullity) in KINDS.into_iter().zip([2, 1]) {
        let parts = kind(&DISTORTED);
        for (matrix, nullity) in
            [(parts.combine(BULK, SHEAR), nullity), (parts.combine(1e6 * SHEAR, SHEAR), nullity)]
        {
            let size = matrix.amax();
            // Symmetric but for the order of summation; a semidefinite matrix's zeros are rounding.
            assert!((matrix - matrix.transpose()).amax() < 1e-15 * size, "{name}");
            let values = matrix.symmetric_eigenvalues();
            assert!(values.min() > -1e-14 * size, "{name} {values}");
            let n_zero = values.iter().filter(|&&v| v < 1e-12 * size).count();
            assert_eq!(n_zero, nullity, "{name} {values}");
        }
        let bulk = parts.bulk.symmetric_eigenvalues();
        assert_eq!(bulk.iter().filter(|&&v| v > 1e-12 * bulk.max()).count(), 1, "{name}");
    }
}

#[test]
fn mean_gradient_element_has_no_energy_in_ring_rolling() {
    let geometry = QuadGeometry::new(&DISTORTED);
    let hoop: f64 = geometry.hoop.iter().sum();
    let height = (0..4).map(|a| geometry.hoop[a] * DISTORTED[a][1]).sum::<f64>() / hoop;
    let roll = field(&DISTORTED, |[r, y]| [y - height, -r]);
    // Rounding against an energy of size 1; B-bar sees the hoop strain (y − ȳ)/r.
    assert!(energy(&mean_gradient(&geometry).combine(BULK, SHEAR), &roll).abs() < 1e-14);
    assert!(energy(&b_bar(&DISTORTED).combine(BULK, SHEAR), &roll) > 0.01);
}

/// ½ V (K e_v² + 2G e′:e′) for a uniform strain, with both kinds.
#[test]
fn linear_fields_have_the_energy_of_their_strain() {
    let volume = QuadGeometry::new(&DISTORTED).volume;
    for (name, kind) in KINDS {
        let matrix = kind(&DISTORTED).combine(BULK, SHEAR);
        let u = field(&DISTORTED, |[r, y]| [0.3 * r, 2.0 + 0.2 * r - 0.5 * y]);
        let (trace, square) = (0.1, 2.0 * 0.09 + 0.25);
        let density =
            0.5 * BULK * trace * trace + SHEAR * (square - trace * trace / 3.0 + 0.5 * 0.04);
        // Rounding of a rigid translation of 2.
        assert!((energy(&matrix, &u) / (volume * density) - 1.0).abs() < 1e-13, "{name}");
    }
}

#[test]
fn bulk_matrices_of_b_bar_and_mean_gradient_are_equal() {
    assert_eq!(b_bar(&DISTORTED).bulk, mean_gradient(&QuadGeometry::new(&DISTORTED)).bulk);
}

/// Energy of bending over B-bar's, less 1: worst of the hourglass patterns in r, in y and in both
/// at once, of a unit square, sheared by `skew`, whose centre lies at the radius.
fn bending_deviation(radius: f64, skew: f64) -> f64 {
    let corners = [[-0.5, -0.5], [0.5, -0.5 + skew], [0.5, 0.5 + skew], [-0.5, 0.5]]
        .map(|[r, y]| [r + radius, y]);
    let one_point = mean_gradient(&QuadGeometry::new(&corners)).combine(BULK, SHEAR);
    let full = b_bar(&corners).combine(BULK, SHEAR);
    // At the axis a radial pattern moves nodes that cannot move.
    let patterns: &[[f64; 2]] =
        if radius == 0.5 { &[[0.0, 1.0]] } else { &[[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] };
    patterns
        .iter()
        .map(|pattern| {
            let sign = [1.0, -1.0, 1.0, -1.0];
            let bend = Displacement::from_fn(|i, _| pattern[i % 2] * sign[i / 2]);
            (energy(&one_point, &bend) / energy(&full, &bend) - 1.0).abs()
        })
        .fold(0.0, f64::max)
}

/// The hourglass stiffness is that of B-bar but for the hoop strain φ/r, which it leaves out:
/// the difference is of the order (h/r)².
#[test]
fn hourglass_stiffness_approaches_b_bar_at_second_order() {
    // (h/r)²/20 on a rectangle.
    assert!(bending_deviation(1.0, 0.0) < 0.05);
    let order = (bending_deviation(4.0, 0.0) / bending_deviation(8.0, 0.0)).log2();
    assert!((1.9..2.1).contains(&order), "{order}");
    assert!(bending_deviation(8.0, 0.3) < 1e-3);
    // The axial pattern has no hoop strain: rounding, even at the axis.
    assert!(bending_deviation(0.5, 0.0) < 1e-13, "{}", bending_deviation(0.5, 0.0));
}

/// Both functions give the same stiffness matrix of a skew quad with a corner on the axis.
#[test]
fn the_lower_triangle_is_that_of_the_whole_matrix() {
    let geometry = QuadGeometry::new(&[[0.0, 0.1], [1.0, 0.0], [1.3, 0.9], [0.2, 1.1]]);
    let (bulk_modulus, shear_modulus) = (3.0, 1.7);
    let whole = mean_gradient(&geometry).combine(bulk_modulus, shear_modulus);
    let lower = mean_gradient_stiffness(&geometry, bulk_modulus, shear_modulus);
    let places = (0..8).flat_map(|i| (0..=i).map(move |j| (i, j)));
    for (place, value) in places.zip(lower) {
        // Rounding of some sums.
        assert!((value - whole[place]).abs() < 1e-14 * whole.amax(), "{place:?}");
    }
}
