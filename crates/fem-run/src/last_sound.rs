//! A picture of the last sound state of a run that failed: σ_yy in section around the contact, on the
//! deformed bodies.

use std::path::Path;

use fem::Simulation;
use fem_case::engineering::Unit;
use fem_collision::{Collision, Label, Snapshot};
use fem_figure::contour::{Contour, Levels, Panel, Section, Window};

use crate::whole_file::write_whole;

/// σ_yy among (σ_rr, σ_yy, σ_θθ, σ_ry).
const AXIAL: usize = 1;
/// Bands over the largest stress, about.
const N_BANDS: usize = 11;
/// Half of the picture's width over the contact radius, or over the approach if that is larger.
const HALF_WIDTH: f64 = 3.0;

/// Writes `<stem>_last-sound.svg` into `folder` if the collision has such a state; its name.
pub fn write_last_sound(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
) -> Result<Option<String>, String> {
    let Some(svg) = picture(simulation, collision) else { return Ok(None) };
    let name = format!("{stem}_{}.svg", Label::LastSound.name());
    write_whole(&folder.join(&name), folder, svg.as_bytes())
        .map_err(|error| format!("{name} cannot be written: {error}"))?;
    Ok(Some(name))
}

fn picture(simulation: &Simulation, collision: &Collision) -> Option<String> {
    let snapshot = collision.snapshot(Label::LastSound)?;
    let sections: Vec<Section> =
        (0..2).filter_map(|side| section(simulation, snapshot, side)).collect();
    // Height is measured from the middle between the poles.
    let poles: Vec<f64> = sections.iter().filter_map(pole).collect();
    let middle = poles.iter().sum::<f64>() / poles.len().max(1) as f64;
    let radius = collision.max_contact_radius.unwrap_or(0.0).max(snapshot.approach);
    let bands = |(from, to): (f64, f64), section: &Section| {
        section.range().map_or((from, to), |range| (from.min(range.0), to.max(range.1)))
    };
    let (smallest, largest) = sections.iter().fold((0.0, 0.0), bands);
    let (length, stress) =
        (Unit::fitting(HALF_WIDTH * radius, "m"), Unit::fitting(largest.max(-smallest), "Pa"));
    let half = length.scaled(HALF_WIDTH * radius);
    let drawn = |mut section: Section| {
        for [r, y] in &mut section.points {
            (*r, *y) = (length.scaled(*r), length.scaled(*y - middle));
        }
        section.values.iter_mut().for_each(|value| *value = stress.scaled(*value));
        section.mirrored()
    };
    let time = Unit::fitting(snapshot.time, "s").with_digits(4);
    let is_drawable = radius > 0.0 && half.is_finite() && !sections.is_empty();
    is_drawable.then(|| {
        Contour {
            quantity: format!("σ_yy [{}]", stress.symbol()),
            x_label: format!("r [{}]", length.symbol()),
            y_label: format!("y [{}]", length.symbol()),
            window: Window { x: (-half, half), y: (-half, half) },
            levels: Levels::about_zero(stress.scaled(smallest), stress.scaled(largest), N_BANDS),
            panels: vec![Panel {
                title: format!("last sound state, {}", time.show(snapshot.time)),
                sections: sections.into_iter().map(drawn).collect(),
            }],
        }
        .svg()
    })
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

fn pole(section: &Section) -> Option<f64> {
    section.outline.first().map(|point| section.points[*point as usize][1])
}
