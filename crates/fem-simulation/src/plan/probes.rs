//! The places of bodies that a case asks for, in the meshes of its model.

use fem_case::Scene;
use fem_collision::{ProbeRequest, Probes};
use fem_mesh::SphereMesh;

use crate::rejection::Rejection;

/// Returns the probe requests of a run; a model without meshes has none and says so.
///
/// # Errors
/// A place that the mesh of its body does not have, or a body that is computed without.
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
            .with_help("a half-space is meshed out to mesh.far_radius"),
        None => Rejection::new(key, format!("\"{name}\" is computed as a rigid body"))
            .with_help("set effects.rigid_partner = \"off\""),
    })
}
