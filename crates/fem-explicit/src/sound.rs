//! The last sound state of a run, for a run that fails: what it shows is where that began.
//!
//! It is no part of what a restart needs: a run that goes on from a memory keeps its own anew.

use fem_collision::{Snapshot, SnapshotRequest, Want};

use crate::model::Model;
use crate::snapshot::take;
use crate::state::{Scratch, State};

/// Sound instants from one that is kept to the next: some thirty over a contact.
const STRIDE: u64 = 32;

/// Keeps a state now and then whose energy adds up.
#[derive(Debug, Default)]
pub(crate) struct LastSound {
    is_wanted: bool,
    n_seen: u64,
    kept: Option<Snapshot>,
}

impl LastSound {
    /// Of a run that is asked for fields, or for none.
    pub fn of(want: &Want) -> Self {
        Self { is_wanted: want.snapshots != SnapshotRequest::none(), ..Self::default() }
    }

    /// Told of every instant whose balance is sound, forces in `scratch`.
    pub fn observe(&mut self, model: &Model, state: &State, scratch: &Scratch, approach: f64) {
        if self.is_wanted && self.n_seen.is_multiple_of(STRIDE) {
            let snapshot = self.kept.get_or_insert_default();
            take(snapshot, model, state, &scratch.forces, approach, None);
        }
        self.n_seen += 1;
    }

    /// The state that was kept last, if it is later than these snapshots.
    pub fn after(self, snapshots: &[Snapshot]) -> Option<Snapshot> {
        let is_later = |kept: &Snapshot| snapshots.last().is_none_or(|last| last.time < kept.time);
        self.kept.filter(is_later)
    }
}
