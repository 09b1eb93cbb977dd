//! The comparison of several results on one page.

use askama::Template;
use fem::results::{Parts, Status};
use fem_collision::QuantityOfInterest;
use fem_figure::contour::Contour;
use serde_json::Value;

use super::case_keys::differences;
use super::contours::contours_at_peak;
use super::history_charts::{Quantity, history_chart, normalised_chart};
use super::pressure_chart::pressure_chart;
use super::shared_error::SharedErrors;
use super::stored_result::{ReportError, StoredResult};
use super::{FilmFrame, cards, citation, drawn, film};
use crate::answer::{answer, error_scale};

/// Tables of the case that describe the scene; all others say how it is computed and what is kept.
const SCENE_TABLES: [&str; 6] = ["material", "body", "start", "model", "gravity", "stop"];

/// Most results that get a column each; more get a row each.
const MAX_COLUMNS: usize = 3;

/// From this ratio on, a difference is written as a multiple.
const MULTIPLE: f64 = 3.0;

#[derive(Template)]
#[template(path = "comparison.html")]
struct Comparison {
    names: Vec<String>,
    titles: Vec<String>,
    charts: Vec<String>,
    /// What the judgement of the differences leaves out.
    shared: String,
    /// Stresses at the peak force, one frame per result.
    frames: Vec<ScaledFrame>,
    dark_rules: String,
    /// Column heads of the table of numbers, and its rows.
    heads: Vec<String>,
    numbers: Vec<(String, Vec<Cell>)>,
    /// Differing keys of the scene, and of the computation.
    differences: [Vec<(String, Vec<String>)>; 2],
    cite: Vec<String>,
}

/// A picture with the colour scale that it has with others.
struct ScaledFrame {
    frame: FilmFrame,
    bar: String,
    /// Index of the scale.
    scale: usize,
}

fn scaled_frames((scale, contour): (usize, &Contour)) -> Vec<ScaledFrame> {
    let scaled = |frame| ScaledFrame { frame, bar: contour.bar(), scale };
    film(contour).into_iter().map(scaled).collect()
}

/// Returns the colours of a scale on a dark page.
fn scoped_rules((scale, contour): (usize, &Contour)) -> String {
    contour.dark_rules().replace('.', &format!(".scale{scale} ."))
}

/// A number of a result.
struct Cell {
    value: String,
    /// Difference from the first result.
    difference: String,
}

/// Returns the page that compares several results, as HTML.
pub fn comparison_page(results: &[StoredResult]) -> Result<String, ReportError> {
    let charts = Quantity::ALL.map(|quantity| history_chart(results, quantity));
    let charts = charts.into_iter().chain([pressure_chart(results), normalised_chart(results)]);
    let stresses = contours_at_peak(results);
    let cases: Vec<&Value> = results.iter().map(|result| &result.summary["case"]).collect();
    let is_of_scene = |(path, _): &(String, Vec<String>)| {
        SCENE_TABLES.contains(&path.split('.').next().unwrap_or_default())
    };
    // Titles are shown at the top.
    let differences = differences(&cases).into_iter().filter(|(path, _)| path != "title");
    let (of_scene, of_numbers) = differences.partition(is_of_scene);
    let mut cite: Vec<String> = results.iter().map(citation).collect();
    cite.dedup();
    let names: Vec<String> = results.iter().map(|result| result.name.clone()).collect();
    let numbers =
        QuantityOfInterest::ALL.iter().map(|quantity| numbers(results, *quantity)).collect();
    let (heads, numbers) = match results.len() {
        0..=MAX_COLUMNS => (names.clone(), numbers),
        _ => transposed(&names, numbers),
    };
    let page = Comparison {
        names,
        titles: results.iter().map(StoredResult::title).collect(),
        charts: drawn(charts),
        shared: shared_text(results),
        frames: stresses.iter().enumerate().flat_map(scaled_frames).collect(),
        dark_rules: stresses.iter().enumerate().map(scoped_rules).collect(),
        heads,
        numbers,
        differences: [of_scene, of_numbers],
        cite,
    };
    Ok(page.render()?)
}

/// Transposes a table whose columns have these names.
fn transposed(
    names: &[String],
    rows: Vec<(String, Vec<Cell>)>,
) -> (Vec<String>, Vec<(String, Vec<Cell>)>) {
    let mut transposed: Vec<_> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    let mut heads = Vec::new();
    for (head, cells) in rows {
        heads.push(head);
        transposed.iter_mut().zip(cells).for_each(|(row, cell)| row.1.push(cell));
    }
    (heads, transposed)
}

/// Returns the row of a quantity: its value with error for each result, and its difference from the first.
fn numbers(results: &[StoredResult], quantity: QuantityOfInterest) -> (String, Vec<Cell>) {
    let of = |result: &StoredResult| {
        let value = result.number(&[quantity.key()])?;
        Some((value, result.error_parts(quantity)))
    };
    let first = results.first().and_then(of);
    let cell = |(k, result): (usize, &StoredResult)| {
        let (value, difference) = match of(result) {
            None => ("\u{2013}".to_string(), String::new()),
            Some(own) => {
                let difference = first.filter(|_| k > 0).map(|from| {
                    let shared = SharedErrors::of(result, &results[0]);
                    difference_text(own, from, quantity, shared)
                });
                let value = answer(&result.summary, quantity).unwrap_or_default();
                (value, difference.unwrap_or_default())
            }
        };
        Cell { value, difference }
    };
    let name = match results.iter().map(|result| cards::name(result, quantity)).reduce(|a, b| {
        // One may be nominal and another true.
        if a == b { a } else { quantity.name().to_string() }
    }) {
        Some(name) => name,
        None => quantity.name().to_string(),
    };
    (name, results.iter().enumerate().map(cell).collect())
}

/// Returns the difference from the first result, absolute for the restitution and relative for all others,
/// and whether it is within the error bars, as far as the results do not share them. Bars above half of a value judge no
/// difference, and a bound has none.
fn difference_text(
    own: (f64, Parts),
    from: (f64, Parts),
    quantity: QuantityOfInterest,
    shared: SharedErrors,
) -> String {
    let is_computed = |it: &(f64, Parts)| Status::of(Some(it.0), it.1.model) == Status::Computed;
    if !(is_computed(&own) && is_computed(&from)) {
        return "\u{2013}".to_string();
    }
    let difference = own.0 - from.0;
    if difference == 0.0 {
        return "the same".to_string();
    }
    let size = match quantity {
        QuantityOfInterest::Restitution => format!("{difference:+.5}"),
        _ if own.0 > MULTIPLE * from.0 && from.0 > 0.0 => format!("\u{d7} {:.3}", own.0 / from.0),
        _ => format!("{:+.2} %", 100.0 * difference / from.0),
    };
    let bars = shared.of_difference(own, from, quantity);
    let judges = |bars: &f64| *bars < 0.5 * error_scale(from.0, quantity);
    let within = match bars {
        Some(bars) if !judges(&bars) => ", error bars too wide to judge",
        Some(bars) if difference.abs() < bars => ", within the error bars",
        _ => "",
    };
    format!("{size}{within}").replace('-', "\u{2212}")
}

/// Returns which errors the results share with the first, in a sentence.
fn shared_text(results: &[StoredResult]) -> String {
    let Some((first, others)) = results.split_first() else { return String::new() };
    let shared: Vec<_> = others.iter().map(|other| SharedErrors::of(other, first)).collect();
    let part = |is_shared: &dyn Fn(&SharedErrors) -> bool, text: &str| {
        let n = shared.iter().filter(|one| is_shared(one)).count();
        let whom = if n == shared.len() { "All results have" } else { "Some results have" };
        (n > 0).then(|| format!(" {whom} {text} as the first."))
    };
    let parts = [
        part(&|one| one.discretisation, "the same mesh and settings"),
        part(&|one| one.model, "the same model and neglect the same effects"),
    ];
    let text: String = parts.into_iter().flatten().collect();
    match text.is_empty() {
        true => text,
        false => {
            format!(
                "{text} Such errors cancel in a difference but for half of the smaller one. The errors by uncertain \
                 inputs of both count in full."
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bound has no difference from a number nor from a bound, and a value that is hardly known judges none.
    #[test]
    fn bounds_and_wide_bars_judge_no_difference() {
        let parts = |discretisation, model| Parts {
            discretisation: Some(discretisation),
            model,
            ..Parts::default()
        };
        let apart = |own, from| {
            let shared = SharedErrors::default();
            difference_text((45e-6, own), (46e-6, from), QuantityOfInterest::ContactTime, shared)
        };
        let (number, bound) = (parts(1e-6, Some(0.0)), parts(1e-6, None));
        assert!(apart(number, number).contains("within the error bars"));
        for (own, from) in [(number, bound), (bound, number), (bound, bound)] {
            assert_eq!(apart(own, from), "\u{2013}");
        }
        let wide = parts(30e-6, Some(0.0));
        assert!(apart(wide, wide).contains("too wide"));
    }
}
