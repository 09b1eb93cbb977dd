//! The error of the recovered stress near the contact, from a reference run.
//!
//! The stresses of both runs at the largest approach are compared at the nodes within [`ZONE`] contact radii of the pole:
//!
//! ```math
//! \mathrm{max} = f\,\frac{\max|\sigma - \sigma'|}{\max|\sigma'|}, \qquad
//! \mathrm{l2} = f\,\sqrt{\frac{\int|\sigma - \sigma'|^2\,\mathrm dV}{\int|\sigma'|^2\,\mathrm dV}}, \qquad
//! |\sigma|^2 = \sigma : \sigma .
//! ```
//!
//! The reference run has elements of another size, and f makes its difference the error of the run for a convergence of
//! first order: 2 for elements half as large, 1 for elements twice as large. Stresses of elastic, relaxing and soft bodies
//! converge with an order of 1.3 to 1.5, so the error is told 1.3 times as large as it is; of bodies that flow 2.6 times. Nodes of the surface within half
//! an element of the contact's edge are left out: the cusp of the stress there lies between two nodes on any mesh.

use fem_collision::{Collision, Snapshot};
use fem_mesh::SphereMesh;
use serde::Serialize;

use crate::simulation::Simulation;
use crate::simulation::stress::BodyStress;

/// Distance from the pole up to which stresses are compared, over the contact radius.
const ZONE: f64 = 3.0;
/// Share of the largest approach from which a snapshot shows it: the stress grows with the root of the approach.
const NEAR_LARGEST: f64 = 0.99;

/// Error of the recovered stress near the contact, relative to that of the reference run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StressError {
    /// Largest difference over the largest stress.
    pub max: f64,
    /// Root mean square of the difference over that of the stress.
    pub l2: f64,
}

/// The stress near the contact at the largest approach of a run.
#[derive(Clone, Debug)]
pub(super) struct ContactStress {
    sides: [Option<(SphereMesh, Vec<[f64; 4]>)>; 2],
    /// Contact radius, m.
    radius: f64,
}

impl ContactStress {
    /// Takes the stress of a run; `None` without a snapshot close to its largest approach.
    pub fn of(simulation: &Simulation, collision: &Collision) -> Option<Self> {
        let by_approach = |a: &&Snapshot, b: &&Snapshot| a.approach.total_cmp(&b.approach);
        let snapshot = collision.snapshots.iter().max_by(by_approach)?;
        if snapshot.approach < NEAR_LARGEST * collision.max_approach? {
            return None;
        }
        let radius = snapshot.contact.radius;
        let of_side = |side: usize| {
            let BodyStress { mesh, field } = simulation.stress(snapshot, side)?;
            Some((mesh.clone(), field.points))
        };
        (radius > 0.0).then(|| Self { sides: [0, 1].map(of_side), radius })
    }

    /// Returns the error against the stress of a reference run, whose elements have this size over those of the run.
    pub fn error(&self, reference: &Self, ratio: f64) -> Option<StressError> {
        let factor = (ratio - 1.0).abs().recip();
        let mut sums = Sums::default();
        for (own, other) in self.sides.iter().zip(&reference.sides) {
            if let (Some((mesh, points)), Some((coarse, values))) = (own, other) {
                let other = BodyStress { mesh: coarse, field: of_points(values) };
                sums.add(mesh, points, &other, self.radius);
            }
        }
        let [difference, whole] = sums.squares.map(f64::sqrt);
        let [most, largest] = sums.largest;
        let error = StressError { max: factor * most / largest, l2: factor * difference / whole };
        (error.max.is_finite() && error.l2.is_finite()).then_some(error)
    }
}

fn of_points(points: &[[f64; 4]]) -> fem_collision::StressField {
    fem_collision::StressField { cells: Vec::new(), points: points.to_vec() }
}

/// Squares of the difference and of the stress, integrated, and the largest of both, Pa.
#[derive(Default)]
struct Sums {
    squares: [f64; 2],
    largest: [f64; 2],
}

impl Sums {
    /// Adds the nodes of a body near a contact of this radius, m.
    fn add(&mut self, mesh: &SphereMesh, points: &[[f64; 4]], other: &BodyStress<'_>, radius: f64) {
        let near = other.elements_near(2.0 * ZONE * radius);
        let volumes = nodal_volumes(mesh);
        let size = mesh.surface().get(1).map_or(0.0, |&node| mesh.nodes()[node as usize][0]);
        let surface: Vec<bool> = {
            let mut is = vec![false; points.len()];
            mesh.surface().iter().for_each(|&node| is[node as usize] = true);
            is
        };
        for (node, place) in mesh.nodes().iter().enumerate() {
            let [r, y] = *place;
            let is_at_edge = surface[node] && (r - radius).abs() < 0.5 * size;
            if r.hypot(y) > ZONE * radius || is_at_edge {
                continue;
            }
            let Some(expected) = other.interpolated(&near, *place) else { continue };
            let difference: [f64; 4] = std::array::from_fn(|k| points[node][k] - expected[k]);
            for (k, square) in [square(difference), square(expected)].into_iter().enumerate() {
                self.squares[k] += volumes[node] * square;
                self.largest[k] = self.largest[k].max(square.sqrt());
            }
        }
    }
}

/// Returns the double contraction σ : σ of a stress.
fn square([rr, yy, tt, ry]: [f64; 4]) -> f64 {
    rr * rr + yy * yy + tt * tt + 2.0 * ry * ry
}

/// Returns a quarter of the volumes of the elements around each node over 2π, m³.
fn nodal_volumes(mesh: &SphereMesh) -> Vec<f64> {
    let mut volumes = vec![0.0; mesh.nodes().len()];
    for (element, quad) in mesh.quads().iter().enumerate() {
        let [a, b, c, d] = mesh.corners(element);
        let area = 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]));
        let radius = 0.25 * (a[0] + b[0] + c[0] + d[0]);
        quad.iter().for_each(|&node| volumes[node as usize] += 0.25 * radius * area);
    }
    volumes
}

#[cfg(test)]
mod tests {
    use fem_mesh::{HalfDisc, Side};

    use super::*;

    /// Two fields that differ by a tenth everywhere have this error times the factor, on meshes that differ.
    #[test]
    fn a_uniform_difference_is_its_own_error() {
        let mesh = |size: f64| {
            let disc = HalfDisc {
                radius: 1.0,
                contact_element_size: size,
                refined_radius: 0.2,
                growth: None,
                edge: None,
            };
            disc.build().unwrap().on_side(Side::Above)
        };
        let uniform = |size: f64, stress: f64| {
            let mesh = mesh(size);
            let points = vec![[stress, -stress, 0.0, stress]; mesh.nodes().len()];
            ContactStress { sides: [None, Some((mesh, points))], radius: 0.1 }
        };
        for (size, ratio) in [(0.01, 0.5), (0.04, 2.0f64)] {
            let error = uniform(0.02, 1.1).error(&uniform(size, 1.0), ratio).unwrap();
            let expected = 0.1 / (ratio - 1.0).abs();
            // Rounding of interpolations.
            assert!((error.max - expected).abs() < 1e-12, "{error:?}");
            assert!((error.l2 - expected).abs() < 1e-12, "{error:?}");
        }
    }
}
