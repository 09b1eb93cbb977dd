//! Several results beside each other.

use askama::Template;
use fem::results::Parts;
use fem_case::engineering::{Unit, show};
use fem_collision::Headline;
use serde_json::Value;

use super::case_text::differences;
use super::curves::{Quantity, over_time};
use super::profile::pressures;
use super::record::Record;
use super::{cards, citation, drawn};
use crate::failure::Failure;

/// What makes cases different ones; all else is how they are computed and what is kept of them.
const OF_THE_SCENE: [&str; 6] = ["material", "body", "start", "model", "gravity", "stop"];

/// Of more results the numbers have a row each, which a page is wide enough for.
const MOST_COLUMNS: usize = 3;

/// More than so much of another number is told as a multiple of it.
const MANIFOLD: f64 = 3.0;

#[derive(Template)]
#[template(path = "comparison.html")]
struct Comparison {
    names: Vec<String>,
    titles: Vec<String>,
    charts: Vec<String>,
    /// Above the columns of the numbers, and their rows.
    heads: Vec<String>,
    numbers: Vec<(String, Vec<Cell>)>,
    /// Keys of the scene, and of how it is computed.
    differences: [Vec<(String, Vec<String>)>; 2],
    cite: Vec<String>,
}

/// A number of a result.
struct Cell {
    value: String,
    /// What it differs by from that of the first result.
    difference: String,
}

/// The page of several results.
///
/// # Errors
/// None that depend on the results.
pub fn comparison(records: &[Record]) -> Result<String, Failure> {
    let charts = Quantity::ALL.map(|quantity| over_time(records, quantity));
    let charts = charts.into_iter().chain([pressures(records)]);
    let cases: Vec<&Value> = records.iter().map(|record| &record.summary["case"]).collect();
    let is_of_scene = |(path, _): &(String, Vec<String>)| {
        OF_THE_SCENE.contains(&path.split('.').next().unwrap_or_default())
    };
    // Titles stand above.
    let differences = differences(&cases).into_iter().filter(|(path, _)| path != "title");
    let (of_scene, of_numbers) = differences.partition(is_of_scene);
    let mut cite: Vec<String> = records.iter().map(citation).collect();
    cite.dedup();
    let names: Vec<String> = records.iter().map(|record| record.name.clone()).collect();
    let numbers = Headline::ALL.iter().map(|headline| numbers(records, *headline)).collect();
    let (heads, numbers) = match records.len() {
        0..=MOST_COLUMNS => (names.clone(), numbers),
        _ => turned(&names, numbers),
    };
    let page = Comparison {
        names,
        titles: records.iter().map(Record::title).collect(),
        charts: drawn(charts),
        heads,
        numbers,
        differences: [of_scene, of_numbers],
        cite,
    };
    page.render().map_err(|error| Failure::failed(format!("the page cannot be made: {error}")))
}

/// Heads and rows of a table whose columns had these names, its rows as columns.
fn turned(
    names: &[String],
    rows: Vec<(String, Vec<Cell>)>,
) -> (Vec<String>, Vec<(String, Vec<Cell>)>) {
    let mut turned: Vec<_> = names.iter().map(|name| (name.clone(), Vec::new())).collect();
    let mut heads = Vec::new();
    for (head, cells) in rows {
        heads.push(head);
        turned.iter_mut().zip(cells).for_each(|(row, cell)| row.1.push(cell));
    }
    (heads, turned)
}

/// A number of all results with its error, each with its difference from the first.
fn numbers(records: &[Record], headline: Headline) -> (String, Vec<Cell>) {
    let of = |record: &Record| {
        let value = record.number(&[headline.key()])?;
        Some((value, record.parts(headline)))
    };
    let first = records.first().and_then(of);
    let cell = |(k, record): (usize, &Record)| {
        let (value, difference) = match of(record) {
            None => ("\u{2013}".to_string(), String::new()),
            Some(own) => {
                let from = first.filter(|_| k > 0);
                (
                    shown(own, headline),
                    from.map_or(String::new(), |from| apart(own, from, headline)),
                )
            }
        };
        Cell { value, difference }
    };
    let name = match records.iter().map(|record| cards::name(record, headline)).reduce(|a, b| {
        // Nominal of one and true of another: each is what it is.
        if a == b { a } else { headline.name().to_string() }
    }) {
        Some(name) => name,
        None => headline.name().to_string(),
    };
    (name, records.iter().enumerate().map(cell).collect())
}

/// `62.46 ± 0.21 µs`; `62.46 µs, error at least 0.21 µs` where more than that is not known.
fn shown((value, parts): (f64, Parts), headline: Headline) -> String {
    let is_seen = |error: &f64| *error > cards::SEEN * cards::whole(value, headline);
    let error = parts.sum().filter(is_seen);
    let number = match headline.unit() {
        "" => match error {
            None => format!("{value:.5}"),
            error => cards::with_error(value, error),
        },
        si => match error {
            None => show(value, si),
            error => {
                let unit = Unit::fitting(value, si);
                let error = error.map(|error| unit.scaled(error));
                format!("{} {}", cards::with_error(unit.scaled(value), error), unit.symbol())
            }
        },
    };
    match (parts.sum(), parts.known().filter(is_seen)) {
        (Some(_), _) => number,
        (None, None) => format!("{number}, error not known"),
        (None, Some(known)) if headline.unit().is_empty() => {
            format!("{number}, error at least {}", cards::rounded(known))
        }
        (None, Some(known)) => {
            let unit = Unit::fitting(value, headline.unit());
            let known = cards::rounded(unit.scaled(known));
            format!("{number}, error at least {known} {}", unit.symbol())
        }
    }
}

/// A difference of restitutions as it is, of all else as a share; and whether the error bars tell it.
fn apart(own: (f64, Parts), from: (f64, Parts), headline: Headline) -> String {
    let difference = own.0 - from.0;
    if difference == 0.0 {
        return "the same".to_string();
    }
    let size = match headline {
        Headline::Restitution => format!("{difference:+.5}"),
        _ if own.0 > MANIFOLD * from.0 && from.0 > 0.0 => format!("\u{d7} {:.3}", own.0 / from.0),
        _ => format!("{:+.2} %", 100.0 * difference / from.0),
    };
    let bars = own.1.sum().zip(from.1.sum()).map(|(a, b)| a + b);
    let within =
        if bars.is_some_and(|bars| difference.abs() < bars) { ", within the bars" } else { "" };
    format!("{size}{within}").replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of what is not known whole there is no ±, and no difference that bars tell.
    #[test]
    fn an_error_that_is_not_known_whole_is_no_bar() {
        let parts = |discretisation, model, model_at_least| Parts {
            discretisation: Some(discretisation),
            model,
            model_at_least,
        };
        let time = |parts| shown((45.607e-6, parts), Headline::ContactTime);
        assert_eq!(time(parts(1e-6, Some(0.9e-6), None)), "45.6 ± 1.9 µs");
        assert_eq!(time(parts(1.6e-7, None, Some(1.74e-6))), "45.61 µs, error at least 1.9 µs");
        assert_eq!(time(parts(4.6e-13, None, None)), "45.61 µs, error not known");
        let restitution = shown((0.99279, parts(5e-4, None, None)), Headline::Restitution);
        assert_eq!(restitution, "0.99279, error at least 0.0005");
        let apart = |parts| apart((45e-6, parts), (46e-6, parts), Headline::ContactTime);
        assert!(apart(parts(1e-6, Some(0.0), None)).contains("within the bars"));
        assert!(!apart(parts(1e-6, None, None)).contains("within the bars"));
    }
}
