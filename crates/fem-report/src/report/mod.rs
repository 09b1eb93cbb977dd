//! `report.html`: a result as a page that needs nothing else, and several results beside each other.
//!
//! Drawn from the files of a result folder alone, so that an old result has the same page as a new one.
//! Nothing in it is computed but Hertz' curves, scaled to the summary's; pictures are SVG within the page,
//! whose style sheet has light, dark and paper.

mod cards;
mod case_text;
mod columns;
mod comparison;
mod contours;
mod curves;
mod effects;
mod hertz;
mod kink;
mod profile;
mod record;
mod view;

use askama::Template;
use fem_case::engineering::show;
use fem_figure::Chart;
use fem_figure::contour::{Contour, Panel};
use serde_json::Value;

use crate::failure::Failure;
use crate::stopwatch::spent;
use cards::Card;
use curves::Quantity;
use effects::Effect;

pub use comparison::comparison;
pub use contours::contour;
pub use curves::{Quantity as Plotted, energies, over_time};
pub use profile::pressures;
pub use record::Record;
pub use view::{centred, nearness, picture, whole};

/// The name of the page in a result folder.
pub const REPORT_FILE: &str = "report.html";
/// Frames that a page has room and time for.
const MOST_FRAMES: usize = 12;

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    title: String,
    subtitle: String,
    stopped: &'a str,
    cards: Vec<Card>,
    price: String,
    warnings: Vec<String>,
    charts: Vec<String>,
    kink: &'static str,
    frames: Vec<Shot>,
    /// The frame that is seen at first.
    opening: usize,
    bar: String,
    dark_rules: String,
    bounces: Vec<[String; 5]>,
    on: Vec<Effect>,
    numerical: Vec<Effect>,
    off: Vec<Effect>,
    profile: String,
    case: Vec<(String, String)>,
    cite: Vec<String>,
}

/// A frame of the film.
struct Shot {
    caption: String,
    svg: String,
}

/// The page of one result.
///
/// # Errors
/// None that depend on the result.
pub fn page(record: &Record) -> Result<String, Failure> {
    let contour = contour(record, MOST_FRAMES);
    let of_time = Quantity::ALL.map(|q| over_time(std::slice::from_ref(record), q));
    let [force, approach, radius, _] = of_time;
    let charts = [force, approach, radius, energies(record)];
    let profile = drawn([pressures(std::slice::from_ref(record))]).pop().unwrap_or_default();
    let [on, numerical, off] = effects::effects(record);
    let page = Page {
        title: record.title(),
        subtitle: subtitle(record),
        stopped: record.text("stopped_because"),
        cards: cards::cards(record),
        price: price(record),
        warnings: warnings(record),
        charts: drawn(charts),
        kink: kink::words(record),
        frames: contour.as_ref().map(shots).unwrap_or_default(),
        opening: opening(record),
        bar: contour.as_ref().map(Contour::bar).unwrap_or_default(),
        dark_rules: contour.as_ref().map(Contour::dark_rules).unwrap_or_default(),
        bounces: record.list("bounces").iter().map(bounce).collect(),
        on,
        numerical,
        off,
        profile,
        case: record.summary.get("case").map(case_text::keys).unwrap_or_default(),
        cite: vec![citation(record)],
    };
    page.render().map_err(|error| Failure::failed(format!("the page cannot be made: {error}")))
}

fn drawn(charts: impl IntoIterator<Item = Option<Chart>>) -> Vec<String> {
    charts.into_iter().flatten().filter_map(|chart| fem_figure::panel(&chart)).collect()
}

fn shots(contour: &Contour) -> Vec<Shot> {
    let shot = |panel: &Panel| Shot { caption: panel.title.clone(), svg: contour.frame(panel) };
    std::thread::scope(|scope| {
        let drawers: Vec<_> =
            contour.panels.iter().map(|panel| scope.spawn(move || shot(panel))).collect();
        drawers.into_iter().filter_map(|drawer| drawer.join().ok()).collect()
    })
}

/// The frame at the largest force.
fn opening(record: &Record) -> usize {
    let peak = record.peak_time();
    let shown = contours::chosen(record, MOST_FRAMES);
    let distance = |k: &usize| (record.frames[shown[*k]].time - peak).abs();
    (0..shown.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

fn subtitle(record: &Record) -> String {
    let name = |body: &Value| body.get("name").and_then(Value::as_str).map(String::from);
    let names: Vec<String> = record.list("bodies").iter().filter_map(name).collect();
    let model = record.summary.get("case").and_then(|case| case.get("model"));
    let model = model.and_then(Value::as_object).and_then(|model| model.keys().next());
    let model = match model.map_or("", String::as_str) {
        "fem" => "explicit finite elements",
        "condensed" => "bodies condensed to their contact",
        "ting" => "Ting's viscoelastic contact",
        "hertz" => "Hertz' contact",
        "law" => "a contact law",
        other => other,
    };
    format!("{}, by {model}", names.join(" and "))
}

/// What the run took.
fn price(record: &Record) -> String {
    let elements: f64 = record
        .list("bodies")
        .iter()
        .filter_map(|body| body.get("elements").and_then(Value::as_f64))
        .sum();
    let seconds = record.number(&["cost", "solve_s"]).unwrap_or(0.0);
    let mut parts = vec![format!("computed in {}", spent(seconds))];
    if elements > 0.0 {
        parts.push(format!("{} elements", grouped(elements)));
    }
    if let Some((steps, step)) = record.number(&["steps"]).zip(record.number(&["time_step_s"])) {
        parts.push(format!("{} steps of {}", grouped(steps), show(step, "s")));
    }
    if let Some(residual) = record.number(&["energy", "residual_relative"]) {
        let residual = cards::power_of_ten(residual);
        parts.push(format!("energy adds up to {residual} of the initial"));
    }
    parts.join(" · ")
}

/// With thin spaces between thousands.
fn grouped(count: f64) -> String {
    let digits = format!("{count:.0}");
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// All but that the run is incomplete, which stands above; as HTML.
fn warnings(record: &Record) -> Vec<String> {
    let stopped = record.text("stopped_because");
    let warnings = record.list("warnings").iter().filter_map(Value::as_str);
    let others = warnings.filter(|warning| stopped.is_empty() || !warning.contains(stopped));
    others.map(with_keys).collect()
}

/// A text as HTML, what stands between backticks as code.
fn with_keys(text: &str) -> String {
    let escaped = fem_figure::escaped(text);
    let mut parts = escaped.split('`').peekable();
    let mut html = String::new();
    let mut is_code = false;
    while let Some(part) = parts.next() {
        match is_code && parts.peek().is_some() {
            true => html += &format!("<code>{part}</code>"),
            // A backtick alone is what it is.
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
    [
        shown("time_s", "s"),
        shown("speed_before_m_s", "m/s"),
        number("restitution").map_or("\u{2013}".into(), |e| format!("{e:.4}")),
        shown("contact_time_s", "s"),
        shown("peak_force_n", "N"),
    ]
}

fn citation(record: &Record) -> String {
    let made_from: String = record.text("made_from").chars().take(12).collect();
    format!(
        "fem-run {}, {}. Result of case {made_from}, numerics {}: \u{201c}{}\u{201d}.",
        record.text("version"),
        env!("CARGO_PKG_REPOSITORY"),
        record.text("numerics"),
        record.title()
    )
}

#[cfg(test)]
mod tests {
    use super::with_keys;

    #[test]
    fn keys_in_warnings_are_code_and_nothing_is_markup() {
        assert_eq!(
            with_keys("a<b & `x = {}` or `y`"),
            "a&lt;b &amp; <code>x = {}</code> or <code>y</code>"
        );
        assert_eq!(with_keys("one ` alone"), "one ` alone");
        assert_eq!(with_keys("`a` and ` alone"), "<code>a</code> and ` alone");
    }
}
