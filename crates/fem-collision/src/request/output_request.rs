//! What a run is asked for.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::fields::{ProbeRequest, SnapshotRequest};

/// Duration of the run after the last contact, as a fraction of the contact time. Velocities and
/// vibrations are measured in this free flight.
pub const FLIGHT_AFTER: f64 = 0.2;

/// What a run is asked for.
///
/// ```
/// use fem_collision::{OutputRequest, OutputRequestError};
///
/// assert_eq!(OutputRequest::history().check(), Ok(()));
/// let endless = OutputRequest { give_up_after: f64::INFINITY, ..OutputRequest::history() };
/// assert_eq!(endless.check(), Ok(()));
/// let none = OutputRequest { give_up_after: 0.0, ..OutputRequest::history() };
/// assert_eq!(none.check(), Err(OutputRequestError::GiveUpAfter(0.0)));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutputRequest {
    /// Rows of the history over the expected contact; 0 for none.
    pub history_rows: usize,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// Places that are told of over time.
    pub probes: Vec<ProbeRequest>,
    /// The run gives up after so many expected contact times.
    pub give_up_after: f64,
    /// A run that computes each element at each step ends after so many elements times steps.
    pub most_element_updates: u64,
}

/// Why nothing can be asked for like this.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum OutputRequestError {
    /// More rows than any memory holds.
    #[error("{0} rows of a history; allowed are at most {most}", most = OutputRequest::MOST_ROWS)]
    HistoryRows(usize),
    /// More snapshots than any memory holds.
    #[error("{0} snapshots; allowed are at most {most}", most = OutputRequest::MOST_SNAPSHOTS)]
    Snapshots(usize),
    /// Before the start of the case, or no instant at all.
    #[error("a snapshot at {0} s; allowed is at least 0, and finite")]
    SnapshotTime(f64),
    /// A run that gives up before it begins, or never knows.
    #[error("to give up after {0} expected contact times; allowed is above 0")]
    GiveUpAfter(f64),
}

impl OutputRequest {
    /// Rows over the contact that draw every curve smoothly.
    pub const ROWS: usize = 1000;
    /// Expected contact times after which no body that relaxes parts from another.
    pub const GIVE_UP_AFTER: f64 = 50.0;
    /// The most rows that can be asked for.
    pub const MOST_ROWS: usize = 1_000_000;
    /// The most snapshots that can be asked for.
    pub const MOST_SNAPSHOTS: usize = 1_000_000;

    /// The quantities of the collision and its history, no snapshots.
    pub fn history() -> Self {
        Self {
            history_rows: Self::ROWS,
            snapshots: SnapshotRequest::none(),
            probes: Vec::new(),
            give_up_after: Self::GIVE_UP_AFTER,
            most_element_updates: u64::MAX,
        }
    }

    /// The quantities of the collision alone.
    pub fn quantities() -> Self {
        Self { history_rows: 0, ..Self::history() }
    }

    /// Whether a run can be asked for this.
    ///
    /// # Errors
    /// More than [`OutputRequest::MOST_ROWS`] rows or [`OutputRequest::MOST_SNAPSHOTS`] snapshots, a snapshot at a time
    /// that is negative or not finite, a `give_up_after` that is not positive; it may be infinite.
    pub fn check(&self) -> Result<(), OutputRequestError> {
        if self.history_rows > Self::MOST_ROWS {
            return Err(OutputRequestError::HistoryRows(self.history_rows));
        }
        let n_snapshots = match &self.snapshots {
            SnapshotRequest::Labels(labels) => labels.len(),
            SnapshotRequest::Count(n) => *n,
            SnapshotRequest::Times(times) => times.len(),
        };
        if n_snapshots > Self::MOST_SNAPSHOTS {
            return Err(OutputRequestError::Snapshots(n_snapshots));
        }
        if let SnapshotRequest::Times(times) = &self.snapshots
            && let Some(&time) = times.iter().find(|time| !(time.is_finite() && **time >= 0.0))
        {
            return Err(OutputRequestError::SnapshotTime(time));
        }
        if self.give_up_after > 0.0 {
            Ok(())
        } else {
            Err(OutputRequestError::GiveUpAfter(self.give_up_after))
        }
    }
}

/// What to expect of a collision, from closed forms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expectation {
    /// First to last contact force, s.
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
    fn the_most_is_allowed_and_one_more_is_not() {
        let rows = |history_rows| OutputRequest { history_rows, ..OutputRequest::history() };
        assert_eq!(rows(OutputRequest::MOST_ROWS).check(), Ok(()));
        for n in [OutputRequest::MOST_ROWS + 1, usize::MAX] {
            assert_eq!(rows(n).check(), Err(OutputRequestError::HistoryRows(n)));
        }
        let (count, times) = (SnapshotRequest::Count, |n| SnapshotRequest::Times(vec![0.0; n]));
        let most = OutputRequest::MOST_SNAPSHOTS;
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

    /// What is wrong is told with its value.
    #[test]
    fn times_are_times() {
        for wrong in [-1e-9, f64::INFINITY, f64::NAN] {
            let request = SnapshotRequest::Times(vec![0.0, 1e-6, wrong]);
            let error = snapshots(request).check().unwrap_err();
            assert!(matches!(error, OutputRequestError::SnapshotTime(_)), "{error:?}");
            assert!(error.to_string().contains(&wrong.to_string()), "{error}");
        }
        for wrong in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            let error = OutputRequest { give_up_after: wrong, ..OutputRequest::history() }
                .check()
                .unwrap_err();
            assert!(matches!(error, OutputRequestError::GiveUpAfter(_)), "{error:?}");
        }
    }
}
