//! `[accuracy]`: how far results may be off.

use super::{Allowed, Check, allowed};
use crate::error::CaseError;
use crate::scene::Accuracy;
use crate::schema::accuracy_table::{AccuracyTable, ToleranceValue};

const SHARE: Allowed = allowed("greater than 0 and at most 0.5", |x| x > 0.0 && x <= 0.5);

impl Check<'_> {
    /// What the case asks for; 1 % where it says nothing.
    pub(super) fn accuracy(&self, table: Option<&AccuracyTable>) -> Result<Accuracy, CaseError> {
        let default = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
        let key = "accuracy.tolerance";
        match table.and_then(|table| table.tolerance.as_ref()) {
            None => Ok(default),
            Some(ToleranceValue::Share(share)) => {
                Ok(Accuracy::within(self.number(key, share, SHARE)?))
            }
            Some(ToleranceValue::Table(table)) => {
                let share = |name: &str, given, default: f64| {
                    let given = self.optional(&format!("{key}.{name}"), given, SHARE)?;
                    Ok::<_, CaseError>(given.unwrap_or(default))
                };
                Ok(Accuracy {
                    restitution: share(
                        "restitution",
                        table.restitution.as_ref(),
                        default.restitution,
                    )?,
                    contact_time: share(
                        "contact_time",
                        table.contact_time.as_ref(),
                        default.contact_time,
                    )?,
                    peak_force: share("peak_force", table.peak_force.as_ref(), default.peak_force)?,
                    peak_pressure: share(
                        "peak_pressure",
                        table.peak_pressure.as_ref(),
                        default.peak_pressure,
                    )?,
                })
            }
        }
    }
}
