//! Elements together: patch test, rigid motion, eigenvalue bound.

use std::f64::consts::PI;

use crate::common::{BULK, KINDS, Kind, Patch, SHEAR, restricted};
use fem_element::{QuadGeometry, largest_eigenvalue};
use nalgebra::DMatrix;

fn stiffness(patch: &Patch, kind: Kind) -> DMatrix<f64> {
    patch.assemble(|corners| kind(corners).combine(BULK, SHEAR))
}

/// Strains (ε_r, ε_y) of u_r = ε_r r, u_y = ε_y y for the stresses σ_rr = σ_θθ and σ_yy.
fn strains(radial: f64, axial: f64) -> [f64; 2] {
    let nu = 0.244;
    [(1.0 - nu) * radial - nu * axial, axial - 2.0 * nu * radial]
}

/// The two uniform stress states that axial symmetry allows: inner nodes feel no force, and
/// find their places when only the boundary is held.
#[test]
fn uniform_stress_passes_the_patch_test() {
    for (name, kind) in KINDS {
        for (radial, axial) in [(0.0, 1.0), (1.0, 0.0)] {
            for r0 in [0.0, 0.7] {
                let patch = Patch::new(r0, 4);
                let matrix = stiffness(&patch, kind);
                let [e_r, e_y] = strains(radial, axial);
                let exact = patch.field(|[r, y]| [e_r * r, e_y * y]);
                let force = &matrix * &exact;
                let (inside, outside): (Vec<_>, Vec<_>) =
                    (0..exact.len()).partition(|&i| patch.is_inside(i / 2));
                // Forces are of the size of stress times area, 1 · 2π/4; rounding of 32 terms.
                let worst = force.select_rows(&inside).amax();
                assert!(worst < 2e-14, "{name}: force {worst:e}");

                let held = matrix.select_rows(&inside).select_columns(&outside);
                let right = -(held * exact.select_rows(&outside));
                let free = restricted(&matrix, &inside).cholesky().unwrap().solve(&right);
                // Rounding times the condition of 18 unknowns, about 20.
                let error = (free - exact.select_rows(&inside)).amax();
                assert!(error < 2e-14, "{name}: displacement {error:e}");
            }
        }
    }
}

/// Nodal forces at the boundary are the stress times ∫N 2πr ds, l(2r_i + r_j)/6 a side.
#[test]
fn boundary_forces_are_those_of_the_stress() {
    for (name, kind) in KINDS {
        let patch = Patch::new(0.0, 4);
        let [e_r, e_y] = strains(0.0, 1.0);
        let force = stiffness(&patch, kind) * patch.field(|[r, y]| [e_r * r, e_y * y]);
        let top: Vec<usize> = (0..=4).map(|i| i * 5 + 4).collect();
        let share = |i: usize, j: usize| {
            let (r, other) = (patch.nodes[i][0], patch.nodes[j][0]);
            PI / 3.0 * (r - other).abs() * (2.0 * r + other)
        };
        for k in 0..=4 {
            let mut area = 0.0;
            if k > 0 {
                area += share(top[k], top[k - 1]);
            }
            if k < 4 {
                area += share(top[k], top[k + 1]);
            }
            // Rounding of forces of size 1.
            assert!((force[2 * top[k] + 1] - area).abs() < 2e-14, "{name}: node {k}");
        }
    }
}

#[test]
fn axial_translation_strains_nothing_and_nothing_else_is_free() {
    for (name, kind) in KINDS {
        for r0 in [0.0, 0.7] {
            let patch = Patch::new(r0, 4);
            let matrix = stiffness(&patch, kind);
            // Rounding of stiffnesses of size 10.
            assert!((&matrix * patch.field(|_| [0.0, 1.0])).amax() < 1e-13, "{name}");
            let values = restricted(&matrix, &patch.free()).symmetric_eigenvalues();
            let largest = values.max();
            // Zero means rounding; the softest true mode is six orders above the limit.
            let n_zero = values.iter().filter(|&&v| v < 1e-10 * largest).count();
            assert!(values.min() > -1e-14 * largest, "{name}");
            assert_eq!(n_zero, 1, "{name}, r0 = {r0}");
        }
    }
}

/// Irons & Treharne: the largest eigenvalue of an element bounds the body's.
#[test]
fn largest_element_eigenvalue_bounds_the_assembled_one() {
    for (name, kind) in KINDS {
        for r0 in [0.0, 0.7] {
            let patch = Patch::new(r0, 4);
            let mut mass = vec![0.0; patch.nodes.len()];
            let mut bound: f64 = 0.0;
            for (e, quad) in patch.quads.iter().enumerate() {
                let corners = patch.corners(e);
                let masses = QuadGeometry::new(&corners).nodal_volumes;
                let on_axis = quad.map(|node| patch.on_axis(node));
                let matrix = kind(&corners).combine(BULK, SHEAR);
                bound = bound.max(largest_eigenvalue(&matrix, &masses, on_axis));
                for (&node, m) in quad.iter().zip(masses) {
                    mass[node] += m;
                }
            }
            let matrix = stiffness(&patch, kind);
            let scaled = DMatrix::from_fn(matrix.nrows(), matrix.nrows(), |i, j| {
                matrix[(i, j)] / (mass[i / 2] * mass[j / 2]).sqrt()
            });
            let exact = restricted(&scaled, &patch.free()).symmetric_eigenvalues().max();
            // Rounding of an eigenvalue solver below; above, 1.64 is measured on this distorted
            // patch, a factor of 1.3 in the time step.
            assert!(
                bound >= exact * (1.0 - 1e-12) && bound < 1.8 * exact,
                "{name} {bound} {exact}"
            );
        }
    }
}
