//! What a body of a scene is made of, for a model with meshes, before any mesh is made.

use fem_case::{Body, Scene, Shape};
use fem_collision::BodyInput;
use fem_material::Material;

use crate::plan::Plan;
use crate::plan::limits::check_size;
use crate::plan::mesh_source::{MeshSource, half_disc, import, mesh_refusal, quarter_disc};
use crate::refusal::Refusal;

/// What a body is made of; equal ones make equal bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BodySource {
    /// A meshed body.
    Meshed {
        /// What its mesh is made from.
        mesh: MeshSource,
        /// Its material.
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
    /// Of both bodies of a scene. Mesh files are read.
    ///
    /// # Errors
    /// Meshes that cannot be made or read, or are too large.
    pub fn of_scene(scene: &Scene, plan: &Plan) -> Result<[Self; 2], Refusal> {
        check_size(scene, plan)?;
        let [lower, upper] = scene.bodies();
        Ok([Self::of(lower, 0, plan)?, Self::of(upper, 1, plan)?])
    }

    fn of(body: &Body, side: usize, plan: &Plan) -> Result<Self, Refusal> {
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

    /// How many elements it has, without making them.
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn n_elements(&self) -> Result<usize, Refusal> {
        match self {
            Self::Meshed { mesh, .. } => mesh.n_elements().map_err(|error| mesh_refusal(&error)),
            Self::Rigid { .. } | Self::Wall => Ok(0),
        }
    }

    /// The lower body, 0, or the upper one, 1.
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn build(&self, side: usize) -> Result<BodyInput, Refusal> {
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
