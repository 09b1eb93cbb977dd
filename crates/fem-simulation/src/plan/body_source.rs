//! The source of a body with a mesh: mesh source, material and placement, before the mesh is built.

use fem_case::{Body, Scene, Shape};
use fem_collision::BodyInput;
use fem_material::Material;

use crate::plan::Plan;
use crate::plan::limits::check_size;
use crate::plan::mesh_source::{MeshSource, half_disc, import, mesh_refusal, quarter_disc};
use crate::rejection::Rejection;

/// The source of a body; equal sources give equal bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BodySource {
    /// A meshed body.
    Meshed {
        /// Source of the mesh.
        mesh: MeshSource,
        /// Material of the body.
        material: Material,
    },
    /// A rigid sphere.
    Rigid {
        /// m.
        radius: f64,
        /// kg.
        mass: f64,
    },
    /// A rigid plane of infinite mass.
    Wall,
}

impl BodySource {
    /// Returns the sources of both bodies of a scene.
    ///
    /// # Errors
    /// Meshes that cannot be made or read, or are too large.
    pub fn of_scene(scene: &Scene, plan: &Plan) -> Result<[Self; 2], Rejection> {
        check_size(scene, plan)?;
        let [lower, upper] = scene.bodies();
        Ok([Self::of(lower, 0, plan)?, Self::of(upper, 1, plan)?])
    }

    fn of(body: &Body, side: usize, plan: &Plan) -> Result<Self, Rejection> {
        Ok(match body.shape() {
            Shape::Sphere { diameter, mesh, material } => {
                let mesh = match mesh {
                    Some(path) => MeshSource::File(import(side, *diameter, path)?),
                    None => MeshSource::HalfDisc(half_disc(plan, side, *diameter)),
                };
                Self::Meshed { mesh, material: material.clone() }
            }
            Shape::HalfSpace { material } => {
                let mesh = MeshSource::QuarterDisc(quarter_disc(plan, side));
                Self::Meshed { mesh, material: material.clone() }
            }
            Shape::Rigid { diameter, mass } => Self::Rigid { radius: 0.5 * diameter, mass: *mass },
            Shape::Wall => Self::Wall,
        })
    }

    /// The same body of a material that does not relax.
    pub fn without_relaxation(self) -> Self {
        match self {
            Self::Meshed { mesh, material } => {
                Self::Meshed { mesh, material: material.without_relaxation() }
            }
            other => other,
        }
    }

    /// Returns the number of elements without building the mesh.
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn n_elements(&self) -> Result<usize, Rejection> {
        match self {
            Self::Meshed { mesh, .. } => mesh.n_elements().map_err(|error| mesh_refusal(&error)),
            Self::Rigid { .. } | Self::Wall => Ok(0),
        }
    }

    /// The lower body, 0, or the upper one, 1.
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn build(&self, side: usize) -> Result<BodyInput, Rejection> {
        Ok(match self {
            Self::Meshed { mesh, material } => {
                let mesh = mesh.build(side).map_err(|error| mesh_refusal(&error))?;
                let material = material.clone();
                match mesh.is_half_space() {
                    true => BodyInput::HalfSpace { mesh, material },
                    false => BodyInput::Sphere { mesh, material },
                }
            }
            Self::Rigid { radius, mass } => BodyInput::Rigid { radius: *radius, mass: *mass },
            Self::Wall => BodyInput::Wall,
        })
    }
}
