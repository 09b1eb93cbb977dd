//! The last sound state of a run, for a run that fails: what it shows is where that began.

use fem_collision::{OutputRequest, Snapshot, SnapshotInstant, SnapshotRequest};
use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::snapshot::{fits, take};
use crate::state::{Scratch, State};

/// Sound instants from one that is kept to the next: some thirty over a contact.
const STRIDE: u64 = 32;

/// Keeps a state now and then whose energy adds up. It is in the memory of a run, which has the same one
/// after a restart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastSound {
    is_wanted: bool,
    n_seen: u64,
    kept: Option<Snapshot>,
}

impl LastSound {
    /// Of a run that is asked for fields, or for none.
    pub fn of(want: &OutputRequest) -> Self {
        Self { is_wanted: is_wanted(want), ..Self::default() }
    }

    /// Told of every instant whose balance is sound, forces in `scratch`.
    pub fn observe(&mut self, model: &Model, state: &State, scratch: &Scratch, approach: f64) {
        if self.n_seen.is_multiple_of(STRIDE) {
            self.keep(model, state, scratch, approach);
        }
        self.n_seen = self.n_seen.saturating_add(1);
    }

    /// Keeps this state, forces in `scratch`.
    pub fn keep(&mut self, model: &Model, state: &State, scratch: &Scratch, approach: f64) {
        if self.is_wanted {
            let snapshot = self.kept.get_or_insert_default();
            take(
                snapshot,
                model,
                state,
                &scratch.forces,
                approach,
                Some(SnapshotInstant::LastSound),
            );
        }
    }

    /// Forgets what it has: of a run that came to its end.
    pub fn forget(&mut self) {
        self.kept = None;
    }

    /// Puts the state that was kept last among these snapshots, in the order of time, unless one of them is of
    /// that instant.
    pub fn put_among(self, snapshots: &mut Vec<Snapshot>) {
        let Some(kept) = self.kept else { return };
        let place = snapshots.partition_point(|snapshot| snapshot.time < kept.time);
        if snapshots.get(place).is_none_or(|next| next.time > kept.time) {
            snapshots.insert(place, kept);
        }
    }

    /// Whether it can be of a run of this model at this state that is asked for this.
    pub fn fits(&self, model: &Model, state: &State, want: &OutputRequest) -> bool {
        let is_sound = |kept: &Snapshot| fits(kept, model) && kept.time <= state.time;
        self.is_wanted == is_wanted(want) && self.kept.as_ref().is_none_or(is_sound)
    }
}

fn is_wanted(want: &OutputRequest) -> bool {
    want.snapshots != SnapshotRequest::none()
}
