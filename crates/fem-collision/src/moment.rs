//! An instant of a run, for who wants to look there.

use std::fmt;

use fem_material::engineering::show;
use serde::{Deserialize, Serialize};

/// When something was seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Since the start of the case, s.
    pub time: f64,
    /// Number of the step.
    pub step: u64,
}

impl Moment {
    /// So much later, s: of a run that counts its time from another instant.
    #[must_use]
    pub fn later_by(self, delay: f64) -> Self {
        Self { time: self.time + delay, ..self }
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{} (step {})", show(self.time, "s"), self.step)
    }
}
