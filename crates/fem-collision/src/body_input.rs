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
    /// A block that never ends, in its plane y = 0. Far away it keeps its velocity, as a wall does, and
    /// has an infinite mass.
    HalfSpace {
        /// Its mesh, on its side of the plane, as a [`QuarterDisc`](fem_mesh::QuarterDisc) makes it.
        /// The mesh says that it is one: in the place of a sphere's it is a half-space all the same.
        mesh: SphereMesh,
        /// Its material.
        material: Material,
    },
    /// A rigid plane of infinite mass that keeps its velocity.
    Wall,
}

impl BodyInput {
    /// Its mesh; a rigid body has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        match self {
            Self::Sphere { mesh, .. } | Self::HalfSpace { mesh, .. } => Some(mesh),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }

    /// Its material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match self {
            Self::Sphere { material, .. } | Self::HalfSpace { material, .. } => Some(material),
            Self::Rigid { .. } | Self::Wall => None,
        }
    }

    /// Whether it is a half-space.
    pub fn is_half_space(&self) -> bool {
        self.mesh().is_some_and(SphereMesh::is_half_space)
    }
}
