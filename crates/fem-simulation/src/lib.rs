//! One collision: from a case to results with their error.
//!
//! ```text
//! estimate ─ effects ─ plan ─ models ─ simulation ─ results ─ error
//! closed     what to   mesh,  method   a case and   summary,  discretisation and
//! forms      compute   step            its model    history   model-form error
//! ```
//!
//! [`Simulation`] joins a case and its model. A method refuses a scene with a [`Refusal`] that names
//! a key; the case knows where that stands. [`effects`] says which effects a scene calls for and what
//! follows from what a model has of them.

pub mod effects;
pub mod error;
mod estimate;
mod models;
mod plan;
mod refusal;
pub mod results;
mod simulation;

pub use error::{ErrorEstimate, ErrorEstimator, Level, RefinedBeforeRun, RefinementBound};
pub use estimate::Estimate;
pub use estimate::approach::approach_of;
pub use estimate::quasi_static::ting_impact;
pub use models::method::{Cost, ElementSetup, ForceLaw, Method, Model, Setup, Shared};
pub use models::restart_state::Memory;
pub use models::stepper::Course;
pub use models::{
    AutoMethod, Condensed, CondensedMethod, Considered, ExpectedError, Explicit, ExplicitMethod,
    HertzMethod, LawMethod, METHODS, Reduced, TingMethod, chosen, method_of, model_of,
};
pub use plan::contact_method::{contact_method, unread};
pub use plan::contact_noise_advice::Quieter;
pub use plan::element_size::MeshRule;
pub use plan::meshes::build_meshes;
pub use plan::pair_cache::PairCache;
pub use plan::{Plan, divided_radius};
pub use refusal::Refusal;
pub use results::Summary;
pub use results::diagnostics::assess;
pub use results::stop_advice::{Remedy, remedy_of};
pub use results::stress::BodyStress;
pub use results::warning_kinds::{WarningKind, WarningKinds};
pub use simulation::checkpoint::{
    CheckpointError, CheckpointHead, checkpoint, checkpoint_head, memory_of,
};
pub use simulation::identity::{Identity, case_identity, digest_of, identified, name_of};
pub use simulation::numerics::NUMERICS;
pub use simulation::{ComputedCollision, Simulation, collide};
