//! The report page of a run, `report.html`, and the comparison of several results on one page.
//!
//! A page is drawn from the files of its result folder alone, so an old result gets the same page as a new
//! one. The page is self-contained: pictures are SVG within it, and one style sheet serves light screens,
//! dark screens and paper.

mod cards;
mod case_keys;
mod comparison;
mod contours;
mod dent_chart;
mod effects;
mod hertz_curves;
mod history_charts;
mod measured_chart;
mod pressure_chart;
mod shared_error;
mod sketch;
mod stored_result;

use askama::Template;
use fem_case::engineering::show;
use fem_figure::Chart;
use fem_figure::contour::{Contour, Panel};
use serde_json::Value;

use crate::answer::bounce_answer;
use crate::number_text::{elapsed, grouped, power_of_ten};
use cards::Card;
use effects::EffectEntry;
use history_charts::oblique_chart;

pub use comparison::comparison_page;
pub use contours::{contour_of_dent, contour_of_result, contours_at_peak};
pub use effects::is_numerical;
pub use history_charts::{
    Quantity, bounce_charts, energy_chart, history_chart, loop_chart, normalised_chart,
    oblique_charts,
};
pub use pressure_chart::pressure_chart;
pub use stored_result::{Columns, ReportError, StoredResult};

/// The name of the page in a result folder.
pub const REPORT_FILE: &str = "report.html";
/// Most frames of the film on a page, which limits its size and the time to draw it.
const MAX_FRAMES: usize = 12;

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    title: String,
    subtitle: String,
    sketch: String,
    stopped: &'a str,
    cards: Vec<Card>,
    cost: String,
    warnings: Vec<String>,
    charts: Vec<String>,
    kink: &'static str,
    frames: Vec<FilmFrame>,
    /// Index of the frame that is visible when the page opens.
    opening: usize,
    bar: String,
    dark_rules: String,
    bounces: Vec<[String; 5]>,
    measured: String,
    measurements: Vec<String>,
    on: Vec<EffectEntry>,
    numerical: Vec<EffectEntry>,
    lacking: Vec<EffectEntry>,
    off: Vec<EffectEntry>,
    change_heads: [&'static str; 3],
    profile: String,
    dents: Vec<String>,
    zone: String,
    dent_sizes: Vec<String>,
    case: Vec<(String, String)>,
    cite: Vec<String>,
}

/// One frame of the film of stresses.
struct FilmFrame {
    caption: String,
    svg: String,
}

/// Returns the report page of one result as HTML.
pub fn report_page(result: &StoredResult) -> Result<String, ReportError> {
    let contour = contour_of_result(result, MAX_FRAMES);
    let of_one = std::slice::from_ref(result);
    let charts = [
        history_chart(of_one, Quantity::Force),
        history_chart(of_one, Quantity::Approach),
        history_chart(of_one, Quantity::Radius),
        energy_chart(result),
        oblique_chart(result),
    ];
    let charts = charts.into_iter().chain(bounce_charts(result).into_iter().map(Some));
    let [on, numerical, lacking, off] = effects::effects(result);
    let (dents, mut dent_sizes): (Vec<_>, Vec<_>) =
        dent_chart::dent_charts(result).into_iter().unzip();
    dent_sizes.extend(dent_chart::energy_of_dents(result));
    let strain = contour_of_dent(result);
    let zone = strain.as_ref().map(|contour| contour.frames().join("") + &contour.bar());
    // Bands of the plastic strain have colours of their own scale.
    let dark_rules = [(&contour, "."), (&strain, ".zone .")].map(|(contour, scope)| {
        let rules = contour.as_ref().map(Contour::dark_rules).unwrap_or_default();
        rules.replace('.', scope)
    });
    let (measured, measurements) = measured_chart::measured_chart(result).unzip();
    let page = Page {
        title: result.title(),
        subtitle: subtitle(result),
        sketch: sketch::sketch(result),
        stopped: result.text("stopped_because"),
        cards: cards::cards(result),
        cost: cost_text(result),
        warnings: warnings(result),
        charts: drawn(charts),
        kink: effects::contact_radius_kink(result),
        frames: contour.as_ref().map(film).unwrap_or_default(),
        opening: opening(result),
        bar: contour.as_ref().map(Contour::bar).unwrap_or_default(),
        dark_rules: dark_rules.concat(),
        bounces: result.list("bounces").iter().map(bounce).collect(),
        measured: drawn([measured]).pop().unwrap_or_default(),
        measurements: measurements.unwrap_or_default(),
        on,
        numerical,
        lacking,
        off,
        change_heads: effects::CHANGE_HEADS,
        profile: drawn([pressure_chart(of_one)]).pop().unwrap_or_default(),
        dents: drawn(dents),
        zone: zone.unwrap_or_default(),
        dent_sizes,
        case: result.summary.get("case").map(case_keys::keys).unwrap_or_default(),
        cite: vec![citation(result)],
    };
    Ok(page.render()?)
}

fn drawn(charts: impl IntoIterator<Item = Option<Chart>>) -> Vec<String> {
    charts.into_iter().flatten().filter_map(|chart| fem_figure::panel(&chart)).collect()
}

/// Draws the frames in parallel.
fn film(contour: &Contour) -> Vec<FilmFrame> {
    let frame =
        |panel: &Panel| FilmFrame { caption: panel.title.clone(), svg: contour.frame(panel) };
    std::thread::scope(|scope| {
        let drawers: Vec<_> =
            contour.panels.iter().map(|panel| scope.spawn(move || frame(panel))).collect();
        drawers.into_iter().filter_map(|drawer| drawer.join().ok()).collect()
    })
}

/// Returns the index of the frame nearest to the peak force.
fn opening(result: &StoredResult) -> usize {
    let peak = result.peak_time();
    let shown = contours::chosen_frames(result, MAX_FRAMES);
    let distance = |k: &usize| (result.frames[shown[*k]].time - peak).abs();
    (0..shown.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

fn subtitle(result: &StoredResult) -> String {
    let model = result.summary.get("case").and_then(|case| case.get("model"));
    let model = model.and_then(Value::as_object).and_then(|model| model.keys().next());
    let model = match model.map_or("", String::as_str) {
        "fem" => "explicit finite elements",
        "condensed" => "the condensed finite-element model",
        "ting" => "Ting's viscoelastic contact",
        "hertz" => "Hertz' elastic contact",
        "law" => "a contact law",
        other => other,
    };
    format!("{}, computed with {model}", result.body_names().join(" and "))
}

/// Returns the cost of the run in one line.
fn cost_text(result: &StoredResult) -> String {
    let elements = |body: &Value| body.get("elements").and_then(Value::as_f64);
    let elements: f64 = result.list("bodies").iter().filter_map(elements).sum();
    let seconds = result.number(&["cost", "solve_s"]).unwrap_or(0.0);
    let thin_space = '\u{202f}';
    let mut parts = vec![format!("computed in {}", elapsed(seconds))];
    if elements > 0.0 {
        parts.push(format!("{} elements", grouped(elements, thin_space)));
    }
    if let Some((steps, step)) = result.number(&["steps"]).zip(result.number(&["time_step_s"])) {
        parts.push(format!("{} steps of {}", grouped(steps, thin_space), show(step, "s")));
    }
    if let Some(residual) = result.number(&["energy", "residual_relative"]) {
        parts.push(format!("energy residual {} of the initial energy", power_of_ten(residual)));
    }
    parts.join(" · ")
}

/// Returns the warnings as HTML, without the one that the run is incomplete, which stands above.
fn warnings(result: &StoredResult) -> Vec<String> {
    let stopped = result.text("stopped_because");
    let warnings = result.list("warnings").iter().filter_map(Value::as_str);
    let others = warnings.filter(|warning| stopped.is_empty() || !warning.contains(stopped));
    others.map(with_code).collect()
}

/// Returns text as HTML, with the parts between backticks as code.
fn with_code(text: &str) -> String {
    let escaped = fem_figure::escaped(text);
    let mut parts = escaped.split('`').peekable();
    let mut html = String::new();
    let mut is_code = false;
    while let Some(part) = parts.next() {
        match is_code && parts.peek().is_some() {
            true => html += &format!("<code>{part}</code>"),
            // A single backtick stays.
            false if is_code => html += &format!("`{part}"),
            false => html += part,
        }
        is_code = !is_code;
    }
    html
}

fn bounce(bounce: &Value) -> [String; 5] {
    let number = |key: &str| bounce.get(key).and_then(Value::as_f64);
    let shown = |key: &str, unit: &str| number(key).map_or("\u{2013}".into(), |v| show(v, unit));
    let parts = serde_json::from_value(bounce["restitution_uncertainty"].clone());
    let (e, measured) = (number("restitution"), number("measured_restitution"));
    let restitution = bounce_answer(e, &parts.unwrap_or_default(), measured);
    [
        shown("time_s", "s"),
        shown("speed_before_m_s", "m/s"),
        restitution.unwrap_or("\u{2013}".into()),
        shown("contact_time_s", "s"),
        shown("peak_force_n", "N"),
    ]
}

fn citation(result: &StoredResult) -> String {
    let made_from: String = result.text("made_from").chars().take(12).collect();
    format!(
        "fem-run {}, {}. Result of case {made_from}, numerics {}: \u{201c}{}\u{201d}.",
        result.text("version"),
        env!("CARGO_PKG_REPOSITORY"),
        result.text("numerics"),
        result.title()
    )
}

#[cfg(test)]
mod tests {
    use super::with_code;

    #[test]
    fn warning_text_is_escaped_and_keys_are_code() {
        assert_eq!(
            with_code("a<b & `x = {}` or `y`"),
            "a&lt;b &amp; <code>x = {}</code> or <code>y</code>"
        );
        assert_eq!(with_code("one ` alone"), "one ` alone");
        assert_eq!(with_code("`a` and ` alone"), "<code>a</code> and ` alone");
    }
}
