//! The kernels against assembled element matrices, and against each other.

use fem_mesh::{Side, SphereMesh};

use super::*;
use crate::test_support::{assembled, geometries, moduli, ragged, unit_glass, unit_sphere, vector};

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
fn forces_are_those_of_the_assembled_matrices() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let (u, w) = (ragged(&mesh, 0), ragged(&mesh, 1));
        let mut f = vec![[0.0; 2]; u.len()];
        subtract_internal_forces(&blocks, moduli, &u, &mut f);
        // Rounding of sums over four elements of eight terms.
        assert!(difference(&f, &(-assembled(&mesh, moduli) * vector(&u))) < 1e-14);

        let bulk = assembled(&mesh, Moduli { shear: 0.0, ..moduli });
        let shear = assembled(&mesh, Moduli { bulk: 0.0, ..moduli });
        let mut f = vec![[0.0; 2]; u.len()];
        subtract_split_internal_forces(&blocks, moduli, &u, &w, &mut f);
        assert!(difference(&f, &-(bulk * vector(&u) + shear * vector(&w))) < 1e-14);
    }
}

#[test]
fn energy_is_half_of_displacement_times_force() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let u = ragged(&mesh, 3);
        let matrix = assembled(&mesh, moduli);
        let exact = 0.5 * vector(&u).dot(&(matrix * vector(&u)));
        // Rounding.
        assert!((strain_energy(&blocks, moduli, &u) / exact - 1.0).abs() < 1e-14);
    }
}

#[test]
fn small_strain_rigid_translation_gives_exactly_no_force() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let u = vec![[0.0, 1.234_567e3]; mesh.nodes().len()];
        let mut f = vec![[0.0; 2]; u.len()];
        subtract_internal_forces(&blocks, moduli, &u, &mut f);
        assert!(f.iter().flatten().all(|f| *f == 0.0));
        assert_eq!(strain_energy(&blocks, moduli, &u), 0.0);
    }
}

/// Axial momentum: the forces of any displacement sum to zero.
#[test]
fn small_strain_internal_forces_balance() {
    let moduli = moduli(&unit_glass());
    for mesh in meshes() {
        let blocks = pack(&mesh);
        let mut f = vec![[0.0; 2]; mesh.nodes().len()];
        subtract_internal_forces(&blocks, moduli, &ragged(&mesh, 5), &mut f);
        let (sum, size) =
            f.iter().fold((0.0, 0.0), |(sum, size), f| (sum + f[1], size + f[1].abs()));
        // Rounding of a hundred terms.
        assert!(f64::abs(sum) < 1e-15 * size, "{sum:e} {size}");
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
