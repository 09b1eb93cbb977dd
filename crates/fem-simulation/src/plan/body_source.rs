//! The sources of the bodies (mesh source and material) before their meshes are built, the built meshes, and the probes in
//! them.

use fem_case::{Body, ModelChoice, Scene, Shape};
use fem_collision::{BodyInput, ProbeRequest, Probes};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::plan::Plan;
use crate::plan::limits::check_size;
use crate::plan::mesh_source::{
    MeshSource, graded_plate, half_disc, import, mesh_rejection, quarter_disc,
};
use crate::rejection::Rejection;

/// The source of a body. Equal sources give equal bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BodySource {
    /// A meshed body.
    Meshed { mesh: MeshSource, material: Material },
    /// A rigid sphere; radius in metres, mass in kilograms.
    Rigid { radius: f64, mass: f64 },
    /// A rigid plane of infinite mass.
    Wall,
}

impl BodySource {
    /// Returns the sources of both bodies of a scene.
    ///
    /// # Errors
    /// Meshes that cannot be made or read, or are too large.
    pub fn of_scene(scene: &Scene, plan: &Plan) -> Result<[Self; 2], Rejection> {
        let scene = &meshed(scene);
        check_size(scene, plan)?;
        let [lower, upper] = scene.bodies();
        Ok([Self::of(lower, 0, plan)?, Self::of(upper, 1, plan)?])
    }

    fn of(body: &Body, side: usize, plan: &Plan) -> Result<Self, Rejection> {
        Ok(match body.shape() {
            Shape::Sphere { diameter, mesh, material } => {
                let mesh = match mesh {
                    Some(path) => MeshSource::File(Box::new(import(side, *diameter, path)?)),
                    None => MeshSource::HalfDisc(half_disc(plan, side, *diameter)),
                };
                Self::Meshed { mesh, material: material.clone() }
            }
            Shape::HalfSpace { material } => {
                let mesh = MeshSource::QuarterDisc(quarter_disc(plan, side));
                Self::Meshed { mesh, material: material.clone() }
            }
            Shape::Plate { plate, material } => {
                let mesh = MeshSource::Plate(graded_plate(plan, side, plate, material));
                Self::Meshed { mesh, material: material.clone() }
            }
            Shape::Rigid { diameter, mass } => Self::Rigid { radius: 0.5 * diameter, mass: *mass },
            Shape::Wall => Self::Wall,
        })
    }

    /// Returns this body without relaxation.
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
            Self::Meshed { mesh, material } => mesh
                .n_elements()
                .map_err(|error| mesh_rejection(&error, 0, material, mesh.is_bonded())),
            Self::Rigid { .. } | Self::Wall => Ok(0),
        }
    }

    /// Builds the body as the lower one (0) or the upper one (1).
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn build(&self, side: usize) -> Result<BodyInput, Rejection> {
        Ok(match self {
            Self::Meshed { mesh, material } => {
                let is_bonded = mesh.is_bonded();
                let mesh = mesh
                    .build(side)
                    .map_err(|error| mesh_rejection(&error, side, material, is_bonded))?;
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

/// Returns a scene with the bodies that its model meshes: condensed bodies have a half-space in place of a plate, whose bending
/// is a dashpot.
pub(crate) fn meshed(scene: &Scene) -> Scene {
    let is_condensed = matches!(scene.model(), ModelChoice::Condensed(_));
    match scene.bodies().iter().position(|body| body.plate().is_some()) {
        Some(side) if is_condensed => scene.with_half_space(side),
        _ => scene.clone(),
    }
}

/// Builds the meshes of both bodies in their places; a rigid body has none.
///
/// # Errors
/// Meshes that cannot be made or read, or are too large.
pub fn build_meshes(scene: &Scene, plan: &Plan) -> Result<[Option<SphereMesh>; 2], Rejection> {
    let mut meshes = [None, None];
    for (k, source) in BodySource::of_scene(scene, plan)?.iter().enumerate() {
        if let BodyInput::Sphere { mesh, .. } | BodyInput::HalfSpace { mesh, .. } =
            source.build(k)?
        {
            meshes[k] = Some(mesh);
        }
    }
    Ok(meshes)
}

/// Returns the probe requests of a run; a model without meshes has none.
pub(crate) fn probes_of(
    scene: &Scene,
    meshes: [Option<&SphereMesh>; 2],
) -> Result<Vec<ProbeRequest>, Rejection> {
    if meshes.iter().all(Option::is_none) {
        return Ok(Vec::new());
    }
    let places = scene.probes().iter();
    let requests: Vec<_> =
        places.map(|probe| ProbeRequest { side: probe.body, place: [probe.r, probe.y] }).collect();
    let Some(k) = Probes::new(meshes, &requests).first_outside() else { return Ok(requests) };
    let (side, key) = (requests[k].side, format!("output.probe.{k}"));
    let name = scene.bodies()[side].name();
    Err(match meshes[side] {
        Some(_) => Rejection::new(key, format!("the mesh of \"{name}\" does not reach this place"))
            .with_help("a half-space or plate is meshed out to mesh.far_radius"),
        None => Rejection::new(key, format!("\"{name}\" is computed as a rigid body"))
            .with_help("set effects.rigid_partner = \"off\""),
    })
}
