//! `sweep.csv`: the swept keys as written, the same in SI, the summary's columns, and the member's identity.

use std::io::Write;

use serde_json::Value;

use super::row::Row;

/// The name of the file.
pub const SWEEP_FILE: &str = "sweep.csv";

/// Writes a table of these columns, one row per member, after those of the swept `keys`, as written and in
/// SI; numbers are the shortest that read back as the same, a cell without a value is empty. A row is let
/// go when it is written.
///
/// # Errors
/// `to` cannot be written to.
pub fn sweep_csv<'k>(
    to: impl Write,
    keys: impl IntoIterator<Item = &'k str>,
    columns: &[&'k str],
    rows: impl IntoIterator<Item = Row>,
) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    file.write_record(keys.into_iter().chain(columns.iter().copied()).chain(["member"]))?;
    for row in rows {
        let cells = columns.iter().map(|column| cell(&row.value(column)));
        let numbers = row.numbers.iter().map(|number| cell(&Value::from(*number)));
        let values = row.values.iter().cloned().chain(numbers);
        file.write_record(values.chain(cells).chain([row.identity.clone()]))?;
    }
    Ok(file.flush()?)
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}
