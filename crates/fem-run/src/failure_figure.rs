//! The picture of the last valid state of a failed run: the axial stress around the contact.

use std::path::Path;

use fem::Simulation;
use fem_case::engineering::Unit;
use fem_collision::{Collision, Label};
use fem_report::section_view::{contour_of_frames, half_width, mirrored, sections};

use crate::whole_file::write_whole;

/// Writes `<stem>_last-sound.svg` into `folder` and returns its name; `None` if the collision has no such
/// state or no elements.
///
/// # Errors
/// The file cannot be written.
pub fn write_failure_figure(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
) -> Result<Option<String>, String> {
    let Some(svg) = failure_figure(simulation, collision) else { return Ok(None) };
    let name = format!("{stem}_{}.svg", Label::LastSound.name());
    write_whole(&folder.join(&name), folder, svg.as_bytes())
        .map_err(|error| format!("{name} cannot be written: {error}"))?;
    Ok(Some(name))
}

fn failure_figure(simulation: &Simulation, collision: &Collision) -> Option<String> {
    let snapshot = collision.snapshot(Label::LastSound)?;
    let near = half_width(collision.max_contact_radius.unwrap_or(0.0), snapshot.approach)?;
    let both = sections(simulation, snapshot)?;
    let time = Unit::fitting(snapshot.time, "s").with_digits(4);
    let title = format!("last valid state, {}", time.show(snapshot.time));
    Some(mirrored(contour_of_frames(vec![both], vec![title], near, |_, _, _| None)).svg())
}
