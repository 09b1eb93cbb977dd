//! The dents of bodies that flowed: the surface before and after the collision, and their sizes.

use fem::results::DENT_FILE;
use fem_case::engineering::{number, show};
use fem_figure::{Chart, Curve};
use serde_json::Value;

use super::stored_result::{Columns, StoredResult};
use crate::quantity_axis::{QuantityAxis, chart_axes};

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
    let heights = || before.iter().chain(&after).copied().filter(|y| y.is_finite());
    let (low, high) = heights().fold((0.0f64, 0.0f64), |(a, b), y| (a.min(y), b.max(y)));
    let x = QuantityAxis::linear("distance from the axis r", "m", last);
    let size = high.max(-low);
    let margin = 0.05 * (high - low);
    let y = QuantityAxis::linear(format!("Surface of {}", name(dent)), "m", size)
        .from_to(low - margin, high + margin);
    let curve = |heights: &[f64]| {
        let points: Vec<(f64, f64)> = radii.iter().copied().zip(heights.iter().copied()).collect();
        x.points(&y, &points)
    };
    let chart = chart_axes(&x, &y).with(Curve::line("after", curve(&after)).like_curve(0));
    Some(chart.with(Curve::dashed("before", curve(&before)).like_curve(1)))
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
    text + ". Heights are measured from the mass centre."
}
