//! Computes one collision, from a case to results with their error.
//!
//! ```text
//! estimate ─ effects ─ plan ─ models ─ simulation ─ error ────────── results
//! closed     what to   mesh,  method   a case and   discretisation   summary, history,
//! forms      compute   step            its model    error, finer     warnings, model-
//!                                                   meshes           form error
//! ```
//!
//! [`Simulation`] joins a case and its model. A method rejects a scene with a [`Rejection`] that names a key of the case.
//! [`effects`] decides which effects a scene calls for, and compares them with those that a model has.

pub mod effects;
pub mod error;
mod estimate;
mod models;
mod plan;
mod quantity_errors;
mod rejection;
pub mod results;
mod simulation;

pub use effects::{
    bounds_of_closed_forms, computed_flow, radiating_half_spaces, restitution_with_adhesion,
};
pub use error::{
    ComputedCollision, ErrorEstimate, ErrorEstimator, RefinedBeforeRun, RefinementBound, collide,
};
pub use estimate::approach::approach_of;
pub use estimate::plastic_flow::{FlowingImpact, flowing_impact};
pub use estimate::plate_impact::free_plate;
pub use estimate::quasi_static::{surfaces_slip, ting_impact};
pub use estimate::{Estimate, Regime};
pub use models::method::{
    Cost, ElementSetup, ExpectedRun, Method, Model, ModelSetup, SharedModels,
};
pub use models::stepper::{RefinementLevel, RestartState, Stepper};
pub use models::{
    AutoMethod, Condensed, CondensedMethod, ExpectedError, Explicit, ExplicitMethod, METHODS,
    ModelCandidate, ObliqueRebound, ObliqueResponse, Reduced, ReducedMethod, method_of,
    selected_model,
};
pub use plan::body_source::build_meshes;
pub use plan::contact_method::{ContactNoiseAdvice, contact_method, ignored_method_warning};
pub use plan::element_size::MeshRule;
pub use plan::pair_cache::PairCache;
pub use plan::{Plan, divided_radius};
pub use quantity_errors::{QuantityErrors, tolerance_of};
pub use rejection::Rejection;
pub use results::Summary;
pub use results::diagnostics::diagnose;
pub use results::grouped_warnings::{WarningKind, WarningKinds};
pub use results::stop_advice::{StopAdvice, stop_advice};
pub use simulation::Simulation;
pub use simulation::checkpoint::{
    CheckpointError, CheckpointHead, checkpoint, checkpoint_head, restart_state_of,
};
pub use simulation::identity::{Identity, NUMERICS, case_identity, digest_of, identified, name_of};
pub use simulation::stress::BodyStress;
