//! What a collision is asked for and what comes out of it, whichever model computes it.
//!
//! ```text
//! asked for                       while it runs                  what comes out
//! BodyInput  what a body is       Monitor  looks on, stops it    Collision  the whole
//! Approach   how they meet        History  thins rows            Row        an instant
//! Expectation  what to expect     Losses   powers to energies    Ending     how it ended
//! Want       rows, snapshots                                     Snapshot   fields at an instant
//! ```
//!
//! * [`Account`] names a place of energy and [`Book`] holds what is in each; every model, part of a
//!   step, column of a history and key of a summary means the same by them.
//! * [`Cadence`] says at which steps of a run something is observed, [`Aftermath`] and [`Scatter`]
//!   what follows from it beside extremes; [`Pulse`] has the peaks without noise.
//! * [`Frame`] leads from the relative motion of two bodies to each of them.
//! * [`far_radius_of_waves`] and [`far_radius_at_rest`] say how far the mesh of a half-space has to
//!   reach.
//! * [`Headline`] names the numbers that a collision is known by.
//! * [`Standstill`] tells bodies that stay together from those that are slow to part.
//! * [`StressField`] is the stress recovered from a body's fields, [`StressRecovery`] the same for
//!   many fields of one mesh.
//!
//! SI throughout; the axis is y, forces and approach are positive in compression, stress in tension.

mod account;
mod aftermath;
mod approach;
mod body_input;
mod bounce;
mod cadence;
mod collision;
mod deepest;
mod ending;
mod far_radius;
mod frame;
mod headline;
mod history;
mod instants;
mod losses;
mod moment;
mod monitor;
mod patches;
mod probe;
mod pulse;
mod row;
mod scatter;
mod searched;
mod snapshot;
mod standstill;
mod stop;
mod stress;
mod want;
mod worst;

pub use account::{Account, Book, Shown, Side};
pub use aftermath::{Aftermath, FLIGHT_AFTER};
pub use approach::{Approach, ApproachError};
pub use body_input::BodyInput;
pub use bounce::{Bounce, Rest, StaticContact};
pub use cadence::Cadence;
pub use collision::{BodyResult, Collision, LARGEST_RESIDUAL, STAY_TOGETHER};
pub use deepest::Deepest;
pub use ending::Ending;
pub use far_radius::{far_radius_at_rest, far_radius_of_waves};
pub use frame::Frame;
pub use headline::Headline;
pub use history::{History, RowKind};
pub use instants::{did_not_occur, evenly, fewer_than_asked};
pub use losses::Losses;
pub use moment::Moment;
pub use monitor::{Monitor, Phase, Progress, STEPS_BETWEEN_REPORTS};
pub use probe::{Probe, ProbeRequest, Probes};
pub use pulse::{PEAK_WINDOW, Peaks, Pulse, RESOLVING_ELEMENTS, longest_at_pole};
pub use row::Row;
pub use scatter::Scatter;
pub use searched::Searched;
pub use snapshot::{BodyFields, ContactPlace, ContactProfile, Label, Snapshot, SnapshotRequest};
pub use standstill::{Held, Standstill};
pub use stop::Stop;
pub use stress::{SmallStrain, StressField, StressRecovery, invariants};
pub use want::{Expectation, Want, WantError};
pub use worst::{highest, worst};
