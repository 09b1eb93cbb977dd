//! The results of a member as a row of a table, and the table of a sweep.

use serde_json::Value;

use super::columns::value_of;
use super::identity::Member;
use fem_simulation::results::Summary;

/// A member that has been computed.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its place in the sweep.
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
    /// The row of a member with these values, and this summary as JSON.
    pub fn new<V: ToString>(
        member: &Member,
        values: impl IntoIterator<Item = V>,
        summary: Value,
    ) -> Self {
        let values = values.into_iter().map(|value| value.to_string()).collect();
        let (index, identity) = (member.index, member.identity());
        Self { index, values, numbers: Vec::new(), identity, summary }
    }

    /// This row with its values in SI.
    #[must_use]
    pub fn with_numbers(self, numbers: Vec<Option<f64>>) -> Self {
        Self { numbers, ..self }
    }

    /// A row of a summary as it comes out of a run.
    pub fn of<V: ToString>(
        member: &Member,
        values: impl IntoIterator<Item = V>,
        summary: &Summary,
    ) -> Self {
        // A summary has only finite numbers and text: it always serializes.
        Self::new(member, values, serde_json::to_value(summary).unwrap_or_default())
    }

    /// The value of one of the [`COLUMNS`](super::COLUMNS); `null` if it has none.
    pub fn value(&self, column: &str) -> Value {
        value_of(&self.summary, column)
    }

    /// Whether the member's collision ended by itself.
    pub fn is_complete(&self) -> bool {
        self.summary["complete"] == true
    }
}
