//! The meshes of a case: made here, or files.

use fem_case::Scene;
use fem_collision::BodyInput;
use fem_mesh::SphereMesh;

use crate::plan::Plan;
use crate::plan::body_source::BodySource;
use crate::rejection::Rejection;

/// The meshes of both bodies in their places; a rigid body has none.
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
