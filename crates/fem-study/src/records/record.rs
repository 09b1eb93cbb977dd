//! A record of any kind, from the bytes of a file to the table of impacts.

use serde_json::{Value, json};

use crate::measured::{DataError, NumberColumns, decode};

use super::bounce_times::{BounceTimes, Instants};
use super::impact::Impact;
use super::rig::Rig;
use super::roles::RecordKind;

/// A measured record and what it says.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// The instants at which a bouncing ball touches the plate.
    BounceTimes(BounceTimes),
}

impl Record {
    /// Reads a record. Without a kind, the columns decide; `names` renames them, as in
    /// [`Table::renamed`](crate::measured::Table::renamed).
    ///
    /// # Errors
    /// The record is of no kind, has an error, or does not support a restitution.
    pub fn read(
        name: &str,
        bytes: &[u8],
        kind: Option<RecordKind>,
        names: &[(&str, &str)],
        rig: &Rig,
    ) -> Result<Self, DataError> {
        let text = decode(bytes);
        let columns = NumberColumns::parse(name, &text)?.renamed(names)?;
        let kind = match kind {
            Some(kind) => kind,
            None => RecordKind::of(&columns)?,
        };
        match kind {
            RecordKind::BounceTimes => {
                BounceTimes::of(Instants::read(&columns)?, rig).map(Self::BounceTimes)
            }
        }
    }

    /// Returns the kind.
    pub fn kind(&self) -> RecordKind {
        match self {
            Self::BounceTimes(_) => RecordKind::BounceTimes,
        }
    }

    /// Returns the impacts in the order of the record.
    pub fn impacts(&self) -> &[Impact] {
        match self {
            Self::BounceTimes(bounces) => &bounces.impacts,
        }
    }

    /// Returns what was left out, and what may be wrong.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::BounceTimes(bounces) => &bounces.warnings,
        }
    }

    /// Returns all numbers for JSON, SI.
    pub fn numbers(&self, name: &str, rig: &Rig) -> Value {
        let details = match self {
            Self::BounceTimes(bounces) => bounces.numbers(),
        };
        json!({
            "data": name,
            "kind": self.kind().name(),
            "gravity_m_s2": rig.gravity().value,
            "impacts": self.impacts(),
            "record": details,
            "warnings": self.warnings(),
        })
    }
}
