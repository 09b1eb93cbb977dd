//! One measured impact: a row of the table that fits and calibrations read.

use serde::Serialize;

use crate::table::{MAX_RESTITUTION, Measured, impossible_restitution};

/// An impact of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Instant in the record, s.
    pub time: f64,
    /// Approach speed, m/s.
    pub speed: Measured,
    /// Restitution of the impact.
    pub restitution: Measured,
    /// Contact time, s, if the record shows it.
    pub contact_time: Option<f64>,
}

/// The columns of the table of impacts.
pub const IMPACT_COLUMNS: [&str; 6] = [
    "speed_m_s",
    "restitution",
    "restitution_uncertainty",
    "speed_uncertainty_m_s",
    "time_s",
    "contact_time_s",
];

impl Impact {
    /// Returns the row of the impact in the order of [`IMPACT_COLUMNS`]; an unknown uncertainty is absent.
    pub fn row(&self) -> [Option<f64>; 6] {
        let known = |it: Measured| Some(it.uncertainty).filter(|u| *u > 0.0);
        [
            Some(self.speed.value),
            Some(self.restitution.value),
            known(self.restitution),
            known(self.speed),
            Some(self.time),
            self.contact_time,
        ]
    }

    /// Returns a warning if impacts gain energy on average.
    pub(super) fn gain(impacts: &[Self]) -> Option<String> {
        let values = impacts.iter().map(|impact| impact.restitution.value);
        let mean = values.sum::<f64>() / impacts.len() as f64;
        let warning = || {
            format!(
                "the restitutions are {mean:.3} on average, above 1: is something else than a ball recorded?"
            )
        };
        (mean > 1.0).then(warning)
    }

    /// Returns a warning if no collision has this restitution.
    pub(super) fn left_out(&self) -> Option<String> {
        let reason = self.impossible()?;
        Some(format!("the impact at {:.4} s is left out: {reason}", self.time))
    }

    /// Returns why no collision has this restitution, if its uncertainty does not explain it.
    pub(super) fn impossible(&self) -> Option<String> {
        let Measured { value, uncertainty } = self.restitution;
        let excess = (value - 1.0).max(-value);
        let reason = impossible_restitution(self.restitution)?;
        // Readers of the table reject a larger one.
        (excess > (3.0 * uncertainty).min(MAX_RESTITUTION - 1.0))
            .then(|| format!("{reason} ({value:.3})"))
    }
}

impl Serialize for Impact {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = IMPACT_COLUMNS.into_iter().zip(self.row());
        serializer.collect_map(row)
    }
}
