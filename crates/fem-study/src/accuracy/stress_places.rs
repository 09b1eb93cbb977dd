//! The stress around a contact, at places that do not depend on the mesh.

use fem_collision::Snapshot;
use fem_mesh::SphereMesh;

use fem_simulation::Simulation;

/// Distances from the axis over the contact radius: away from its edge, where no stress is smooth.
const RADII: [f64; 7] = [0.0, 0.2, 0.4, 0.6, 0.8, 1.3, 1.7];
/// Depths below the surface over the contact radius.
const DEPTHS: [f64; 7] = [0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0];

/// All places are nearer to the pole than so many contact radii.
const REACH: f64 = 6.0;

/// Places in both bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct StressPlaces {
    contact_radius: f64,
}

impl StressPlaces {
    /// Around a contact of this radius, m.
    pub fn around(contact_radius: f64) -> Self {
        Self { contact_radius }
    }

    /// σ_yy (Pa, tension positive) at each place of each body that has elements, of nodal stresses
    /// interpolated; none without elements, or where a place is not in its body.
    pub fn sample(&self, simulation: &Simulation, snapshot: &Snapshot) -> Option<Vec<f64>> {
        let mut all = Vec::new();
        for side in [0, 1] {
            let Some(stress) = simulation.stress(snapshot, side) else { continue };
            let finder = Finder::new(stress.mesh, REACH * self.contact_radius);
            for depth in DEPTHS {
                for radius in RADII {
                    let r = radius * self.contact_radius;
                    let place = [r, sag(stress.mesh, r)? + depth * self.contact_radius];
                    let (nodes, weights) = finder.find(place)?;
                    let values = nodes.map(|node| stress.field.points[node][1]);
                    all.push(values.iter().zip(weights).map(|(value, w)| value * w).sum());
                }
            }
        }
        (!all.is_empty()).then_some(all)
    }
}

/// How deep below its pole the surface of a body lies at a distance from the axis, m; none beyond it.
fn sag(mesh: &SphereMesh, r: f64) -> Option<f64> {
    if mesh.is_half_space() {
        return Some(0.0);
    }
    let radius = mesh.radius();
    let depth = radius - (radius * radius - r * r).sqrt();
    depth.is_finite().then_some(depth)
}

/// Root mean square difference of two samples over that of the second.
pub(super) fn relative_difference(sample: &[f64], reference: &[f64]) -> Option<f64> {
    if sample.len() != reference.len() {
        return None;
    }
    let difference: f64 = sample.iter().zip(reference).map(|(a, b)| (a - b).powi(2)).sum();
    let whole: f64 = reference.iter().map(|b| b * b).sum();
    Some((difference / whole).sqrt()).filter(|error| error.is_finite())
}

/// Finds the element that a place is in, by (r, depth below the pole).
struct Finder<'m> {
    mesh: &'m SphereMesh,
    /// Elements near the pole.
    near: Vec<usize>,
}

impl<'m> Finder<'m> {
    fn new(mesh: &'m SphereMesh, radius: f64) -> Self {
        let is_near = |element: &usize| {
            let corners = mesh.corners(*element);
            corners.iter().any(|[r, y]| r.hypot(*y) <= radius)
        };
        Self { mesh, near: (0..mesh.quads().len()).filter(is_near).collect() }
    }

    /// Nodes of the element and their weights, which add up to 1.
    fn find(&self, [r, depth]: [f64; 2]) -> Option<([usize; 4], [f64; 4])> {
        self.near.iter().find_map(|&element| {
            let corners = self.mesh.corners(element).map(|[r, y]| [r, y.abs()]);
            let [x, y] = natural_coordinates(corners, [r, depth])?;
            let weights = [
                0.25 * (1.0 - x) * (1.0 - y),
                0.25 * (1.0 + x) * (1.0 - y),
                0.25 * (1.0 + x) * (1.0 + y),
                0.25 * (1.0 - x) * (1.0 + y),
            ];
            Some((self.mesh.quads()[element].map(|node| node as usize), weights))
        })
    }
}

/// Where in a quadrilateral a place is, each from −1 to 1, by Newton's method; none outside of it.
fn natural_coordinates(corners: [[f64; 2]; 4], place: [f64; 2]) -> Option<[f64; 2]> {
    const N_STEPS: usize = 12;
    /// Neighbours share an edge: rounding must not lose a place on it.
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

#[cfg(test)]
mod tests {
    use fem_mesh::HalfDisc;

    use super::*;

    /// Interpolation has what is linear in the place to rounding, all over the contact.
    #[test]
    fn what_is_linear_is_found_everywhere() {
        let mesh = HalfDisc {
            radius: 1.0,
            contact_element_size: 0.02,
            refined_radius: 0.12,
            growth: None,
        };
        let mesh = mesh.build().unwrap();
        let linear = |[r, y]: [f64; 2]| 3.0 * r - 2.0 * y.abs() + 0.5;
        let finder = Finder::new(&mesh, 0.3);
        for depth in DEPTHS {
            for radius in RADII {
                let place = [0.1 * radius, 0.1 * depth];
                let (nodes, weights) = finder.find(place).unwrap();
                let found: f64 =
                    nodes.iter().zip(weights).map(|(n, w)| w * linear(mesh.nodes()[*n])).sum();
                assert!((found - linear(place)).abs() < 1e-12, "{place:?} {found}");
            }
        }
        assert_eq!(finder.find([0.0, 2.1]), None);
    }

    #[test]
    fn a_difference_is_over_the_reference() {
        let off = relative_difference(&[1.1, 2.2], &[1.0, 2.0]).unwrap();
        assert!((off - 0.1).abs() < 1e-12);
        assert_eq!(relative_difference(&[1.0], &[1.0, 2.0]), None);
        assert_eq!(relative_difference(&[0.0], &[0.0]), None);
    }
}
