//! Fields of both bodies: snapshots, the stress recovered from them, in the body and at its surface, and probes.

mod probe;
mod snapshot;
mod stress;
mod surface;

pub use probe::{Probe, ProbeRequest, Probes};
pub use snapshot::{
    BodyFields, ContactProfile, ContactProfilePoint, Snapshot, SnapshotInstant, SnapshotRequest,
    did_not_occur, evenly, fewer_than_asked,
};
pub use stress::{SmallStrain, StressField, StressRecovery, invariants};
