//! The front door of fem-run: a case, the model that computes it, and what comes out of it.
//!
//! ```text
//! fem_case::Case ─ Scene ─ Method ─ Model ───────────────────── Collision
//!  text or code     SI     one file  Setup: estimate, plan,      rows, snapshots,
//!                          a method  effects, cost, warnings     quantities, ending
//! ```
//!
//! [`Simulation`] joins a case and its model. A method refuses a scene with a [`Refusal`] that names
//! a key; the case knows where that stands. [`effects`] says which effects a scene calls for and what
//! follows from what a model has of them.
//!
//! Without the feature `files` (on by default) nothing here touches a file: a mesh of a case's own is
//! refused, and what writes result files is not there. Only [`Case::load`] and
//! [`Sweep::load`](sweep::Sweep::load) read files then, those that they are given or that these name.

pub mod accuracy;
mod approach;
mod assess;
mod body_source;
pub mod calibrate;
mod checkpoint;
mod contact_method;
mod course;
mod duration;
mod early_pressure;
pub mod effects;
mod estimate;
mod expected;
mod fineness;
mod finer_meshes;
mod flow;
mod foresight;
mod identity;
mod large_partner;
pub mod laws;
mod limits;
pub mod measured;
mod memory;
mod mesh_source;
mod meshes;
mod method;
mod models;
mod numerics;
mod pair_cache;
mod plan;
mod probes;
mod quasi_static;
mod quieter;
mod refinement;
mod refusal;
mod remedy;
mod resolution;
pub mod results;
mod simulation;
mod soft_springs;
mod softened;
mod stagger;
mod stress;
pub mod sweep;
mod uncertainty;
mod warning_kinds;

pub use approach::approach_of;
pub use assess::assess;
pub use checkpoint::{CheckpointError, CheckpointHead, checkpoint, checkpoint_head, memory_of};
pub use course::Course;
pub use estimate::Estimate;
pub use finer_meshes::MostFiner;
pub use foresight::{Following, Foreseen};
pub use identity::{Identity, case_identity, digest_of};
pub use memory::Memory;
pub use meshes::build_meshes;
pub use method::{Cost, ElementSetup, ForceLaw, Method, Model, Setup, Shared};
pub use models::{
    AutoMethod, Condensed, CondensedMethod, Considered, ExpectedError, Explicit, ExplicitMethod,
    HertzMethod, LawMethod, METHODS, Reduced, TingMethod, method_of, model_of,
};
pub use numerics::NUMERICS;
pub use pair_cache::PairCache;
pub use plan::Plan;
pub use quasi_static::ting_impact;
pub use quieter::Quieter;
pub use refinement::Level;
pub use refusal::Refusal;
pub use remedy::{Remedy, remedy_of};
pub use results::Summary;
pub use simulation::{Simulation, collide};
pub use stress::BodyStress;
pub use sweep::sweep;

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
pub use fem_explicit::{Model as ExplicitBodies, ModelError};
pub use fem_laws::{HertzImpact, Impact, LawError, Pair};
pub use fem_material::{Material, PronySeries};
pub use fem_mesh::SphereMesh;
pub use warning_kinds::{WarningKind, WarningKinds};
