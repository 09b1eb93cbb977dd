//! The results of an accuracy study: `accuracy.csv`, `accuracy.json`, `accuracy.md`, `accuracy.svg` and the text
//! on the terminal.

mod figure;
mod tables;

use fem::accuracy::{Study, VariantRun, Variants};
use fem_case::{Accuracy, CaseFile};
use fem_collision::QuantityOfInterest;
use serde_json::{Value, json as object};

pub use figure::figure;
pub use tables::{AccuracyTable, Advice, advice, markdown, terminal_tables};

/// An accuracy study of a case.
pub struct AccuracyResult<'a> {
    /// The title of the case.
    pub title: &'a str,
    /// The case with all defaults filled in.
    pub case: CaseFile,
    /// The tolerances of the case.
    pub accuracy: Accuracy,
    /// The variants of the case.
    pub variants: &'a Variants,
    /// The comparison of the results.
    pub study: &'a Study<'a>,
    /// Number of variants left out for lack of time.
    pub left_out: usize,
    /// The time budget, s.
    pub budget: f64,
}

/// Returns `accuracy.csv`, one row per variant. Errors are relative except that of the restitution; settings
/// are written as for `--set`.
pub fn csv(result: &AccuracyResult<'_>) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let counts = ["series", "settings", "elements_across", "elements", "steps", "element_updates"];
    let header = counts.into_iter().chain(["memory_bytes", "seconds"]).map(String::from);
    let values = QuantityOfInterest::ALL.map(|quantity| quantity.key().to_string());
    let errors = QuantityOfInterest::ALL.map(|quantity| format!("{}_error", error_key(quantity)));
    let last = ["stress_error", "worst_error", "in_tolerances", "is_on_frontier"];
    writer.write_record(header.chain(values).chain(errors).chain(last.map(String::from)))?;
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
    let count = |value: Option<u64>| value.map_or(String::new(), |value| value.to_string());
    for VariantRun { variant, measurement, seconds, errors } in &result.study.runs {
        let mut cells = vec![
            variant.series.name().to_string(),
            variant.overrides().join(" "),
            number(variant.elements_across),
            count(Some(measurement.elements).filter(|n| *n > 0)),
            count(measurement.steps),
            count(measurement.element_updates),
            count(measurement.memory),
            number(Some(*seconds)),
        ];
        cells.extend(measurement.values.into_iter().chain(errors.signed).map(number));
        cells.extend([errors.stress, errors.worst, errors.in_tolerances].map(number));
        cells.push(errors.is_on_frontier.to_string());
        writer.write_record(&cells)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

/// Returns the key of an error, which has no unit.
fn error_key(quantity: QuantityOfInterest) -> String {
    quantity.name().replace(' ', "_")
}

/// Returns `accuracy.json`: limits, orders and sources of error.
pub fn json(result: &AccuracyResult<'_>) -> Value {
    let Study { limits, orders, parts, .. } = result.study;
    let quantities = QuantityOfInterest::ALL.into_iter();
    let by_name = |values: [Option<f64>; 6]| -> Value {
        let pairs = QuantityOfInterest::ALL.into_iter().zip(values);
        pairs.map(|(quantity, value)| (error_key(quantity), object!(value))).collect()
    };
    let limit = |limit: fem::accuracy::Limit| {
        object!({ "value": limit.value, "uncertainty": limit.uncertainty,
            "condensed": limit.condensed, "explicit_adds": limit.added })
    };
    let limits = quantities.zip(limits);
    let limits = limits.map(|(quantity, of)| (quantity.key().to_string(), object!(of.map(limit))));
    let orders = orders.iter().map(|(series, orders)| {
        (series.name().to_string(), by_name(orders.map(|found| Some(found?.order))))
    });
    let parts = parts.iter().map(|part| (part.source.name().to_string(), by_name(part.errors)));
    object!({
        "title": result.title,
        "rungs": result.variants.all.len(),
        "left_out": result.left_out,
        "budget_s": result.budget,
        "limits": limits.collect::<Value>(),
        "orders": orders.collect::<Value>(),
        "error_parts": parts.collect::<Value>(),
        "case": result.case,
    })
}
