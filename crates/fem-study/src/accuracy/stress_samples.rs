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
        let near = elements_near(stress.mesh, MAX_DISTANCE_OVER_RADIUS * contact_radius);
        for depth in DEPTHS {
            for radius in RADII {
                let r = radius * contact_radius;
                let place = [r, surface_depth(stress.mesh, r)? + depth * contact_radius];
                let (nodes, weights) = interpolation(stress.mesh, &near, place)?;
                let values = nodes.map(|node| stress.field.points[node][1]);
                all.push(values.iter().zip(weights).map(|(value, w)| value * w).sum());
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

/// Returns the elements within a radius of the pole.
fn elements_near(mesh: &SphereMesh, radius: f64) -> Vec<usize> {
    let is_near = |element: &usize| {
        let corners = mesh.corners(*element);
        corners.iter().any(|[r, y]| r.hypot(*y) <= radius)
    };
    (0..mesh.quads().len()).filter(is_near).collect()
}

/// Returns the nodes of the element that contains a place, given by (r, depth below the pole), and their
/// weights, which add up to 1.
fn interpolation(
    mesh: &SphereMesh,
    near: &[usize],
    [r, depth]: [f64; 2],
) -> Option<([usize; 4], [f64; 4])> {
    near.iter().find_map(|&element| {
        let corners = mesh.corners(element).map(|[r, y]| [r, y.abs()]);
        let [x, y] = natural_coordinates(corners, [r, depth])?;
        let weights = [
            0.25 * (1.0 - x) * (1.0 - y),
            0.25 * (1.0 + x) * (1.0 - y),
            0.25 * (1.0 + x) * (1.0 + y),
            0.25 * (1.0 - x) * (1.0 + y),
        ];
        Some((mesh.quads()[element].map(|node| node as usize), weights))
    })
}

/// Returns the natural coordinates, each from −1 to 1, of a place in a quadrilateral by Newton's method; `None`
/// outside of it.
fn natural_coordinates(corners: [[f64; 2]; 4], place: [f64; 2]) -> Option<[f64; 2]> {
    const N_STEPS: usize = 12;
    /// Neighbours share an edge: no place on it may be lost by rounding.
    const EDGE: f64 = 1.0 + 1e-9;
    for k in [0, 1] {
        let of = |pick: fn(f64, f64) -> f64| corners.iter().map(|c| c[k]).reduce(pick);
        let (low, high) = (of(f64::min)?, of(f64::max)?);
        let slack = 1e-9 * (high - low);
        if !(low - slack..=high + slack).contains(&place[k]) {
            return None;
        }
    }
    let component = |k: usize, x: f64, y: f64| {
        let [a, b, c, d] = corners.map(|corner| corner[k]);
        let value = 0.25
            * (a * (1.0 - x) * (1.0 - y)
                + b * (1.0 + x) * (1.0 - y)
                + c * (1.0 + x) * (1.0 + y)
                + d * (1.0 - x) * (1.0 + y));
        let by_x = 0.25 * ((b - a) * (1.0 - y) + (c - d) * (1.0 + y));
        let by_y = 0.25 * ((d - a) * (1.0 - x) + (c - b) * (1.0 + x));
        (value - place[k], by_x, by_y)
    };
    let (mut x, mut y) = (0.0, 0.0);
    for _ in 0..N_STEPS {
        let (f, f_x, f_y) = component(0, x, y);
        let (g, g_x, g_y) = component(1, x, y);
        let determinant = f_x * g_y - f_y * g_x;
        x -= (f * g_y - g * f_y) / determinant;
        y -= (g * f_x - f * g_x) / determinant;
    }
    (x.abs() <= EDGE && y.abs() <= EDGE).then_some([x, y])
}
