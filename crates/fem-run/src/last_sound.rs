//! A picture of the last sound state of a run that failed: σ_yy in section around the contact, on the
//! deformed bodies.

use std::path::Path;

use fem::Simulation;
use fem_case::engineering::Unit;
use fem_collision::{Collision, Label, Snapshot};
use fem_figure::contour::Section;

use crate::page::{centred, nearness, picture, whole};
use crate::whole_file::write_whole;

/// σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
/// Writes `<stem>_last-sound.svg` into `folder` if the collision has such a state; its name.
pub fn write_last_sound(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
) -> Result<Option<String>, String> {
    let Some(svg) = drawn(simulation, collision) else { return Ok(None) };
    let name = format!("{stem}_{}.svg", Label::LastSound.name());
    write_whole(&folder.join(&name), folder, svg.as_bytes())
        .map_err(|error| format!("{name} cannot be written: {error}"))?;
    Ok(Some(name))
}

fn drawn(simulation: &Simulation, collision: &Collision) -> Option<String> {
    let snapshot = collision.snapshot(Label::LastSound)?;
    let near = nearness(collision.max_contact_radius.unwrap_or(0.0), snapshot.approach)?;
    let mut both = [0, 1].map(|side| section(simulation, snapshot, side).unwrap_or_default());
    if both.iter().all(|section| section.quads.is_empty()) {
        return None;
    }
    centred(&mut both);
    let time = Unit::fitting(snapshot.time, "s").with_digits(4);
    let title = format!("last sound state, {}", time.show(snapshot.time));
    Some(whole(picture(vec![both], vec![title], near, |_, _, _| None)).svg())
}

/// A body with a mesh, deformed, m and Pa.
fn section(simulation: &Simulation, snapshot: &Snapshot, side: usize) -> Option<Section> {
    let body = simulation.stress(snapshot, side)?;
    let moved = body.mesh.nodes().iter().zip(snapshot.displacement(side));
    Some(Section {
        points: moved.map(|([r, y], u)| [r + u[0], y + u[1]]).collect(),
        values: body.field.points.iter().map(|stress| stress[AXIAL]).collect(),
        quads: body.mesh.quads().to_vec(),
        outline: body.mesh.surface().to_vec(),
    })
}
