//! The dents of bodies that flowed: the displacement of the surface, the sizes, and the energy that they took.

use fem::results::DENT_FILE;
use fem_case::engineering::{number, show};
use fem_figure::{Chart, Curve};
use serde_json::Value;

use super::stored_result::{Columns, StoredResult};
use crate::answer::relative_motion_energy;
use crate::quantity_axis::quantity_axis;

/// Returns a chart of each dent and a line of its sizes.
pub fn dent_charts(result: &StoredResult) -> Vec<(Option<Chart>, String)> {
    let profiles = Columns::read(&result.folder.join(DENT_FILE)).unwrap_or_default();
    result.list("dent").iter().map(|dent| (chart(dent, &profiles), sizes(dent))).collect()
}

fn name(dent: &Value) -> &str {
    dent.get("body").and_then(Value::as_str).unwrap_or_default()
}

fn chart(dent: &Value, profiles: &Columns) -> Option<Chart> {
    let bodies = profiles.texts("body").iter().enumerate();
    let rows: Vec<usize> =
        bodies.filter(|(_, body)| *body == name(dent)).map(|(row, _)| row).collect();
    let column = |key: &str| rows.iter().map(|row| profiles.get(key)[*row]).collect::<Vec<f64>>();
    let [radii, before, after] = ["r_m", "y_before_m", "y_after_m"].map(column);
    let last = *radii.last()?;
    let changes: Vec<f64> =
        after.iter().zip(&before).map(|(after, before)| after - before).collect();
    let known = || changes.iter().copied().filter(|y| y.is_finite());
    let (low, high) = known().fold((0.0f64, 0.0f64), |(a, b), y| (a.min(y), b.max(y)));
    let x = quantity_axis("distance from the axis r", "m", last);
    let margin = 0.05 * (high - low);
    let y = format!("Displacement of the surface of {}", name(dent));
    let y = quantity_axis(y, "m", high.max(-low)).from_to(low - margin, high + margin);
    let points = radii.into_iter().zip(changes).collect();
    let curve = Curve::line("left by the collision", points);
    Some(Chart::new(x, y).with(curve.like_curve(0)))
}

/// "Of the energy of relative motion, 44 % …": where the energy went that the dents took.
pub fn energy_of_dents(result: &StoredResult) -> Option<String> {
    let number_of = |body: &Value, key: &str| body.get(key).and_then(Value::as_f64);
    let body = |it: &Value| {
        (number_of(it, "mass_kg"), number_of(it, "velocity_before_m_s").unwrap_or(0.0))
    };
    let [lower, upper] = result.list("bodies") else { return None };
    let all = relative_motion_energy([body(lower), body(upper)])?;
    let share = |key: &str| Some(number(100.0 * result.number(&["energy", key])? / all, 2));
    // Dents beside each other hold more residual stress than that of the first one.
    let is_fresh = result.summary["case"]["gravity"]["spot"] == "fresh";
    if is_fresh && result.list("bounces").len() > 1 {
        return None;
    }
    let (plastic, locked_in) = (share("plastic_work_j")?, share("locked_in_j")?);
    Some(format!(
        "Of the energy of relative motion, {plastic} % became plastic work, and {locked_in} % is locked in by residual stress."
    ))
}

/// "ball: 8.1 µm deep, …".
fn sizes(dent: &Value) -> String {
    let number_of = |key: &str| dent.get(key).and_then(Value::as_f64);
    let length =
        |key: &str| number_of(key).map_or("an unknown length".to_string(), |m| show(m, "m"));
    let mut text = format!(
        "{}: {} deep, {} in radius; plastic strain above 0.2 % down to {} and out to {}",
        name(dent),
        length("depth_m"),
        length("radius_m"),
        length("plastic_zone_depth_m"),
        length("plastic_zone_radius_m"),
    );
    if let Some(strain) = number_of("max_plastic_strain") {
        text += &format!(", at most {} %", number(100.0 * strain, 2));
    }
    text += &match number_of("crown_radius_m") {
        Some(crown) if crown < 0.0 => {
            format!("; its bottom is concave, with a radius of {}", show(-crown, "m"))
        }
        Some(crown) => format!("; its bottom has a radius of {}", show(crown, "m")),
        None => String::new(),
    };
    text + ". Displacements are relative to the mass centre."
}
