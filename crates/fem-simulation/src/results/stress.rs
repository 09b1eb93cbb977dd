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
        let field = StressField::of(mesh, material, fields);
        Some(BodyStress { mesh, field })
    }
}
