//! Measures of revolved curves and caps, and the masses that follow from them.

use std::f64::consts::PI;

use crate::sphere_mesh::SphereMesh;

/// Returns the shares of the two ends of a straight segment in the area that it sweeps
/// about the axis, ∫ N 2π r ds with linear N, in m².
///
/// Exact: 2π l (2 r_i + r_j) / 6. The shares sum to the lateral area of the
/// cone, and they are the loads at the nodes under unit pressure.
pub fn segment_measures(start: [f64; 2], end: [f64; 2]) -> [f64; 2] {
    let length = (end[0] - start[0]).hypot(end[1] - start[1]);
    let share = PI * length / 3.0;
    [share * (2.0 * start[0] + end[0]), share * (start[0] + 2.0 * end[0])]
}

/// Returns the volume of a sphere, m³.
pub fn sphere_volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

/// Returns the volume between an arc of the circle of the given radius and its chord,
/// swept about the axis, in m³. Both ends lie on the circle, the centre on the
/// axis.
///
/// With the chord's half angle φ and the distance r̄ of the segment's centroid
/// from the axis, Pappus gives V = 2π r̄ A, where A = R² (φ − sin φ cos φ) and
/// the centroid lies at (2/3) R³ sin³φ / A from the centre, in the direction of
/// the arc's middle. Hence V = (4π/3) R³ sin³φ · cos(latitude of the middle).
pub fn cap_volume(start: [f64; 2], end: [f64; 2], radius: f64) -> f64 {
    let [dr, dy] = [end[0] - start[0], end[1] - start[1]];
    let chord = dr.hypot(dy);
    let sin_half_angle = (chord / (2.0 * radius)).min(1.0);
    // The middle's direction is the chord's normal; its radial part is |dy| / chord.
    let radial = if chord > 0.0 { dy.abs() / chord } else { 0.0 };
    4.0 / 3.0 * PI * (radius * sin_half_angle).powi(3) * radial
}

/// Returns the lumped masses of a homogeneous body, kg. The mass between a sphere's boundary and its
/// chords is added to the boundary's nodes, so that the sum is ρπD³/6 exactly.
///
/// `nodal_volumes` are the shares ∫ N 2πr dA of each element's corners, m³.
pub fn lump_mass(mesh: &SphereMesh, density: f64, nodal_volumes: &[[f64; 4]]) -> Vec<f64> {
    let mut mass = vec![0.0; mesh.nodes().len()];
    for (quad, volumes) in mesh.quads().iter().zip(nodal_volumes) {
        for (&node, volume) in quad.iter().zip(volumes) {
            mass[node as usize] += density * volume;
        }
    }
    if mesh.is_half_space() {
        return mass;
    }
    for segment in mesh.surface().windows(2) {
        let [start, end] = [segment[0], segment[1]].map(|node| mesh.nodes()[node as usize]);
        let half = 0.5 * density * cap_volume(start, end, mesh.radius());
        mass[segment[0] as usize] += half;
        mass[segment[1] as usize] += half;
    }
    mass
}
