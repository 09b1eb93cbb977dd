//! One pair as text and as a picture.

use comfy_table::CellAlignment::{Left, Right};
use fem_case::engineering::{number, show};
use fem_fit::dem::{Export, Snippet};

use crate::standard_output;
use crate::tables::table;

/// What is printed: a line a snippet.
pub fn export_text(export: &Export, snippets: &[Snippet]) -> String {
    let header = ["code", "model", "enter", "makes e", "good to tolerance", "worst error", "file"];
    let row = |snippet: &Snippet| {
        let [from, to, worst] = snippet.validity;
        let entries = snippet.entries.iter().map(|(key, value)| format!("{key} {}", entry(*value)));
        [
            snippet.code.to_string(),
            snippet.model.to_string(),
            entries.collect::<Vec<_>>().join(", "),
            snippet.restitution.map_or("falls with v".to_string(), |e| format!("{e:.4}")),
            good(Some(from).filter(|from| *from <= to), Some(to)),
            format!("{worst:.4}"),
            snippet.name.to_string(),
        ]
    };
    let rows = std::iter::once(header.map(String::from)).chain(snippets.iter().map(row));
    format!(
        "{}, {} to {}; a snippet is good where its restitution is right to {}\n\n{}",
        standard_output::one_line(&export.title),
        show(export.speeds.0, "m/s"),
        show(export.speeds.1, "m/s"),
        export.tolerance,
        table(&[Left, Left, Left, Right, Left, Right, Left], rows)
    )
}

/// Where a snippet is good, in words.
pub fn good(from: Option<f64>, to: Option<f64>) -> String {
    match (from, to) {
        (Some(from), Some(to)) if from == to => format!("at {} alone", show(from, "m/s")),
        (Some(from), Some(to)) => format!("{} to {}", show(from, "m/s"), show(to, "m/s")),
        _ => "nowhere".to_string(),
    }
}

/// A number without a unit in five digits.
fn entry(value: f64) -> String {
    number(value, 5)
}
