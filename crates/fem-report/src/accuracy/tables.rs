//! The results of an accuracy study for readers: tables and sentences on the terminal, and `accuracy.md`.

use std::fmt::Write;

use fem::accuracy::{ObservedOrder, Series, VariantRun};
use fem_case::engineering::{Unit, show};
use fem_collision::QuantityOfInterest;

use super::AccuracyResult;
use crate::number_text::{grouped, one_line};

/// The text for a missing number.
const NONE: &str = "-";
/// Column heads of the quantities of interest.
const SYMBOLS: [&str; 6] = ["e", "T", "F", "approach", "a", "p0"];

/// A table with a heading.
pub struct AccuracyTable {
    /// Heading of the table.
    pub heading: &'static str,
    /// The column heads, and then the rows; the first column is text.
    pub rows: Vec<Vec<String>>,
}

impl AccuracyTable {
    fn new<'h>(
        heading: &'static str,
        header: impl IntoIterator<Item = &'h str>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        let header = header.into_iter().map(String::from).collect();
        Self { heading, rows: std::iter::once(header).chain(rows).collect() }
    }
}

/// Returns the tables on the terminal: the fastest variants at each accuracy and, if all is wanted, limits and sources of error.
/// A short one has the errors of restitution, contact time, force and stress of a few variants.
pub fn terminal_tables(result: &AccuracyResult<'_>, is_whole: bool) -> Vec<AccuracyTable> {
    /// Rows of a short table, with its heads.
    const SHORT: usize = 10;
    let heading = "Most accurate for their computing time";
    let mut fastest = variants(result, heading, |run| run.errors.is_on_frontier);
    let is_shown = |head: &str| match is_whole {
        true => head != "updates",
        false => ["variant", "time", "e", "T", "F", "stress"].contains(&head),
    };
    let heads = fastest.rows[0].clone();
    for row in &mut fastest.rows {
        let mut shown = heads.iter().map(|head| is_shown(head));
        row.retain(|_| shown.next().unwrap_or_default());
    }
    match is_whole {
        true => with_rows([fastest, limits(result), error_parts(result)]),
        false => {
            fastest.rows.truncate(SHORT);
            with_rows([fastest])
        }
    }
}

fn with_rows(tables: impl IntoIterator<Item = AccuracyTable>) -> Vec<AccuracyTable> {
    tables.into_iter().filter(|table| table.rows.len() > 1).collect()
}

/// Returns `accuracy.md` with all tables.
pub fn markdown(result: &AccuracyResult<'_>, has_figure: bool) -> String {
    let mut text = format!("# {}\n", one_line(result.title));
    for Advice { sentence, overrides } in advice(result) {
        let _ = write!(text, "\n{sentence}");
        let _ = match overrides.is_empty() {
            true => writeln!(text),
            false => writeln!(text, " (`{}`)", overrides.join(" ")),
        };
    }
    if has_figure {
        let _ = writeln!(text, "\n![errors over seconds](accuracy.svg)");
    }
    let all = variants(result, "All", |_| true);
    for table in with_rows([limits(result), error_parts(result), orders(result), all]) {
        let _ = writeln!(text, "\n## {}\n", table.heading);
        for (k, row) in table.rows.iter().enumerate() {
            let _ = writeln!(text, "| {} |", row.join(" | "));
            if k == 0 {
                let _ = writeln!(text, "|{}", " --- |".repeat(row.len()));
            }
        }
    }
    text + "\nErrors are differences from the limit, relative except that of the restitution; a dash marks a number \
            that the model does not compute. Times are medians, with new meshes and factors each time and without \
            writing files. The error of the stress is the root mean square error of σ_yy over the root mean square of \
            σ_yy, at 49 places in each body around the contact, at the largest approach.\n"
}

/// Returns an error for a table: absolute for the restitution, in percent for all others.
fn error_text(quantity: QuantityOfInterest, error: Option<f64>) -> String {
    match (quantity, error.map(|error| 100.0 * error)) {
        (_, None) => NONE.into(),
        (QuantityOfInterest::Restitution, Some(0.0)) => "0".to_string(),
        (QuantityOfInterest::Restitution, _) => format!("{:+.1e}", error.unwrap_or_default()),
        (_, Some(percent)) if percent.abs() >= 10.0 => format!("{percent:+.0} %"),
        (_, Some(percent)) if percent.abs() >= 0.1 => format!("{percent:+.2} %"),
        (_, Some(percent)) => format!("{percent:+.3} %"),
    }
}

fn errors(errors: [Option<f64>; 6]) -> impl Iterator<Item = String> {
    let pairs = QuantityOfInterest::ALL.into_iter().zip(errors);
    pairs.map(|(quantity, error)| error_text(quantity, error))
}

fn variants(
    result: &AccuracyResult<'_>,
    heading: &'static str,
    is_shown: impl Fn(&VariantRun<'_>) -> bool,
) -> AccuracyTable {
    let row = |run: &VariantRun<'_>| {
        let updates = run.measurement.element_updates;
        let mut cells = vec![
            described(run),
            Unit::fitting(run.seconds, "s").with_digits(3).show(run.seconds),
            updates.map_or(NONE.into(), |n| grouped(n as f64, ',')),
        ];
        cells.extend(errors(run.errors.signed));
        cells.push(run.errors.stress.map_or(NONE.into(), |e| format!("{:.1} %", 100.0 * e)));
        cells
    };
    let header = ["variant", "time", "updates"].into_iter().chain(SYMBOLS).chain(["stress"]);
    let shown = result.study.runs.iter().filter(|run| is_shown(run));
    AccuracyTable::new(heading, header, shown.map(row))
}

fn limits(result: &AccuracyResult<'_>) -> AccuracyTable {
    let limits = QuantityOfInterest::ALL.into_iter().zip(result.study.limits);
    let rows = limits.filter_map(|(quantity, limit)| {
        let limit = limit?;
        let in_unit = |value: f64| match quantity {
            QuantityOfInterest::Restitution => format!("{value:.5}"),
            _ => show(value, quantity.unit()),
        };
        let scale = quantity.scale(limit.value);
        Some(vec![
            quantity.name().to_string(),
            in_unit(limit.value),
            error_text(quantity, Some(limit.uncertainty / scale)).replacen('+', "±", 1),
            limit.condensed.map_or(NONE.into(), in_unit),
            error_text(quantity, limit.added.map(|added| added / scale)),
        ])
    });
    AccuracyTable::new(
        "The limit",
        ["", "limit", "uncertainty", "condensed", "explicit − condensed"],
        rows,
    )
}

fn error_parts(result: &AccuracyResult<'_>) -> AccuracyTable {
    let parts = result.study.parts.iter();
    let rows = parts.map(|part| {
        std::iter::once(part.source.name().to_string()).chain(errors(part.errors)).collect()
    });
    let heading = "Sources of error, with eight elements across the contact radius";
    AccuracyTable::new(heading, std::iter::once("").chain(SYMBOLS), rows)
}

fn orders(result: &AccuracyResult<'_>) -> AccuracyTable {
    let order = |found: &Option<ObservedOrder>| match found {
        Some(found) => format!("{:.1} ± {:.1}", found.order, found.standard_error),
        None => NONE.into(),
    };
    let rows = result.study.orders.iter().map(|(series, orders)| {
        std::iter::once(series.name().to_string()).chain(orders.iter().map(order)).collect()
    });
    let heading = "Observed orders in the element size";
    AccuracyTable::new(heading, std::iter::once("").chain(SYMBOLS), rows)
}

/// A sentence of a study, with the options that follow from it.
pub struct Advice {
    /// A whole sentence.
    pub sentence: String,
    /// The options that choose the variant of the sentence: `--set 'model.ting={}'`.
    pub overrides: Vec<String>,
}

impl From<String> for Advice {
    fn from(sentence: String) -> Self {
        Self { sentence, overrides: Vec::new() }
    }
}

/// Returns which variants to choose, and what the study leaves open.
pub fn advice(result: &AccuracyResult<'_>) -> Vec<Advice> {
    let AccuracyResult { study, accuracy, variants, left_out, .. } = result;
    let share = |share: f64| format!("{} %", fem_figure::tick(100.0 * share));
    let three = [accuracy.restitution, accuracy.contact_time, accuracy.peak_force];
    let asked = match three.iter().all(|other| *other == three[0]) {
        true => format!(
            "{} in e, T and F and {} in the peak pressure",
            share(three[0]),
            share(accuracy.peak_pressure)
        ),
        false => "the tolerances of the case".to_string(),
    };
    let mut found = vec![match study.cheapest_within(|_| true) {
        Some(run) => choice(&format!("Within {asked}"), run),
        None => format!("No variant that was computed is within {asked}.").into(),
    }];
    // The finest field has no error estimate: it is the reference of all others.
    let with_fields = study.cheapest_within(|run| {
        let error = run.errors.monotone_stress;
        run.measurement.stress.is_some() && error.is_none_or(|e| e <= accuracy.peak_pressure)
    });
    if let Some(run) = with_fields {
        let tolerance = share(accuracy.peak_pressure);
        found.push(choice(&format!("With stress fields, the stress within {tolerance}"), run));
    }
    let explicit = study.cheapest_within(|run| run.variant.is_explicit());
    found.extend(explicit.map(|run| choice("With explicit elements", run)));
    let own = study.runs.iter().find(|run| run.variant.series == Series::AsWritten);
    let is_named = explicit.is_some_and(|run| run.variant.series == Series::AsWritten);
    if let Some(own) = own.filter(|_| !is_named)
        && let Some(share) = own.errors.in_tolerances
    {
        let is_refined = share > 1.0 && variants.is_open;
        let sentence = format!(
            "The case as written, {}: {}, {share:.2} times the tolerance{}.",
            own.variant.describe(),
            show(own.seconds, "s"),
            if is_refined { "; a run would refine the mesh" } else { "" }
        );
        found.push(sentence.into());
    }
    if *left_out > 0 {
        let sentence = format!(
            "{left_out} of {} variants were left out: they would have exceeded the time budget of {}.",
            variants.all.len(),
            show(result.budget, "s")
        );
        found.push(sentence.into());
    }
    found
}

/// Returns a variant with its run time, after words that say what it is chosen for.
fn choice(purpose: &str, run: &VariantRun<'_>) -> Advice {
    let sentence = format!("{purpose}: {}: {}.", described(run), show(run.seconds, "s"));
    let overrides = run.variant.overrides().iter().map(|set| format!("--set '{set}'")).collect();
    Advice { sentence, overrides }
}

/// Returns the name of a variant with its settings.
fn described(run: &VariantRun<'_>) -> String {
    let (name, settings) = (run.variant.series.name(), run.variant.describe());
    let gap = if settings.is_empty() { "" } else { ", " };
    format!("{name}{gap}{settings}")
}
