//! The files of the program: the page, its table and its pictures.

use std::fs;
use std::path::Path;

use fem::results::{PROGRAM, SUMMARY_FILE};
use fem_command::Failure;
use fem_validate::{ClaimResult, page};
use serde_json::json;

pub const PAGE_FILE: &str = "index.html";
/// The table, one row per check.
const TABLE_FILE: &str = "checks.csv";
/// Identifies the result; results of other claims may be replaced.
pub const MADE_FROM: &str = "validate";
const VERSION: &str = env!("CARGO_PKG_VERSION");

pub fn write_files(folder: &Path, results: &[ClaimResult], n_all: usize) -> Result<(), Failure> {
    let fault = |error: &dyn std::error::Error| {
        Failure::failed(format!("the page cannot be written: {error}"))
    };
    let mut files =
        vec![(PAGE_FILE.to_string(), page(results, n_all, VERSION).map_err(|e| fault(&e))?)];
    files.push((TABLE_FILE.into(), table(results).map_err(|error| fault(&error))?));
    for result in results {
        for figure in &result.findings.figures {
            let name = format!("{}_{}.svg", result.claim.name, figure.name);
            files.push((name, figure.svg.clone()));
        }
    }
    let names: Vec<&str> =
        files.iter().map(|(name, _)| name.as_str()).chain([SUMMARY_FILE]).collect();
    let claims: Vec<_> = results
        .iter()
        .map(|result| {
            json!({
                "claim": result.claim.name,
                "passed": result.passed(),
                "error": result.error.as_ref().map(ToString::to_string),
                "runs": result.cost.runs,
                "element_updates": result.cost.element_updates,
                "seconds": result.cost.seconds,
            })
        })
        .collect();
    let summary = json!({
        "program": PROGRAM,
        "version": VERSION,
        "made_from": MADE_FROM,
        "files": names,
        "complete": results.len() == n_all,
        "passed": results.iter().all(ClaimResult::passed),
        "claims": claims,
    });
    files.push((SUMMARY_FILE.into(), format!("{summary:#}\n")));
    for (name, text) in files {
        fs::write(folder.join(name), text).map_err(|error| fault(&error))?;
    }
    Ok(())
}

/// Returns `checks.csv` with SI numbers; a cell without a value is empty.
fn table(results: &[ClaimResult]) -> csv::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "claim",
        "quantity",
        "unit",
        "kind",
        "reference",
        "measured",
        "tolerance",
        "passed",
        "source",
    ])?;
    let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for result in results {
        for check in &result.checks {
            writer.write_record([
                &result.claim.name,
                &check.check.quantity,
                &check.check.unit,
                &check.check.kind.to_string(),
                &number(check.check.reference),
                &number(check.measured),
                &format!("{:?}", check.check.tolerance),
                &check.passed.to_string(),
                &check.check.source,
            ])?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
