//! `[accuracy]`: the tolerances of the results.

use super::{Allowed, Check, allowed};
use crate::error::CaseError;
use crate::scene::Accuracy;
use crate::schema::accuracy_table::{AccuracyTable, ToleranceValue};
use crate::source::toml_syntax::join;

const SHARE: Allowed = allowed("greater than 0 and at most 0.5", |x| x > 0.0 && x <= 0.5);

impl Check<'_> {
    /// Returns the tolerances of a case; 1 % by default.
    pub(super) fn accuracy(&self, table: Option<&AccuracyTable>) -> Result<Accuracy, CaseError> {
        let default = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
        let key = "accuracy.tolerance";
        match table.and_then(|table| table.tolerance.as_ref()) {
            None => Ok(default),
            Some(ToleranceValue::Share(share)) => {
                Ok(Accuracy::within(self.number(key, share, SHARE)?))
            }
            Some(ToleranceValue::Table(table)) => {
                macro_rules! share {
                    ($key:ident) => {
                        self.optional(&join(key, stringify!($key)), table.$key.as_ref(), SHARE)?
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
