//! The kernels against assembled element matrices, and against each other.

use fem_mesh::{Side, SphereMesh};

use super::*;
use crate::part::NodalField;
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
fn a_rigid_translation_gives_exactly_no_force() {
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
fn internal_forces_balance() {
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

/// Forces of a field, of two fields, and energy, of the lanes that are asked for.
type Computed = (NodalField, NodalField, [f64; 2]);

/// On lanes of four and on lanes of rows.
fn on<L: Lanes, R: RowLanes>(elements: &PackedElements, u: &Field, w: &Field) -> Computed {
    let (PackedElements { rows, others }, moduli) = (elements, moduli(&unit_glass()));
    let (mut f, mut split) = (vec![[0.0; 2]; u.len()], vec![[0.0; 2]; u.len()]);
    let mut energy = [0.0; 2];
    let one = |field| (moduli, field, field);
    let (moduli, bulk_field, shear_field) = one(u);
    RowKernel::on::<R>(
        Forces::<_, false> { elements: rows, moduli, bulk_field, shear_field },
        &mut f,
    );
    LaneKernel::on::<L>(
        Forces::<_, false> { elements: others, moduli, bulk_field, shear_field },
        &mut f,
    );
    let shear_field = w;
    RowKernel::on::<R>(
        Forces::<_, true> { elements: rows, moduli, bulk_field, shear_field },
        &mut split,
    );
    LaneKernel::on::<L>(
        Forces::<_, true> { elements: others, moduli, bulk_field, shear_field },
        &mut split,
    );
    RowKernel::on::<R>(Energy { elements: rows, moduli, field: w }, &mut energy[0]);
    LaneKernel::on::<L>(Energy { elements: others, moduli, field: w }, &mut energy[1]);
    (f, split, energy)
}

#[cfg(target_arch = "x86_64")]
#[test]
fn all_lanes_give_the_same_bits() {
    use crate::lanes::{Avx2, Avx512, Plain, TwoRegisters, has_avx2, has_avx512};
    #[target_feature(enable = "avx2,fma")]
    fn on_avx2(elements: &PackedElements, u: &Field, w: &Field) -> Computed {
        on::<Avx2, TwoRegisters<Avx2>>(elements, u, w)
    }
    #[target_feature(enable = "avx512f")]
    fn on_avx512(elements: &PackedElements, u: &Field, w: &Field) -> Computed {
        on::<Avx2, Avx512>(elements, u, w)
    }
    for mesh in meshes() {
        let elements = pack(&mesh);
        let (u, w) = (ragged(&mesh, 0), ragged(&mesh, 1));
        let plain = on::<Plain, Plain<WIDE>>(&elements, &u, &w);
        if has_avx2() {
            // SAFETY: the processor has been asked.
            assert_eq!(plain, unsafe { on_avx2(&elements, &u, &w) });
        }
        if has_avx512() {
            // SAFETY: as above.
            assert_eq!(plain, unsafe { on_avx512(&elements, &u, &w) });
        }
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
