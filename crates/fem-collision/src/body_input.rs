//! What a body is, for a model with meshes.

use fem_material::Material;
use fem_mesh::SphereMesh;

/// What a body is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyInput {
    /// A meshed sphere.
    Sphere {
        /// Its mesh, on its side of the plane y = 0.
        mesh: SphereMesh,
        /// Its material.
        material: Material,
    },
    /// A rigid plane of infinite mass that keeps its velocity.
    Wall,
}

impl BodyInput {
    /// Its mesh; a wall has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        match self {
            Self::Sphere { mesh, .. } => Some(mesh),
            Self::Wall => None,
        }
    }

    /// Its material; a wall has none.
    pub fn material(&self) -> Option<&Material> {
        match self {
            Self::Sphere { material, .. } => Some(material),
            Self::Wall => None,
        }
    }
}
