//! Output requests, and the expectation of a collision.

use fem_material::engineering::number;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::fields::{ProbeRequest, SnapshotRequest};

/// Duration of the run after the last contact, as a fraction of the contact time. Velocities and
/// vibrations are measured in this free flight.
pub const POST_CONTACT_FRACTION: f64 = 0.2;

/// The output that a run must produce, and its limits.
///
/// ```
/// use fem_collision::{OutputRequest, OutputRequestError};
///
/// assert_eq!(OutputRequest::history().check(), Ok(()));
/// let endless = OutputRequest { max_contact_times: f64::INFINITY, ..OutputRequest::history() };
/// assert_eq!(endless.check(), Ok(()));
/// let none = OutputRequest { max_contact_times: 0.0, ..OutputRequest::history() };
/// assert_eq!(none.check(), Err(OutputRequestError::GiveUpAfter(0.0)));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputRequest {
    /// Rows of the history over the expected contact; 0 for none.
    pub history_rows: usize,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// Points whose fields are recorded over time.
    pub probes: Vec<ProbeRequest>,
    /// Whether the pressures at each step of the contact are kept, by a model that has them.
    pub pressures: bool,
    /// Number of expected contact times after which the run stops.
    pub max_contact_times: f64,
    /// Largest number of elements times steps, for a model that computes each element at each step.
    pub most_element_updates: u64,
}

/// The reason why an output request is not valid.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum OutputRequestError {
    /// The history has too many rows for any memory.
    #[error("{0} rows of the history; at most {most} are allowed", most = OutputRequest::MAX_ROWS)]
    HistoryRows(usize),
    /// There are too many snapshots for any memory.
    #[error("{0} snapshots; at most {most} are allowed", most = OutputRequest::MAX_SNAPSHOTS)]
    Snapshots(usize),
    /// The time of a snapshot is negative or not finite.
    #[error("a snapshot is at {} s; the time must be finite and at least 0", number(*.0, 5))]
    SnapshotTime(f64),
    /// The number of expected contact times is not positive.
    #[error(
        "the run would stop after {} expected contact times; the number must be above 0",
        number(*.0, 5)
    )]
    GiveUpAfter(f64),
}

impl OutputRequest {
    /// Default number of rows over the contact, enough for smooth curves.
    pub const ROWS: usize = 1000;
    /// Default number of expected contact times; relaxing bodies have separated by then or never do.
    pub const MAX_CONTACT_TIMES: f64 = 50.0;
    /// Largest number of rows.
    pub const MAX_ROWS: usize = 1_000_000;
    /// Largest number of snapshots.
    pub const MAX_SNAPSHOTS: usize = 1_000_000;

    /// Requests the quantities of the collision and its history, without snapshots.
    pub fn history() -> Self {
        Self {
            history_rows: Self::ROWS,
            snapshots: SnapshotRequest::none(),
            probes: Vec::new(),
            pressures: false,
            max_contact_times: Self::MAX_CONTACT_TIMES,
            most_element_updates: u64::MAX,
        }
    }

    /// Requests only the quantities of the collision.
    pub fn quantities() -> Self {
        Self { history_rows: 0, ..Self::history() }
    }

    /// Validates the request.
    ///
    /// # Errors
    /// There are more than [`OutputRequest::MAX_ROWS`] rows or [`OutputRequest::MAX_SNAPSHOTS`] snapshots, the time of a
    /// snapshot is negative or not finite, or `max_contact_times` is not positive; it may be infinite.
    pub fn check(&self) -> Result<(), OutputRequestError> {
        if self.history_rows > Self::MAX_ROWS {
            return Err(OutputRequestError::HistoryRows(self.history_rows));
        }
        let n_snapshots = self.snapshots.len();
        if n_snapshots > Self::MAX_SNAPSHOTS {
            return Err(OutputRequestError::Snapshots(n_snapshots));
        }
        if let SnapshotRequest::Times(times) = &self.snapshots
            && let Some(&time) = times.iter().find(|time| !(time.is_finite() && **time >= 0.0))
        {
            return Err(OutputRequestError::SnapshotTime(time));
        }
        if self.max_contact_times > 0.0 {
            Ok(())
        } else {
            Err(OutputRequestError::GiveUpAfter(self.max_contact_times))
        }
    }
}

/// Estimates of a collision from closed forms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expectation {
    /// Time from first to last contact force, s.
    pub contact_time: f64,
    /// Largest approach, m.
    pub approach: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshots(snapshots: SnapshotRequest) -> OutputRequest {
        OutputRequest { snapshots, ..OutputRequest::history() }
    }

    #[test]
    fn output_request_rejects_more_than_the_maximum_rows_and_snapshots() {
        let rows = |history_rows| OutputRequest { history_rows, ..OutputRequest::history() };
        assert_eq!(rows(OutputRequest::MAX_ROWS).check(), Ok(()));
        for n in [OutputRequest::MAX_ROWS + 1, usize::MAX] {
            assert_eq!(rows(n).check(), Err(OutputRequestError::HistoryRows(n)));
        }
        let (count, times) = (SnapshotRequest::Count, |n| SnapshotRequest::Times(vec![0.0; n]));
        let most = OutputRequest::MAX_SNAPSHOTS;
        for request in [count(0), count(most), times(0), times(most)] {
            assert_eq!(snapshots(request).check(), Ok(()));
        }
        for (request, n) in [
            (count(most + 1), most + 1),
            (count(usize::MAX), usize::MAX),
            (times(most + 1), most + 1),
        ] {
            assert_eq!(snapshots(request).check(), Err(OutputRequestError::Snapshots(n)));
        }
    }

    #[test]
    fn output_request_rejects_invalid_times() {
        for wrong in [-1e-9, f64::INFINITY, f64::NAN] {
            let request = SnapshotRequest::Times(vec![0.0, 1e-6, wrong]);
            let error = snapshots(request).check().unwrap_err();
            assert!(matches!(error, OutputRequestError::SnapshotTime(_)), "{error:?}");
            assert!(error.to_string().contains(&number(wrong, 5)), "{error}");
        }
        for wrong in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            let error = OutputRequest { max_contact_times: wrong, ..OutputRequest::history() }
                .check()
                .unwrap_err();
            assert!(matches!(error, OutputRequestError::GiveUpAfter(_)), "{error:?}");
        }
    }
}
