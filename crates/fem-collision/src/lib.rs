//! Input and result of a collision, the same for every model that computes it.
//!
//! ```text
//! input                            during the run                       result
//! BodyInput      a body            Monitor             progress, stop   Collision   all quantities
//! Approach       speed and gap     History             sampled rows     HistoryRow  an instant
//! Expectation    estimates         DissipatedEnergies  sums of powers   Ending      the end of the run
//! OutputRequest  rows, snapshots                                        Snapshot    fields at an instant
//! ```
//!
//! * [`Account`] names a form of energy and [`EnergyLedger`] holds the amount in each. Every model,
//!   phase of a step, column of a history and key of a summary uses the same accounts.
//! * [`SamplingInterval`] sets the steps at which a run is sampled. [`PostContactVibration`] and
//!   [`ForceNoise`] are computed from the samples, and [`ForcePulse`] gives the peaks without
//!   noise.
//! * [`Frame`] converts the relative motion of two bodies to the motion of each.
//! * [`far_radius_of_waves`] and [`far_radius_at_rest`] return the radius that the mesh of a
//!   half-space needs.
//! * [`QuantityOfInterest`] lists the quantities of interest, such as restitution and contact time.
//! * [`RestCriterion`] distinguishes bodies that stay together from those that separate slowly.
//! * [`StressField`] is the stress recovered from a body's fields, [`StressRecovery`] the same for
//!   many fields of one mesh.
//!
//! SI throughout; the axis is y, forces and approach are positive in compression, stress in tension.

mod fields;
mod request;
mod result;
mod run;

/// The name of the program in summaries and checkpoints, which identifies their folders.
pub const PROGRAM: &str = "fem-run";

pub use fields::{
    BodyFields, ContactProfile, ContactProfilePoint, Probe, ProbeRequest, Probes, SmallStrain,
    Snapshot, SnapshotInstant, SnapshotRequest, StressField, StressRecovery, did_not_occur, evenly,
    fewer_than_asked, invariants,
};
pub use request::{
    Approach, ApproachError, BodyInput, Expectation, Frame, OutputRequest, OutputRequestError,
    POST_CONTACT_FRACTION, far_radius_at_rest, far_radius_of_waves,
};
pub use result::{
    BodyResult, Bounce, CandidateRegion, Collision, Ending, MAX_RESIDUAL, PressureRecord,
    QuantityOfInterest, RestState, STAY_TOGETHER, StaticContact, Status, Stop, TangentialErrors,
    TangentialResult,
};
pub use run::{
    Account, BalanceSide, DeepestOverlap, DissipatedEnergies, EnergyLedger, ForceNoise, ForcePulse,
    History, HistoryRow, Monitor, PEAK_WINDOW, Phase, PostContactVibration, Progress, PulsePeaks,
    RESOLVING_ELEMENTS, RelativeMotion, RestCriterion, RowKind, STEPS_BETWEEN_REPORTS,
    SamplingInterval, ShownIn, StepInstant, TangentialRow, energy_key, longest_at_pole,
    nan_aware_max, nan_aware_max_abs,
};
