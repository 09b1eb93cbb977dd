//! The stress field of a body at an instant of its collision.

use fem_collision::{Snapshot, StressField};
use fem_mesh::SphereMesh;

use crate::simulation::Simulation;

/// The stress field of a body at an instant.
#[derive(Clone, Debug)]
pub struct BodyStress<'a> {
    /// The undeformed mesh.
    pub mesh: &'a SphereMesh,
    /// (σ_rr, σ_yy, σ_θθ, σ_ry) of nodes and elements, tension positive, Pa.
    pub field: StressField,
}

impl BodyStress<'_> {
    /// Returns depth below the contact pole (m) and stress of each node on the axis, from the contact to the far pole. On
    /// the axis σ_rr = σ_θθ and σ_ry = 0: the stresses are principal.
    pub fn on_axis(&self) -> impl Iterator<Item = (f64, [f64; 4])> {
        let nodes = self.mesh.axis().iter().map(|node| *node as usize);
        nodes.map(|node| (self.mesh.nodes()[node][1].abs(), self.field.points[node]))
    }

    /// Returns the elements within a radius (m) of the pole.
    pub fn elements_near(&self, radius: f64) -> Vec<usize> {
        let is_near = |element: &usize| {
            let corners = self.mesh.corners(*element);
            corners.iter().any(|[r, y]| r.hypot(*y) <= radius)
        };
        (0..self.mesh.quads().len()).filter(is_near).collect()
    }

    /// Returns the nodal stress, interpolated at a place (r, depth below the pole or y) in m, within these elements;
    /// `None` outside of them.
    pub fn interpolated(&self, near: &[usize], [r, y]: [f64; 2]) -> Option<[f64; 4]> {
        // An arc is beyond the chords of another mesh.
        const SLACKS: [f64; 2] = [1e-9, 0.05];
        let in_elements = |slack: f64| {
            near.iter().find_map(|&element| {
                let corners = self.mesh.corners(element).map(|[r, y]| [r, y.abs()]);
                Some((element, natural_coordinates(corners, [r, y.abs()], slack)?))
            })
        };
        SLACKS.into_iter().find_map(in_elements).map(|(element, [x, y])| {
            let weights = [
                0.25 * (1.0 - x) * (1.0 - y),
                0.25 * (1.0 + x) * (1.0 - y),
                0.25 * (1.0 + x) * (1.0 + y),
                0.25 * (1.0 - x) * (1.0 + y),
            ];
            let mut sum = [0.0; 4];
            for (node, weight) in self.mesh.quads()[element].into_iter().zip(weights) {
                let stress = self.field.points[node as usize];
                (0..4).for_each(|k| sum[k] += stress[k] * weight);
            }
            sum
        })
    }
}

impl Simulation {
    /// Returns the stress in the lower body (0) or the upper one (1) at an instant; `None` for a wall, for a model without
    /// elements, and for fields of another mesh.
    pub fn stress(&self, snapshot: &Snapshot, side: usize) -> Option<BodyStress<'_>> {
        let mesh = (*self.model().meshes().get(side)?)?;
        let material = self.case().scene().bodies()[side].material()?;
        let fields = &snapshot.bodies[side];
        let n_nodes = mesh.nodes().len();
        let relaxed = fields.effective.len();
        if fields.displacement.len() != n_nodes || (relaxed != 0 && relaxed != n_nodes) {
            return None;
        }
        let field = StressField::of(mesh, material, fields, Some(&snapshot.contact));
        Some(BodyStress { mesh, field })
    }
}

/// Returns the natural coordinates, each from −1 to 1, of a place in a quadrilateral by Newton's method; `None`
/// if it is outside by more than a slack.
fn natural_coordinates(corners: [[f64; 2]; 4], place: [f64; 2], slack: f64) -> Option<[f64; 2]> {
    const N_STEPS: usize = 12;
    for k in [0, 1] {
        let of = |pick: fn(f64, f64) -> f64| corners.iter().map(|c| c[k]).reduce(pick);
        let (low, high) = (of(f64::min)?, of(f64::max)?);
        let beyond = slack * (high - low);
        if !(low - beyond..=high + beyond).contains(&place[k]) {
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
    (x.abs() <= 1.0 + slack && y.abs() <= 1.0 + slack).then_some([x, y])
}
