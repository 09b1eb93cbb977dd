//! `[accuracy]`: the tolerances of the results.

use super::Check;
use crate::error::CaseError;
use crate::quantity::range::Range;
use crate::scene::{Accuracy, defaults};
use crate::schema::accuracy_table::{AccuracyTable, ToleranceValue};
use crate::source::toml_syntax::join;

impl Check<'_> {
    /// Returns the tolerances of a case; 1 % by default.
    pub(super) fn accuracy(&self, table: Option<&AccuracyTable>) -> Result<Accuracy, CaseError> {
        let default = defaults::accuracy();
        let key = "accuracy.tolerance";
        match table.and_then(|table| table.tolerance.as_ref()) {
            None => Ok(default),
            Some(ToleranceValue::Share(share)) => {
                Ok(Accuracy::within(self.number(key, share, Range::TOLERANCE)?))
            }
            Some(ToleranceValue::Table(table)) => {
                macro_rules! share {
                    ($key:ident) => {
                        self.optional(
                            &join(key, stringify!($key)),
                            table.$key.as_ref(),
                            Range::TOLERANCE,
                        )?
                        .unwrap_or(default.$key)
                    };
                }
                Ok(Accuracy {
                    restitution: share!(restitution),
                    contact_time: share!(contact_time),
                    peak_force: share!(peak_force),
                    peak_pressure: share!(peak_pressure),
                })
            }
        }
    }
}
