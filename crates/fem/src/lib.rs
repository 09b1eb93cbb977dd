//! The front door of fem-run: a case, the model that computes it, and what comes out of it.
//!
//! ```text
//! fem_case::Case ─ Scene ─ Method ─ Model ───────────────────── Collision
//!  text or code     SI     one file  Setup: estimate, plan,      rows, snapshots,
//!                          a method  effects, cost, warnings     quantities, ending
//! ```
//!
//! One collision is computed by crate `fem-simulation`, many by `fem-study`; their items are here under
//! one name, beside those of the crates below that a caller needs.
//!
//! Without the feature `files` (on by default) nothing here touches a file: a mesh of a case's own is
//! refused, and what writes result files is not there. Only [`Case::load`] and
//! [`Sweep::load`](sweep::Sweep::load) read files then, those that they are given or that these name.

pub use fem_simulation::{
    AutoMethod, BodyStress, CheckpointError, CheckpointHead, ComputedCollision, Condensed,
    CondensedMethod, ContactNoiseAdvice, Cost, ElementSetup, ErrorEstimate, ErrorEstimator,
    Estimate, ExpectedError, Explicit, ExplicitMethod, ForceLaw, HertzMethod, Identity, LawMethod,
    METHODS, Method, Model, ModelCandidate, ModelSetup, NUMERICS, PairCache, Plan, Reduced,
    RefinedBeforeRun, RefinementBound, RefinementLevel, Rejection, RestartState, SharedModels,
    Simulation, Stepper, StopAdvice, Summary, TingMethod, WarningKind, WarningKinds, approach_of,
    build_meshes, case_identity, checkpoint, checkpoint_head, collide, diagnose, digest_of,
    effects, method_of, model_of, restart_state_of, results, stop_advice, ting_impact,
};
pub use fem_study::sweep::sweep;
pub use fem_study::{accuracy, calibrate, fit, laws, measured, sweep};

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
pub use fem_material::{Material, PronySeries};
pub use fem_mesh::SphereMesh;
