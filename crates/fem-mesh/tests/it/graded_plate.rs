//! The graded plate: geometry, grading, volume, refusals.

use std::f64::consts::PI;

use fem_mesh::{GradedPlate, MeshError, Quality, Side};

use crate::meshed_volume;

fn plate(thickness: f64) -> GradedPlate {
    GradedPlate {
        thickness,
        radius: 0.06_f64.max(1.6 * thickness),
        has_held_rim: true,
        is_bonded: false,
        contact_element_size: 30e-6,
        refined_radius: 0.3e-3,
        growth: None,
        ring_width: 2e-3,
        edge: None,
    }
}

const THICKNESSES: [f64; 5] = [0.8e-3, 2e-3, 5e-3, 30e-3, 1.0];

#[test]
fn boundaries_lie_on_the_axis_the_faces_and_the_rim() {
    for thickness in THICKNESSES {
        for side in [Side::Above, Side::Below] {
            let description = plate(thickness);
            let mesh = description.build().unwrap().on_side(side);
            assert_eq!(mesh.side(), side);
            let at = |node: u32| mesh.nodes()[node as usize];
            assert!(mesh.axis().iter().all(|&node| at(node)[0] == 0.0));
            assert!(mesh.surface().iter().all(|&node| at(node)[1] == 0.0));
            assert!(mesh.surface().is_sorted_by_key(|&node| at(node)[0]));
            let corner = at(*mesh.axis().last().unwrap());
            assert_eq!(corner[1].abs(), thickness);
            // Rounding of exp and ln.
            let is_rim = |node: u32| (at(node)[0] / description.radius - 1.0).abs() < 1e-12;
            assert!(mesh.far_boundary().iter().all(|&node| is_rim(node)));
            let nodes = || 0..mesh.nodes().len() as u32;
            assert_eq!(nodes().filter(|&node| is_rim(node)).count(), mesh.far_boundary().len());
            assert!(nodes().all(|node| at(node)[0] >= 0.0 && at(node)[1].abs() <= thickness));
            assert!((mesh.far_radius().unwrap() / description.radius - 1.0).abs() < 1e-12);
            assert!(mesh.is_half_space());
        }
    }
}

#[test]
fn bonded_plates_hold_their_far_face_and_free_ones_nothing() {
    let bonded = GradedPlate { is_bonded: true, ..plate(5e-3) }.build().unwrap();
    let at = |node: u32| bonded.nodes()[node as usize];
    let (face, rim): (Vec<u32>, Vec<u32>) =
        bonded.far_boundary().iter().partition(|&&node| at(node)[1] == 5e-3);
    assert_eq!(face[0], *bonded.axis().last().unwrap());
    assert_eq!(rim.len(), 20);
    let n_face = bonded.nodes().iter().filter(|node| node[1] == 5e-3).count();
    assert_eq!(n_face, face.len());
    let free = GradedPlate { has_held_rim: false, ..plate(5e-3) }.build().unwrap();
    assert!(free.far_boundary().is_empty() && free.far_radius().is_none());
    let pad = GradedPlate { has_held_rim: false, is_bonded: true, ..plate(5e-3) };
    assert!(pad.build().unwrap().far_radius().is_none());
}

/// Cells grow from the contact without losing their shape; rings beyond the thickness may be wide.
#[test]
fn cells_keep_their_shape() {
    for thickness in THICKNESSES {
        let description = plate(thickness);
        let mesh = description.build().unwrap();
        assert_eq!(mesh.quads().len(), description.n_elements().unwrap());
        let quality = Quality::of(&mesh);
        // At the corner of axis and far face the right angle is shared by two cells: sin 45° = 0.71, less the curvature.
        assert!(quality.min_scaled_jacobian > 0.4, "{thickness} {quality:?}");
        let r = |k: usize| mesh.nodes()[mesh.surface()[k] as usize][0];
        for k in 0..10 {
            let size = (r(k + 1) - r(k)) / 30e-6;
            assert!((0.85..1.0 + 1e-9).contains(&size), "{thickness} {k} {size}");
        }
        let widest = mesh.surface().windows(2).map(|two| {
            let [a, b] = [two[0], two[1]].map(|node| mesh.nodes()[node as usize][0]);
            b - a
        });
        // Up to the thickness cells have their own size.
        let limit = if thickness > 5e-3 { f64::INFINITY } else { 2e-3 * (1.0 + 1e-9) };
        assert!(widest.fold(0.0, f64::max) < limit, "{thickness}");
    }
}

#[test]
fn quads_fill_the_plate() {
    for thickness in THICKNESSES {
        let description = plate(thickness);
        let mesh = description.build().unwrap();
        let volume = meshed_volume(&mesh);
        let expected = PI * description.radius.powi(2) * thickness;
        assert!((volume / expected - 1.0).abs() < 1e-9, "{thickness}: {}", volume / expected);
    }
}

/// The number of elements grows with the logarithm of the thickness and with the radius over the ring width.
#[test]
fn a_plate_has_few_elements() {
    let counts = THICKNESSES[..4].iter().map(|&thickness| plate(thickness).n_elements().unwrap());
    assert!(counts.clone().all(|n| n < 3_000), "{:?}", counts.collect::<Vec<_>>());
}

#[test]
fn impossible_plates_are_refused() {
    let refused = |plate: GradedPlate| plate.build().unwrap_err();
    assert!(matches!(refused(plate(0.7e-3)), MeshError::ThinPlate { .. }));
    let narrow = GradedPlate { radius: 7e-3, ..plate(5e-3) };
    assert!(matches!(refused(narrow), MeshError::NarrowPlate { .. }));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = refused(GradedPlate { thickness: bad, ..plate(1.0) });
        assert!(matches!(found, MeshError::Length { .. }), "{found}");
        let found = refused(GradedPlate { ring_width: bad, ..plate(1.0) });
        assert!(matches!(found, MeshError::Length { .. }), "{found}");
    }
    let fine = GradedPlate { ring_width: 1e-13, ..plate(5e-3) };
    assert!(matches!(refused(fine), MeshError::TooLarge(_)));
}
