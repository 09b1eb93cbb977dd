//! The measured restitutions of the library beside the result, over the approach speed.

use fem_case::engineering::show;
use fem_figure::{Axis, Chart, Curve};
use serde_json::Value;

use super::stored_result::StoredResult;
use crate::quantity_axis::{DECADE, fitting_axis};

/// Returns the chart, and one line per measurement with its conditions and its source. `None` without a measurement.
pub fn measured_chart(result: &StoredResult) -> Option<(Chart, Vec<String>)> {
    let measured = result.list("measured_restitution");
    let restitution = result.number(&["restitution"])?;
    let speed = approach_speed(result)?;
    let curves: Vec<_> = measured.iter().map(points).collect();
    // Some room beside a single speed.
    let around = [0.8 * speed, 1.25 * speed];
    let speeds = curves.iter().flatten().map(|point| point.0).chain(around);
    if measured.is_empty() {
        return None;
    }
    let x = fitting_axis("approach speed v", "m/s", speeds, DECADE);
    let mut chart = Chart::new(x, Axis::new("Restitution e").from_to(0.0, 1.05));
    for (k, (entry, points)) in measured.iter().zip(curves).enumerate() {
        let scatter = entry.get("scatter").and_then(Value::as_f64);
        let errors = scatter.map_or(Vec::new(), |scatter| vec![scatter; points.len()]);
        let curve = Curve::points_on_line(text(entry, "name"), points).with_errors(errors);
        chart = chart.with(curve.like_curve(k + 1));
    }
    // Drawn last, since it may lie on a measured point.
    chart = chart.with(Curve::points("this result", vec![(speed, restitution)]).like_curve(0));
    Some((chart, measured.iter().map(|entry| conditions(entry, speed)).collect()))
}

/// Returns the relative speed before the collision, m/s.
fn approach_speed(result: &StoredResult) -> Option<f64> {
    let before = |body: &Value| body.get("velocity_before_m_s").and_then(Value::as_f64);
    let velocities: Vec<f64> =
        result.list("bodies").iter().map(|body| before(body).unwrap_or(0.0)).collect();
    let [lower, upper] = velocities[..] else { return None };
    Some(lower - upper).filter(|speed| *speed > 0.0)
}

fn points(entry: &Value) -> Vec<(f64, f64)> {
    let point = |pair: &Value| Some((pair.get(0)?.as_f64()?, pair.get(1)?.as_f64()?));
    let points = entry.get("points").and_then(Value::as_array);
    points.into_iter().flatten().filter_map(point).collect()
}

fn text<'a>(entry: &'a Value, key: &str) -> &'a str {
    entry.get(key).and_then(Value::as_str).unwrap_or_default()
}

fn conditions(entry: &Value, speed: f64) -> String {
    let details = [text(entry, "bodies"), text(entry, "size"), text(entry, "temperature")];
    let details: Vec<&str> = details.into_iter().filter(|text| !text.is_empty()).collect();
    let restitution = match entry.get("restitution").and_then(Value::as_f64) {
        Some(restitution) => format!("e = {restitution:.2} at {}", show(speed, "m/s")),
        None => format!("not measured at {}", show(speed, "m/s")),
    };
    let (name, details, source) = (text(entry, "name"), details.join(", "), text(entry, "source"));
    format!("{name}: {details}; {restitution}. {source}.")
}
