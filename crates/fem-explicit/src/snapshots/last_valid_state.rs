//! Keeps the last valid state, so that a failed run shows where it failed.

use fem_collision::{OutputRequest, Snapshot, SnapshotInstant, SnapshotRequest};
use serde::{Deserialize, Serialize};

use super::{fits, take};
use crate::model::ExplicitBodies;
use crate::state::{Scratch, State};

/// Valid instants from one that is kept to the next: about thirty are kept in turn during a contact.
const INSTANTS_BETWEEN_COPIES: u64 = 32;

/// The last state that was kept while the energy of the run added up. It is part of the restart state, so that a
/// resumed run has the same one.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LastValidState {
    is_wanted: bool,
    n_seen: u64,
    kept: Option<Snapshot>,
}

impl LastValidState {
    /// Keeps states if snapshots are requested, otherwise none.
    pub fn new(request: &OutputRequest) -> Self {
        Self { is_wanted: is_wanted(request), ..Self::default() }
    }

    /// Takes note of a sampled instant whose energy adds up; its forces are in `scratch`.
    pub fn observe(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        approach: f64,
    ) {
        if self.n_seen.is_multiple_of(INSTANTS_BETWEEN_COPIES) {
            self.keep(model, state, scratch, approach);
        }
        self.n_seen = self.n_seen.saturating_add(1);
    }

    /// Keeps a state, whose forces are in `scratch`.
    pub fn keep(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        approach: f64,
    ) {
        if self.is_wanted {
            let snapshot = self.kept.get_or_insert_default();
            take(
                snapshot,
                model,
                state,
                &scratch.forces,
                approach,
                Some(SnapshotInstant::LastValid),
            );
        }
    }

    /// Forgets the state, once the run has come to its end.
    pub fn forget(&mut self) {
        self.kept = None;
    }

    /// Inserts the state into snapshots in the order of time, unless one of them shows the same instant.
    pub fn put_among(self, snapshots: &mut Vec<Snapshot>) {
        let Some(kept) = self.kept else { return };
        let place = snapshots.partition_point(|snapshot| snapshot.time < kept.time);
        if snapshots.get(place).is_none_or(|next| next.time > kept.time) {
            snapshots.insert(place, kept);
        }
    }

    /// Returns whether it can belong to a run of a model in a state, with a request.
    pub fn fits(&self, model: &ExplicitBodies, state: &State, request: &OutputRequest) -> bool {
        let is_valid = |kept: &Snapshot| fits(kept, model) && kept.time <= state.time;
        self.is_wanted == is_wanted(request) && self.kept.as_ref().is_none_or(is_valid)
    }
}

fn is_wanted(request: &OutputRequest) -> bool {
    request.snapshots != SnapshotRequest::none()
}
