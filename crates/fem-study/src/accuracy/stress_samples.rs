//! Stress around a contact, sampled at places that do not depend on the mesh.

use fem_collision::Snapshot;
use fem_mesh::SphereMesh;
use fem_simulation::Simulation;

/// Distances from the axis over the contact radius. They avoid the edge of the contact, where the stress is
/// not smooth.
const RADII: [f64; 7] = [0.0, 0.2, 0.4, 0.6, 0.8, 1.3, 1.7];
/// Depths below the surface over the contact radius.
const DEPTHS: [f64; 7] = [0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0];
/// All places are nearer to the pole than this multiple of the contact radius.
const MAX_DISTANCE_OVER_RADIUS: f64 = 6.0;

/// Returns σ_yy (Pa, tension positive) at each place around a contact of this radius (m) in each body that has
/// elements, interpolated between nodal stresses. Returns `None` without elements, or if a place is not in its body.
pub(super) fn axial_stresses(
    simulation: &Simulation,
    snapshot: &Snapshot,
    contact_radius: f64,
) -> Option<Vec<f64>> {
    let mut all = Vec::new();
    for side in [0, 1] {
        let Some(stress) = simulation.stress(snapshot, side) else { continue };
        let near = stress.elements_near(MAX_DISTANCE_OVER_RADIUS * contact_radius);
        for depth in DEPTHS {
            for radius in RADII {
                let r = radius * contact_radius;
                let place = [r, surface_depth(stress.mesh, r)? + depth * contact_radius];
                all.push(stress.interpolated(&near, place)?[1]);
            }
        }
    }
    (!all.is_empty()).then_some(all)
}

/// Returns the depth of a body's surface below its pole at a distance from the axis, m; `None` beyond the
/// body.
fn surface_depth(mesh: &SphereMesh, r: f64) -> Option<f64> {
    if mesh.is_half_space() {
        return Some(0.0);
    }
    let radius = mesh.radius();
    let depth = radius - (radius * radius - r * r).sqrt();
    depth.is_finite().then_some(depth)
}

/// Returns the root mean square difference of two samples over that of the second.
pub(super) fn relative_difference(sample: &[f64], reference: &[f64]) -> Option<f64> {
    if sample.len() != reference.len() {
        return None;
    }
    let difference: f64 = sample.iter().zip(reference).map(|(a, b)| (a - b).powi(2)).sum();
    let whole: f64 = reference.iter().map(|b| b * b).sum();
    Some((difference / whole).sqrt()).filter(|error| error.is_finite())
}
