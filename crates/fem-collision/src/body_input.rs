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
    /// A sphere that does not deform: one degree of freedom, its motion along y.
    Rigid {
        /// Of the sphere, m.
        radius: f64,
        /// kg.
        mass: f64,
    },
    /// A rigid plane of infinite mass that keeps its velocity.
    Wall,
}

impl BodyInput {
    /// Its mesh; a rigid body has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        match self {
            Self::Sphere { mesh, .. } => Some(mesh),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }

    /// Its material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match self {
            Self::Sphere { material, .. } => Some(material),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }
}
