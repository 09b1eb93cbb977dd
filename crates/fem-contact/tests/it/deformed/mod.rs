//! Contact between deformed surfaces.

mod bound;
mod damping;
mod forces;
mod geometry;
mod search;

use fem_contact::{ContactForces, DeformedInterface, Surface};
use fem_mesh::SphereMesh;

use crate::common::{Field, Freedom, STIFFNESS, noise};

/// Two surfaces and the numbers of nodes of their bodies.
pub struct Scene {
    pub interface: DeformedInterface,
    pub n_nodes: [usize; 2],
}

impl Scene {
    pub fn new(surfaces: [Surface; 2], n_nodes: [usize; 2], candidate_radius: f64) -> Self {
        let [lower, upper] = surfaces;
        let interface = DeformedInterface::new(lower, upper, STIFFNESS, 0.0, candidate_radius);
        Self { interface: interface.unwrap(), n_nodes }
    }

    pub fn pair(meshes: &[SphereMesh; 2], candidate_radius: f64) -> Self {
        let n_nodes = meshes.each_ref().map(|mesh| mesh.nodes().len());
        Self::new(meshes.each_ref().map(Surface::of_sphere), n_nodes, candidate_radius)
    }

    /// A body of one node below a mesh.
    pub fn above(lower: Surface, mesh: &SphereMesh, candidate_radius: f64) -> Self {
        let surfaces = [lower, Surface::of_sphere(mesh)];
        Self::new(surfaces, [1, mesh.nodes().len()], candidate_radius)
    }

    /// Forces of a configuration on both bodies.
    pub fn forces(&self, u: &[Field; 2]) -> (ContactForces, [Field; 2]) {
        let mut f = self.n_nodes.map(|n| vec![[0.0; 2]; n]);
        let [lower, upper] = &mut f;
        let total = self.interface.add_forces([&u[0], &u[1]], [lower, upper]);
        (total, f)
    }

    pub fn at_rest(&self) -> [Field; 2] {
        self.n_nodes.map(|n| vec![[0.0; 2]; n])
    }

    /// Displacements without pattern: along r up to `along_r` (m), along y about an overlap of `depth`
    /// (m), which opens the contact in places. The axis stays the axis, a rigid body straight.
    pub fn ragged(&self, along_r: f64, depth: f64) -> [Field; 2] {
        let mut u = self.at_rest();
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            let n = self.n_nodes[side];
            let axis = self.interface.candidate_nodes(side).next().unwrap() as usize;
            for (k, u) in u[side].iter_mut().enumerate() {
                let free = if k == axis || n == 1 { 0.0 } else { 2.0 * along_r };
                *u = [free * noise(3 * k + side), sign * depth * (0.2 + 1.5 * noise(2 * k + side))];
            }
        }
        u
    }
}

pub fn sum(field: &Field, axis: usize) -> f64 {
    field.iter().map(|value| value[axis]).sum()
}

/// Returns the freedoms of bodies, of which the axis stays the axis, and their bounds.
pub fn bounded(
    scene: &Scene,
    sides: impl IntoIterator<Item = usize>,
    add: impl Fn(usize, &mut [f64]),
) -> (Vec<f64>, Vec<Freedom>) {
    let (mut bound, mut freedoms) = (Vec::new(), Vec::new());
    for side in sides {
        let mut of_side = vec![0.0; scene.n_nodes[side]];
        add(side, &mut of_side);
        for (k, node) in scene.interface.candidate_nodes(side).enumerate() {
            for axis in usize::from(k == 0)..2 {
                freedoms.push((side, node as usize, axis));
                bound.push(of_side[node as usize]);
            }
        }
    }
    (bound, freedoms)
}
