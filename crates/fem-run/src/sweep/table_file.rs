//! `sweep.csv`: the swept keys as written, the summary's columns, and the member's folder.

use fem_case::Sweep;
use serde_json::Value;

use super::collect::Row;
use super::columns::{COLUMNS, value_of};

/// The table, a row a member in the order of the sweep; numbers are the shortest that read back
/// as the same, a cell without a value is empty.
///
/// # Errors
/// None; the writer's signature.
pub fn table(sweep: &Sweep, rows: &[Row]) -> csv::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let keys = sweep.axes.iter().map(|axis| axis.key.as_str());
    writer.write_record(keys.chain(COLUMNS.iter().copied()).chain(["member"]))?;
    for row in rows {
        let values = sweep.values(row.index).into_iter().map(str::to_string);
        let columns = COLUMNS.iter().map(|column| cell(&value_of(&row.summary, column)));
        writer.write_record(values.chain(columns).chain([row.identity.clone()]))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}
