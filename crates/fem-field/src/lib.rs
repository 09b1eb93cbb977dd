//! Fields of a collision at an instant, whichever model computed them.
//!
//! * [`Snapshot`]: displacement and velocity of both bodies at an instant, named by a [`Label`] or
//!   asked for by a [`SnapshotRequest`];
//! * [`StressField`]: the stress recovered from a body's fields, at elements and nodes;
//! * [`StressRecovery`]: the same for many fields of one mesh.

mod patches;
mod snapshot;
mod stress;

pub use snapshot::{BodyFields, Label, Snapshot, SnapshotRequest};
pub use stress::{StressField, StressRecovery, invariants};
