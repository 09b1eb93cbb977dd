//! The results of a study of accuracy for people: the text on stdout, and `accuracy.md`.

use std::fmt::Write;

use comfy_table::CellAlignment::{Left, Right};
use fem::accuracy::{ErrorPart, ObservedOrder, Series};
use fem_case::engineering::show;
use fem_collision::QuantityOfInterest;
use indicatif::HumanCount;

use super::findings::{Findings, Line};
use crate::text::standard_output::one_line;
use crate::text::tables::table;

/// Stands for a missing number.
const NONE: &str = "-";
const SHORT: [&str; 6] = ["e", "T", "F", "approach", "a", "p0"];

/// A table with a heading.
struct Rows {
    heading: &'static str,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Returns the text on stdout: the fastest variants at each accuracy, the sources of error, and what to
/// choose.
pub fn report(findings: &Findings<'_>) -> String {
    let mut text = format!("{}\n", one_line(findings.title));
    let parts = [
        variants(findings, "Most accurate for their time", |line| line.judged.is_on_frontier),
        limits(findings),
        error_parts(findings),
    ];
    for Rows { heading, header, rows } in parts {
        if rows.is_empty() {
            continue;
        }
        let mut alignment = vec![Right; header.len()];
        alignment[0] = Left;
        let rows = std::iter::once(header).chain(rows);
        let _ = writeln!(text, "\n{heading}\n{}", table(&alignment, rows).trim_end());
    }
    for sentence in sentences(findings) {
        let _ = writeln!(text, "\n{sentence}");
    }
    text
}

/// Returns `accuracy.md` with all tables.
pub fn markdown(findings: &Findings<'_>, has_picture: bool) -> String {
    let mut text = format!("# {}\n", one_line(findings.title));
    for sentence in sentences(findings) {
        let _ = writeln!(text, "\n{sentence}");
    }
    if has_picture {
        let _ = writeln!(text, "\n![errors over seconds](accuracy.svg)");
    }
    let parts = [
        limits(findings),
        error_parts(findings),
        orders(findings),
        variants(findings, "All", |_| true),
    ];
    for Rows { heading, header, rows } in parts {
        if rows.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n## {heading}\n\n| {} |", header.join(" | "));
        let _ = writeln!(text, "|{}", " --- |".repeat(header.len()));
        for row in rows {
            let _ = writeln!(text, "| {} |", row.join(" | "));
        }
    }
    let _ = writeln!(
        text,
        "\nErrors are differences from the limit, relative except that of the restitution; a dash marks a number \
         that the model does not compute. Times are medians, with new meshes and factors each time and without \
         writing files. The error of the stress is the root mean square error of σ_yy over the root mean square of σ_yy, at \
         49 places in each body around the contact, at the largest approach."
    );
    text
}

/// Returns errors for a table: absolute for the restitution, in percent for all others.
fn errors(errors: [Option<f64>; 6]) -> impl Iterator<Item = String> {
    QuantityOfInterest::ALL.into_iter().zip(errors).map(|(quantity, error)| own(quantity, error))
}

fn own(quantity: QuantityOfInterest, error: Option<f64>) -> String {
    match (quantity, error) {
        (QuantityOfInterest::Restitution, Some(0.0)) => "0".to_string(),
        (QuantityOfInterest::Restitution, Some(error)) => format!("{error:+.1e}"),
        _ => percent(error),
    }
}

fn percent(error: Option<f64>) -> String {
    error.map_or(NONE.into(), |error| match 100.0 * error {
        percent if percent.abs() >= 10.0 => format!("{percent:+.0} %"),
        percent if percent.abs() >= 0.1 => format!("{percent:+.2} %"),
        percent => format!("{percent:+.3} %"),
    })
}

fn variants(
    findings: &Findings<'_>,
    heading: &'static str,
    is_shown: impl Fn(&Line<'_>) -> bool,
) -> Rows {
    let header = ["", "", "time", "updates"].into_iter().chain(SHORT).chain(["stress"]);
    let row = |line: Line<'_>| {
        let updates = line.measurement.element_updates;
        let mut cells = vec![
            line.variant.series.name().to_string(),
            line.variant.describe(),
            show(line.seconds, "s"),
            updates.map_or(NONE.into(), |n| HumanCount(n).to_string()),
        ];
        cells.extend(errors(line.judged.errors));
        cells.push(line.judged.stress_error.map_or(NONE.into(), |e| format!("{:.1} %", 100.0 * e)));
        cells
    };
    let rows = findings.lines().filter(is_shown).map(row).collect();
    Rows { heading, header: header.map(String::from).collect(), rows }
}

fn limits(findings: &Findings<'_>) -> Rows {
    let rows = QuantityOfInterest::ALL.into_iter().zip(findings.study.limits).filter_map(
        |(quantity, limit)| {
            let limit = limit?;
            let in_unit = |value: f64| match quantity {
                QuantityOfInterest::Restitution => format!("{value:.5}"),
                _ => show(value, quantity.unit()),
            };
            let scale = quantity.scale(limit.value);
            Some(vec![
                quantity.name().to_string(),
                in_unit(limit.value),
                own(quantity, Some(limit.uncertainty / scale)).replacen('+', "±", 1),
                limit.condensed.map_or(NONE.into(), in_unit),
                own(quantity, limit.added.map(|added| added / scale)),
            ])
        },
    );
    let header = ["", "limit", "uncertainty", "condensed", "explicit adds"];
    Rows { heading: "The limit", header: header.map(String::from).into(), rows: rows.collect() }
}

fn error_parts(findings: &Findings<'_>) -> Rows {
    let row = |part: &ErrorPart| {
        let mut cells = vec![part.source.name().to_string()];
        cells.extend(errors(part.errors));
        cells
    };
    let header = std::iter::once("").chain(SHORT).map(String::from).collect();
    let rows = findings.study.parts.iter().map(row).collect();
    Rows { heading: "Sources of error, with eight elements across the contact", header, rows }
}

fn orders(findings: &Findings<'_>) -> Rows {
    let rows = findings.study.orders.iter().map(|(series, orders)| {
        let mut cells = vec![series.name().to_string()];
        let order = |found: &Option<ObservedOrder>| match found {
            Some(found) => format!("{:.1} ± {:.1}", found.order, found.standard_error),
            None => NONE.into(),
        };
        cells.extend(orders.iter().map(order));
        cells
    });
    let header = std::iter::once("").chain(SHORT).map(String::from).collect();
    Rows { heading: "Observed orders in the element size", header, rows: rows.collect() }
}

/// Returns what to choose, and what the study leaves open.
fn sentences(findings: &Findings<'_>) -> Vec<String> {
    let study = findings.study;
    let cheapest = |serves: &dyn Fn(usize) -> bool| {
        let index = study.cheapest_within(findings.variants, findings.measured, serves)?;
        findings.lines().find(|line| line.index == index)
    };
    let told = |line: &Line<'_>| {
        let describe = line.variant.describe();
        let gap = if describe.is_empty() { "" } else { ", " };
        let settings: Vec<String> =
            line.variant.overrides().iter().map(|set| format!("--set '{set}'")).collect();
        let settings = match settings.is_empty() {
            true => String::new(),
            false => format!(" (`{}`)", settings.join(" ")),
        };
        let (name, time) = (line.variant.series.name(), show(line.seconds, "s"));
        format!("{name}{gap}{describe}: {time}{settings}")
    };
    let asked = {
        let accuracy = findings.accuracy;
        let share = |share: f64| format!("{} %", fem_figure::tick(100.0 * share));
        let all = [accuracy.restitution, accuracy.contact_time, accuracy.peak_force];
        match all.iter().all(|other| *other == all[0]) {
            true => format!(
                "{} in e, T and F and {} in the peak pressure",
                share(all[0]),
                share(accuracy.peak_pressure)
            ),
            false => "the tolerances of the case".to_string(),
        }
    };
    let mut sentences = Vec::new();
    match cheapest(&|_| true) {
        Some(line) => sentences.push(format!("Within {asked}: {}.", told(&line))),
        None => sentences.push(format!("No variant that was computed is within {asked}.")),
    }
    // The finest field has no error estimate: it is the reference of all others.
    let allowed = findings.accuracy.peak_pressure;
    let has_fields = |line: &Line<'_>| {
        line.measurement.stress.is_some()
            && line.judged.sure_stress_error.is_none_or(|e| e <= allowed)
    };
    let with_fields = findings.lines().filter(has_fields).map(|line| line.index);
    let with_fields: Vec<usize> = with_fields.collect();
    if let Some(line) = cheapest(&|index| with_fields.contains(&index)) {
        sentences.push(format!(
            "With stress fields, the stress within {} %: {}.",
            fem_figure::tick(100.0 * allowed),
            told(&line)
        ));
    }
    let explicit = cheapest(&|index| findings.variants.all[index].is_explicit());
    if let Some(line) = &explicit {
        sentences.push(format!("With explicit elements: {}.", told(line)));
    }
    let own = findings.lines().find(|line| line.variant.series == Series::AsWritten);
    let is_told = |own: &Line<'_>| explicit.as_ref().is_some_and(|line| line.index == own.index);
    if let Some(own) = own.filter(|own| !is_told(own))
        && let Some(share) = own.judged.in_tolerances
    {
        let goes_on = share > 1.0 && findings.variants.is_open;
        let goes_on = if goes_on { "; a run would refine the mesh" } else { "" };
        sentences.push(format!(
            "The case as written, {}: {}, {share:.2} times the tolerance{goes_on}.",
            own.variant.describe(),
            show(own.seconds, "s")
        ));
    }
    if findings.left_out > 0 {
        sentences.push(format!(
            "{} of {} variants were left out: they would have exceeded the time budget of {}.",
            findings.left_out,
            findings.variants.all.len(),
            show(findings.budget, "s")
        ));
    }
    sentences
}
