//! What a run is asked for.

use serde::{Deserialize, Serialize};

use crate::snapshot::SnapshotRequest;

/// What a run is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Want {
    /// Rows of the history over the expected contact; 0 for none.
    pub history_rows: usize,
    /// Snapshots to keep.
    pub snapshots: SnapshotRequest,
    /// The run gives up after so many expected contact times.
    pub give_up_after: f64,
}

impl Want {
    /// Rows over the contact that draw every curve smoothly.
    pub const ROWS: usize = 1000;
    /// Expected contact times after which no body that relaxes parts from another.
    pub const GIVE_UP_AFTER: f64 = 50.0;

    /// The quantities of the collision and its history, no snapshots.
    pub fn history() -> Self {
        Self {
            history_rows: Self::ROWS,
            snapshots: SnapshotRequest::none(),
            give_up_after: Self::GIVE_UP_AFTER,
        }
    }

    /// The quantities of the collision alone.
    pub fn quantities() -> Self {
        Self { history_rows: 0, ..Self::history() }
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
