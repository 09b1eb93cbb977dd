//! The meshes of a case: made here, or files.

use std::path::Path;

use fem_case::{Scene, Shape};
use fem_mesh::SphereMesh;

use crate::limits::check_size;
use crate::mesh_source::{MeshSource, half_disc, mesh_refusal, quarter_disc};
use crate::plan::Plan;
use crate::refusal::Refusal;

/// The meshes of both bodies in their places; a rigid body has none.
///
/// # Errors
/// Meshes that cannot be made or read, or are too large.
pub fn build_meshes(scene: &Scene, plan: &Plan) -> Result<[Option<SphereMesh>; 2], Refusal> {
    let mut meshes = [None, None];
    for (k, source) in mesh_sources(scene, plan)?.iter().enumerate() {
        let build = |source: &MeshSource| source.build(k).map_err(|error| mesh_refusal(&error));
        meshes[k] = source.as_ref().map(build).transpose()?;
    }
    Ok(meshes)
}

/// What the meshes of both bodies are made from; a rigid body has none. Files are read.
///
/// # Errors
/// Meshes that cannot be made or read, or are too large.
pub(crate) fn mesh_sources(scene: &Scene, plan: &Plan) -> Result<[Option<MeshSource>; 2], Refusal> {
    check_size(scene, plan)?;
    let mut sources = [None, None];
    for (k, body) in scene.bodies().iter().enumerate() {
        sources[k] = match body.shape() {
            Shape::Sphere { diameter, mesh: Some(path), .. } => {
                Some(MeshSource::File(import(k, *diameter, path)?))
            }
            Shape::Sphere { diameter, mesh: None, .. } => {
                Some(MeshSource::HalfDisc(half_disc(plan, *diameter)))
            }
            Shape::HalfSpace { .. } => Some(MeshSource::QuarterDisc(quarter_disc(plan))),
            Shape::Rigid { .. } | Shape::Wall => None,
        };
    }
    Ok(sources)
}

fn import(k: usize, diameter: f64, path: &Path) -> Result<SphereMesh, Refusal> {
    read_sphere(diameter, path).map_err(|found| {
        let message = format!("mesh {}: {found}", path.display());
        Refusal::new(format!("body.{k}.sphere.mesh"), message).with_help(
            "a .vtu file of quadrilaterals in the plane (r, y, 0), in metres: the half disc \
             r >= 0 of the sphere with its contact pole at the origin; \
             `fem-run mesh CASE` writes such files",
        )
    })
}

#[cfg(feature = "files")]
fn read_sphere(diameter: f64, path: &Path) -> Result<SphereMesh, String> {
    let mesh = fem_vtk::read_quad_mesh(path).map_err(|error| error.to_string())?;
    if let Some(point) = mesh.points.iter().find(|point| point[2].abs() > 1e-6 * diameter) {
        return Err(format!("a point lies at z = {} m, off the plane z = 0", point[2]));
    }
    let nodes = mesh.points.iter().map(|point| [point[0], point[1]]).collect();
    SphereMesh::import(0.5 * diameter, nodes, mesh.quads).map_err(|error| error.to_string())
}

#[cfg(not(feature = "files"))]
fn read_sphere(_: f64, _: &Path) -> Result<SphereMesh, String> {
    Err("no files are read here".to_string())
}
