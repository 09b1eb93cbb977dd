//! The results of a member as a row of a table, and the table of a sweep.

use serde_json::Value;

use super::columns::value_of;
use super::members::Member;
use fem_simulation::results::Summary;

/// A member that has been computed.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its index in the sweep.
    pub index: usize,
    /// Value of each varied key, as written.
    pub values: Vec<String>,
    /// Values of the keys that are quantities, in SI; see
    /// [`KeyNumbers::columns`](super::KeyNumbers::columns).
    pub numbers: Vec<Option<f64>>,
    /// Identity of the member.
    pub identity: String,
    /// The member's summary.
    pub summary: Value,
}

impl Row {
    /// Creates the row of a member with these values and this summary, given as JSON.
    pub fn new<V: ToString>(
        member: &Member,
        values: impl IntoIterator<Item = V>,
        summary: Value,
    ) -> Self {
        let values = values.into_iter().map(|value| value.to_string()).collect();
        let (index, identity) = (member.index, member.identity());
        Self { index, values, numbers: Vec::new(), identity, summary }
    }

    /// Returns this row with its values in SI.
    #[must_use]
    pub fn with_numbers(self, numbers: Vec<Option<f64>>) -> Self {
        Self { numbers, ..self }
    }

    /// Creates the row of a member with the summary of its run.
    pub fn of<V: ToString>(
        member: &Member,
        values: impl IntoIterator<Item = V>,
        summary: &Summary,
    ) -> Self {
        // A summary has only finite numbers and text: it always serializes.
        Self::new(member, values, serde_json::to_value(summary).unwrap_or_default())
    }

    /// Returns the value of one of the [`COLUMNS`](super::COLUMNS); `null` if it has none.
    pub fn value(&self, column: &str) -> Value {
        value_of(&self.summary, column)
    }

    /// Whether the member's collision ended by itself.
    pub fn is_complete(&self) -> bool {
        self.summary["complete"] == true
    }
}

/// The name of the table's file.
#[cfg(feature = "files")]
pub const SWEEP_FILE: &str = "sweep.csv";

/// Writes a table of these columns, one row per member, after those of the swept `keys`, as written and in
/// SI. Numbers are the shortest that read back as the same, and cells without a value are empty. A row is dropped
/// when it is written.
///
/// # Errors
/// `to` cannot be written to.
#[cfg(feature = "files")]
pub fn sweep_csv<'k>(
    to: impl std::io::Write,
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

#[cfg(feature = "files")]
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}
