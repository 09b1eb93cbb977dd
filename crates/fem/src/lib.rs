//! The library of fem-run: a case, the model that computes it, and its results.
//!
//! ```text
//! fem_case::Case ─ Scene ─ Method ─ Model ───────────────────── Collision
//!  text or code     SI     per key   ModelSetup: estimate,       rows, snapshots,
//!                                    plan, effects, cost         quantities, ending
//! ```
//!
//! Crate `fem-simulation` computes one collision, `fem-study` many, and `fem-data` reads measurements. Their items are re-exported here, with those of the
//! crates below that a caller needs.
//!
//! Without the feature `files` (on by default) the library accesses no files: mesh files of a case are rejected, and the
//! functions that write result files are absent. Only [`Case::load`] and [`Sweep::load`](sweep::Sweep::load) read the
//! files that they are given or that these name.

pub use fem_simulation::{
    AutoMethod, BodyStress, CheckpointError, CheckpointHead, ComputedCollision, Condensed,
    CondensedMethod, ContactNoiseAdvice, Cost, ElementSetup, ErrorEstimate, ErrorEstimator,
    Estimate, ExpectedError, Explicit, ExplicitMethod, Identity, METHODS, Method, Model,
    ModelCandidate, ModelSetup, NUMERICS, PairCache, Plan, QuantityErrors, Reduced, ReducedMethod,
    RefinedBeforeRun, RefinementBound, RefinementLevel, Regime, Rejection, RestartState,
    SharedModels, Simulation, Stepper, StopAdvice, Summary, WarningKind, WarningKinds, approach_of,
    build_meshes, case_identity, checkpoint, checkpoint_head, collide, diagnose, digest_of,
    divided_radius, effects, error, method_of, restart_state_of, results, stop_advice, ting_impact,
    tolerance_of,
};
pub use fem_study::sweep::sweep;
pub use fem_study::{accuracy, calibrate, laws, sweep};

pub use fem_data::relaxation;

/// Fits to restitutions, the inputs of DEM codes and Newton's cradle.
pub mod fit {
    pub use fem_data::estimate::*;
    pub use fem_data::{dem, instruments::cradle};
}

/// Tables and other texts with measurements.
pub mod measured {
    pub use fem_data::instruments::cradle_trials;
    pub use fem_data::table::*;
}

/// Records of bouncing balls.
pub mod records {
    pub use fem_data::instruments::*;
}

pub use fem_case::{
    Body, Case, CaseError, CaseFile, ModelChoice, Quantity, Scene, Shape, library, schema,
};
pub use fem_collision::{
    Account, Approach, ApproachError, BalanceSide, BodyFields, BodyResult, Bounce, CandidateRegion,
    Collision, ContactProfile, ContactProfilePoint, Ending, EnergyLedger, Expectation, HistoryRow,
    Monitor, OutputRequest, OutputRequestError, Phase, Progress, QuantityOfInterest, RestState,
    ShownIn, Snapshot, SnapshotInstant, SnapshotRequest, StaticContact, Stop, StressField,
    invariants,
};
pub use fem_condensed::CondensedPair;
pub use fem_explicit::{ExplicitBodies, ModelError};
pub use fem_laws::{HertzImpact, Impact, LawError, Pair};
pub use fem_material::{GAS_CONSTANT, Material, PronySeries, ShiftLaw, ZERO_CELSIUS};
pub use fem_mesh::SphereMesh;
