//! The kernels against assembled element matrices, and against each other.

use fem_mesh::{Side, SphereMesh};

use super::*;
use crate::test_support::{
    assembled, assert_balance, geometries, moduli, ragged, unit_glass, unit_sphere, vector,
};

fn meshes() -> [SphereMesh; 3] {
    // All of 24 elements where they may be, most of 96 and of 1,200 in rows; numbers that leave lanes empty.
    [4.0, 8.0, 30.0].map(|n| unit_sphere(n, if n < 8.0 { Side::Above } else { Side::Below }))
}

fn pack(mesh: &SphereMesh) -> PackedElements {
    PackedElements::pack(mesh.nodes().len(), mesh.quads(), &geometries(mesh))
}

/// Largest difference over the largest number.
fn difference(a: &Field, b: &nalgebra::DVector<f64>) -> f64 {
    (vector(a) - b).amax() / b.amax()
}

#[test]
fn forces_and_energy_are_those_of_the_assembled_matrices() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let (u, w) = (ragged(&mesh, 0), ragged(&mesh, 1));
        let mut f = vec![[0.0; 2]; u.len()];
        subtract_internal_forces(&blocks, moduli, &u, &mut f);
        // Rounding of sums over four elements of eight terms.
        let matrix = assembled(&mesh, moduli);
        assert!(difference(&f, &(-&matrix * vector(&u))) < 1e-14);
        let energy = 0.5 * vector(&u).dot(&(matrix * vector(&u)));
        assert!((strain_energy(&blocks, moduli, &u) / energy - 1.0).abs() < 1e-14);

        let bulk = assembled(&mesh, Moduli { shear: 0.0, ..moduli });
        let shear = assembled(&mesh, Moduli { bulk: 0.0, ..moduli });
        let mut f = vec![[0.0; 2]; u.len()];
        subtract_split_internal_forces(&blocks, moduli, &u, &w, &mut f);
        assert!(difference(&f, &-(bulk * vector(&u) + shear * vector(&w))) < 1e-14);
    }
}

/// A rigid translation gives exactly no force. Axial momentum: the forces of any displacement sum to zero.
#[test]
fn small_strain_internal_forces_balance() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let forces = |u: &Field| {
            let mut f = vec![[0.0; 2]; u.len()];
            subtract_internal_forces(&blocks, moduli, u, &mut f);
            f
        };
        let u = vec![[0.0, 1.234_567e3]; mesh.nodes().len()];
        assert!(forces(&u).iter().flatten().all(|f| *f == 0.0));
        assert_eq!(strain_energy(&blocks, moduli, &u), 0.0);
        assert_balance(&forces(&ragged(&mesh, 5)));
    }
}

#[test]
#[should_panic(expected = "field_lengths")]
fn a_field_that_is_too_short_is_refused() {
    let mesh = unit_sphere(4.0, Side::Above);
    let (blocks, n) = (pack(&mesh), mesh.nodes().len());
    let (u, mut f) = (vec![[0.0; 2]; n], vec![[0.0; 2]; n - 1]);
    subtract_internal_forces(&blocks, moduli(&unit_glass()), &u, &mut f);
}
