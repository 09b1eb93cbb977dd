//! The graded quarter disc: geometry, grading, volume, refusals.

use std::f64::consts::PI;

use fem_mesh::{MeshError, Quality, QuarterDisc, Side};

use crate::meshed_volume;

fn block(far_radius: f64) -> QuarterDisc {
    QuarterDisc {
        far_radius,
        contact_element_size: 30e-6,
        refined_radius: 0.3e-3,
        growth: None,
        edge: None,
    }
}

#[test]
fn boundaries_lie_on_the_axis_the_plane_and_the_far_circle() {
    for side in [Side::Above, Side::Below] {
        let mesh = block(0.05).build().unwrap().on_side(side);
        assert_eq!(mesh.side(), side);
        let at = |node: u32| mesh.nodes()[node as usize];
        assert!(mesh.axis().iter().all(|&node| at(node)[0] == 0.0));
        assert!(mesh.surface().iter().all(|&node| at(node)[1] == 0.0));
        assert!(mesh.surface().is_sorted_by_key(|&node| at(node)[0]));
        let distance = |node: u32| at(node)[0].hypot(at(node)[1]);
        // Rounding of exp and ln.
        let is_far = |node: u32| (distance(node) / 0.05 - 1.0).abs() < 1e-13;
        assert!(mesh.far_boundary().iter().all(|&node| is_far(node)));
        let n_far = (0..mesh.nodes().len() as u32).filter(|&node| is_far(node)).count();
        assert_eq!(n_far, mesh.far_boundary().len());
        assert!((mesh.far_radius().unwrap() / 0.05 - 1.0).abs() < 1e-13);
        let ends = [mesh.axis(), mesh.surface()].map(|curve| *curve.last().unwrap());
        assert_eq!(ends, [mesh.far_boundary()[0], *mesh.far_boundary().last().unwrap()]);
        assert!(mesh.is_half_space());
    }
}

#[test]
fn element_quality_is_independent_of_the_far_radius() {
    for far_radius in [2e-3, 0.1, 1e3] {
        let disc = block(far_radius);
        let mesh = disc.build().unwrap();
        assert_eq!(mesh.quads().len(), disc.n_elements().unwrap());
        let quality = Quality::of(&mesh);
        // As in a sphere: sin 60° = 0.87 at best.
        assert!(quality.min_scaled_jacobian > 0.82, "{far_radius} {quality:?}");
        assert!(quality.max_aspect_ratio < 1.6, "{far_radius} {quality:?}");
        let r = |k: usize| mesh.nodes()[mesh.surface()[k] as usize][0];
        assert!((0..10).all(|k| ((r(k + 1) - r(k)) / 30e-6 - 1.0).abs() < 1e-12));
    }
}

/// Quads fill the half ball but for what the chords of the far boundary cut off, (π/4m)²/…:
/// second order in the angle of a cell.
#[test]
fn quads_fill_the_half_ball() {
    let missing = |size: f64| {
        let mesh = QuarterDisc { contact_element_size: size, ..block(0.01) }.build().unwrap();
        1.0 - meshed_volume(&mesh) / (2.0 / 3.0 * PI * 0.01_f64.powi(3))
    };
    let (coarse, fine) = (missing(30e-6), missing(15e-6));
    assert!(fine > 0.0 && (coarse / fine - 4.0).abs() < 0.1, "{coarse:e} {fine:e}");
}

#[test]
fn quarter_disc_rejects_impossible_parameters() {
    let refused = |disc: QuarterDisc| disc.build().unwrap_err();
    assert!(matches!(refused(block(0.5e-3)), MeshError::FarRadius { .. }));
    for far_radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(block(far_radius)), MeshError::Length { name: "far radius", .. }));
    }
    assert_eq!(refused(QuarterDisc { growth: Some(1.0), ..block(0.1) }), MeshError::Growth(1.0));
    let endless = QuarterDisc { contact_element_size: 1e-12, ..block(0.1) };
    assert!(matches!(refused(endless), MeshError::TooLarge(_)));
    let fault = refused(block(0.5e-3)).to_string();
    assert!(fault.contains("twice"), "{fault}");
}
