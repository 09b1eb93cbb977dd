//! The diagonal bound of the contact stiffness.

use crate::common::{Field, STIFFNESS, forces, glass_pair, interface, ragged, rigid, sphere};
use fem_contact::{ContactInterface, Surface};
use fem_mesh::Side;
use nalgebra::DMatrix;

/// Largest eigenvalue of D^−1/2 K D^−1/2, K the contact stiffness of the points that `u` closes
/// and D the bound. Forces are linear while none opens or closes.
fn largest_quotient(interface: &ContactInterface, u: &[Field; 2]) -> f64 {
    let mut bound = Vec::new();
    let mut freedoms = Vec::new();
    for side in 0..2 {
        let mut of_side = vec![0.0; u[side].len()];
        if u[side].len() > 1 {
            interface.add_stiffness_bound(side, &mut of_side);
        }
        for (node, d) in of_side.into_iter().enumerate().filter(|(_, d)| *d > 0.0) {
            freedoms.push((side, node));
            bound.push(d);
        }
    }
    let (before, f) = forces(interface, u);
    let step = 1e-9;
    let mut matrix = DMatrix::zeros(bound.len(), bound.len());
    for (j, &(side, node)) in freedoms.iter().enumerate() {
        let mut moved = u.clone();
        moved[side][node][1] += step;
        let (after, g) = forces(interface, &moved);
        assert_eq!(after.n_closed, before.n_closed);
        for (i, &(side, node)) in freedoms.iter().enumerate() {
            matrix[(i, j)] = (f[side][node][1] - g[side][node][1]) / step;
        }
    }
    let asymmetry = (&matrix - matrix.transpose()).amax() / matrix.amax();
    // Differences of forces: 1e-16 · displacement / step.
    assert!(asymmetry < 1e-10, "{asymmetry:e}");
    let scaled = DMatrix::from_fn(bound.len(), bound.len(), |i, j| {
        0.5 * (matrix[(i, j)] + matrix[(j, i)]) / (bound[i] * bound[j]).sqrt()
    });
    scaled.symmetric_eigenvalues().max()
}

/// The bound takes the springs four times (for opening and closing within a few steps). Without that it is
/// sharp: a row of |K| sums to the bound, so the quotient of all springs closed is 1/4, and that
/// of any other pattern is less.
#[test]
fn bound_is_never_below_the_penalty_springs() {
    for sizes in [[50e-6, 50e-6], [50e-6, 37e-6], [25e-6, 300e-6]] {
        let meshes = glass_pair(sizes);
        let interface = interface(&meshes, 0.4e-3);
        let closed = [rigid(&meshes[0], 50e-6), rigid(&meshes[1], 0.0)];
        let all = largest_quotient(&interface, &closed);
        let some = largest_quotient(&interface, &ragged(&meshes, 20e-6));
        // Forces are differenced: 1e-16 · displacement / step.
        assert!((all - 0.25).abs() < 1e-10, "{sizes:?}: {all}");
        assert!(some < all && some > 0.15, "{sizes:?}: {some}");
    }
}

#[test]
fn bound_against_a_wall_counts_one_spring() {
    let mesh = sphere(7.95e-3, 50e-6, 0.5e-3, Side::Above);
    let interface =
        ContactInterface::new(Surface::wall(), Surface::of_sphere(&mesh), STIFFNESS, 0.0, 0.4e-3)
            .unwrap();
    let quotient = largest_quotient(&interface, &[vec![[0.0; 2]], rigid(&mesh, -50e-6)]);
    // As above.
    assert!((quotient - 0.25).abs() < 1e-10, "{quotient}");
}
