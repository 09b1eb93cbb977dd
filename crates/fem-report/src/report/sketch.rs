//! A sketch of the two bodies before the collision, to scale: sizes, gap and speeds.

use fem_case::engineering::show;
use fem_figure::escaped;
use serde_json::Value;

use super::stored_result::StoredResult;

/// Size of the drawing, px, and the place of the axis and of the texts.
const HEIGHT: f64 = 180.0;
const WIDTH: f64 = 420.0;
const AXIS: f64 = 95.0;
const TEXT: f64 = 200.0;
/// Space above and below the bodies, px.
const MARGIN: f64 = 8.0;
/// Height of an unbounded body, over that of the whole drawing.
const UNBOUNDED: f64 = 0.15;
/// Largest gap that is drawn, over the larger diameter.
const MAX_GAP: f64 = 2.0;
/// Length of the arrow of the faster body, px.
const ARROW: f64 = 26.0;

/// A body of the sketch.
struct Body {
    name: String,
    /// The diameter of a sphere, m.
    diameter: Option<f64>,
    /// The velocity along +y, m/s.
    velocity: f64,
}

impl Body {
    fn of(result: &StoredResult, index: usize) -> Option<Self> {
        let written = result.summary.get("case")?.get("body")?.get(index)?;
        let computed = result.list("bodies").get(index)?;
        let diameter = written.get("sphere").and_then(|sphere| sphere.get("diameter"));
        Some(Self {
            name: written.get("name").and_then(Value::as_str)?.to_string(),
            diameter: diameter.and_then(number),
            velocity: computed.get("velocity_before_m_s").and_then(Value::as_f64).unwrap_or(0.0),
        })
    }

    /// Returns size and speed.
    fn words(&self) -> String {
        let speed = match self.velocity == 0.0 {
            true => "at rest".to_string(),
            false => show(self.velocity.abs(), "m/s"),
        };
        match self.diameter {
            Some(diameter) => format!("{}, {speed}", show(diameter, "m")),
            None => speed,
        }
    }

    /// Draws the body whose nearest point to the other one is at `y`; `side` is 1 below and −1 above it.
    fn drawn(&self, y: f64, side: f64, scale: f64, fastest: f64) -> String {
        let (shape, centre) = match self.diameter {
            Some(diameter) => {
                let radius = 0.5 * scale * diameter;
                let centre = y + side * radius;
                (
                    format!(
                        "<circle cx=\"{AXIS}\" cy=\"{centre:.1}\" r=\"{radius:.1}\" class=\"rigid\"/>"
                    ),
                    centre,
                )
            }
            None => {
                let height = UNBOUNDED * HEIGHT;
                let top = y.min(y + side * height);
                let width = 2.0 * AXIS;
                let rect = format!(
                    "<rect x=\"0\" y=\"{top:.1}\" width=\"{width}\" height=\"{height:.1}\" class=\"rigid\"/>"
                );
                (rect, y + 0.5 * side * height)
            }
        };
        let [name, label] = [&self.name, &self.words()].map(|text| escaped(text));
        let first = centre.clamp(16.0, HEIGHT - 24.0) - 2.0;
        let second = first + 18.0;
        let text = format!(
            "<text x=\"{TEXT}\" y=\"{first:.1}\" class=\"ink\">{name}</text><text x=\"{TEXT}\" y=\"{second:.1}\" \
             class=\"dim\">{label}</text>"
        );
        if self.velocity == 0.0 {
            return shape + &text;
        }
        // +y is up in the scene and down in the drawing.
        let length = ARROW * (self.velocity / fastest).abs().max(0.3);
        let end = centre - length * self.velocity.signum();
        let barb = end + 6.0 * self.velocity.signum();
        let (left, right) = (AXIS - 4.0, AXIS + 4.0);
        let arrow = format!(
            "<path d=\"M{AXIS} {centre:.1}V{end:.1}M{left} {barb:.1}L{AXIS} {end:.1}L{right} {barb:.1}\" \
             class=\"ink stroke\" fill=\"none\" stroke-width=\"1.5\"/>"
        );
        shape + &arrow + &text
    }
}

/// Returns the sketch as SVG; empty for a result without the bodies of its case.
pub fn sketch(result: &StoredResult) -> String {
    let (Some(lower), Some(upper)) = (Body::of(result, 0), Body::of(result, 1)) else {
        return String::new();
    };
    let sizes: Vec<f64> = [&lower, &upper].iter().filter_map(|body| body.diameter).collect();
    let largest = sizes.iter().fold(0.0f64, |most, size| most.max(*size));
    let gap = result.summary.get("case").and_then(|case| case.get("start")?.get("gap"));
    let gap = gap.and_then(number).unwrap_or(0.0).min(MAX_GAP * largest);
    let n_unbounded = 2 - sizes.len();
    let free = HEIGHT * (1.0 - UNBOUNDED * n_unbounded as f64) - 2.0 * MARGIN;
    let scale = free / (sizes.iter().sum::<f64>() + gap);
    if !scale.is_finite() || largest == 0.0 {
        return String::new();
    }
    let below = lower.diameter.map_or(UNBOUNDED * HEIGHT, |diameter| scale * diameter);
    let surface = HEIGHT - MARGIN - below;
    let fastest = lower.velocity.abs().max(upper.velocity.abs());
    let lower = lower.drawn(surface, 1.0, scale, fastest);
    let upper = upper.drawn(surface - scale * gap, -1.0, scale, fastest);
    format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" style=\"max-width:100%;height:auto\" role=\"img\" aria-label=\"The bodies before the \
         collision, to scale\">{lower}{upper}</svg>"
    )
}

/// Returns a number in SI, also one with an uncertainty beside it.
fn number(value: &Value) -> Option<f64> {
    value.as_f64().or_else(|| value.get("value")?.as_f64())
}
