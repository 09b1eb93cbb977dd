//! Meshes from outside, in one program: linked once, its tests run side by side.

mod graded_plate;
mod half_disc;
mod import;
mod quarter_disc;

use std::f64::consts::PI;

use fem_mesh::SphereMesh;

/// Returns the volume of the straight-sided quads by the shoelace form of ∫ 2π r dA.
fn meshed_volume(mesh: &SphereMesh) -> f64 {
    let of_side = |corners: [[f64; 2]; 4], a: usize| {
        let ([r0, y0], [r1, y1]) = (corners[a], corners[(a + 1) % 4]);
        PI / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1) * (y1 - y0)
    };
    let elements = (0..mesh.quads().len()).map(|element| mesh.corners(element));
    elements.map(|corners| (0..4).map(|a| of_side(corners, a)).sum::<f64>()).sum()
}
