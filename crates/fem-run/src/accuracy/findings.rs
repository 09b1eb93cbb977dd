//! The results of a study of accuracy for programs: `accuracy.csv` and `accuracy.json`.

use fem::accuracy::{Measurement, Study, Variant, VariantErrors, Variants};
use fem_case::{Accuracy, CaseFile};
use fem_collision::QuantityOfInterest;
use serde_json::{Value, json as object};

use crate::result_folder::command_output::CommandOutput;
use crate::text::failure::Failure;

/// The results of a study.
pub struct Findings<'a> {
    /// The title of the case.
    pub title: &'a str,
    /// The case with all defaults filled in.
    pub default: CaseFile,
    /// The tolerances of the case.
    pub accuracy: Accuracy,
    /// The variants that were run.
    pub variants: &'a Variants,
    /// Result and run time of each variant.
    pub measured: &'a [Option<(Measurement, f64)>],
    /// The evaluation of the results.
    pub study: &'a Study,
    /// Number of variants left out for lack of time.
    pub left_out: usize,
    /// The time budget, s.
    pub budget: f64,
}

/// A variant that ran.
pub struct Line<'a> {
    /// Its index among the variants.
    pub index: usize,
    /// The setting of the variant.
    pub variant: &'a Variant,
    /// Its numbers.
    pub measurement: &'a Measurement,
    /// Its run time, s.
    pub seconds: f64,
    /// Its errors and whether they are small enough.
    pub judged: VariantErrors,
}

impl Findings<'_> {
    /// Returns the variants that ran, in order.
    pub fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let variants = self.variants.all.iter().zip(self.measured).enumerate();
        variants.filter_map(|(index, (variant, measured))| {
            let (measurement, seconds) = measured.as_ref()?;
            let judged = self.study.judged[index]?;
            Some(Line { index, variant, measurement, seconds: *seconds, judged })
        })
    }
}

/// Writes `accuracy.csv`, one row per variant. Errors are relative except that of the restitution; settings
/// are written as for `--set`.
///
/// # Errors
/// The file system.
pub fn write_csv(output: &mut CommandOutput, findings: &Findings<'_>) -> Result<(), Failure> {
    let failed =
        |error: csv::Error| Failure::failed(format!("accuracy.csv cannot be written: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header: Vec<String> =
        ["series", "settings", "elements_across", "elements", "steps", "element_updates"]
            .map(String::from)
            .into();
    header.extend(["memory_bytes", "seconds"].map(String::from));
    header.extend(QuantityOfInterest::ALL.map(|quantity| quantity.key().to_string()));
    header.extend(QuantityOfInterest::ALL.map(|quantity| format!("{}_error", error_key(quantity))));
    header.extend(
        ["stress_error", "worst_error", "in_tolerances", "is_on_frontier"].map(String::from),
    );
    writer.write_record(&header).map_err(failed)?;
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
    let count = |value: Option<u64>| value.map_or(String::new(), |value| value.to_string());
    for line in findings.lines() {
        let Line { variant, measurement, judged, .. } = &line;
        let mut cells = vec![
            variant.series.name().to_string(),
            variant.overrides().join(" "),
            number(variant.elements_across),
            count(Some(measurement.elements).filter(|n| *n > 0)),
            count(measurement.steps),
            count(measurement.element_updates),
            count(measurement.memory),
            number(Some(line.seconds)),
        ];
        cells.extend(measurement.values.map(number));
        cells.extend(judged.errors.map(number));
        cells.extend([judged.stress_error, judged.worst, judged.in_tolerances].map(number));
        cells.push(judged.is_on_frontier.to_string());
        writer.write_record(&cells).map_err(failed)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| Failure::failed(format!("accuracy.csv cannot be written: {error}")))?;
    output.write("accuracy.csv", bytes)
}

/// Returns the key of an error, which has no unit.
fn error_key(quantity: QuantityOfInterest) -> String {
    quantity.name().replace(' ', "_")
}

/// Returns `accuracy.json`: limits, orders and sources of error.
pub fn json(findings: &Findings<'_>) -> Value {
    let by_name = |values: [Option<f64>; 6]| -> Value {
        let pairs = QuantityOfInterest::ALL.into_iter().zip(values);
        pairs.map(|(quantity, value)| (error_key(quantity), object!(value))).collect()
    };
    let limits: Value = QuantityOfInterest::ALL
        .into_iter()
        .zip(findings.study.limits)
        .map(|(quantity, limit)| {
            let limit = limit.map(|limit| {
                object!({ "value": limit.value, "uncertainty": limit.uncertainty,
                    "condensed": limit.condensed, "explicit_adds": limit.added })
            });
            (quantity.key().to_string(), object!(limit))
        })
        .collect();
    let orders = findings.study.orders.iter();
    let orders = orders.map(|(series, orders)| {
        (series.name().to_string(), by_name(orders.map(|found| Some(found?.order))))
    });
    let parts = findings.study.parts.iter();
    let parts = parts.map(|part| (part.source.name().to_string(), by_name(part.errors)));
    object!({
        "title": findings.title,
        "rungs": findings.variants.all.len(),
        "left_out": findings.left_out,
        "budget_s": findings.budget,
        "limits": limits,
        "orders": orders.collect::<Value>(),
        "error_parts": parts.collect::<Value>(),
        "case": findings.default,
    })
}
