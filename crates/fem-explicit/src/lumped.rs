//! A sphere before its time step is known.

use fem_element::QuadGeometry;
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::forces::NodeForce;
use crate::stress::{self, Stress};
use crate::time_step::NodalBound;

/// A sphere with its parts, its masses and a bound of its stiffness: what the time step is chosen
/// from.
#[derive(Debug)]
pub(crate) struct LumpedSphere {
    pub mesh: SphereMesh,
    pub material: Material,
    pub stress: Box<dyn Stress>,
    pub node_forces: Vec<Box<dyn NodeForce>>,
    /// Without contact.
    pub bound: NodalBound,
}

impl LumpedSphere {
    /// Integrates the elements, once for stress, masses and bound.
    pub fn new(mesh: SphereMesh, material: Material, node_forces: Vec<Box<dyn NodeForce>>) -> Self {
        let elements = 0..mesh.quads().len();
        let geometries: Vec<_> =
            elements.map(|element| QuadGeometry::new(&mesh.corners(element))).collect();
        let stress = stress::of_material(&mesh, &geometries, &material);
        let mut bound =
            NodalBound::of_elements(&mesh, &geometries, material.density(), stress.as_ref());
        for force in &node_forces {
            force.add_stiffness_bound(&mut bound.stiffness);
        }
        Self { mesh, material, stress, node_forces, bound }
    }
}
