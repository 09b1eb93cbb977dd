//! The error of a result, and meshes that are refined until it is within the tolerance.
//!
//! **Discretisation error = safety factor × |result − Richardson limit of reference runs| + noise floor.** This is the
//! standard procedure (grid convergence index: Roache 1994, J. Fluids Eng. 116, 405–413; Celik et al. 2008, J. Fluids
//! Eng. 130, 078001; ASME V&V 20-2009), applied to each quantity q:
//!
//! ```math
//! U = F_s\,|q(h) - q_0| + c\,\Bigl(\frac ha\Bigr)^2 + \text{noise}, \qquad
//! q_0 = q_1 + \frac{q_1 - q_2}{r^p - 1}.
//! ```
//!
//! | term | meaning | file |
//! |---|---|---|
//! | q₀ | Richardson limit of two reference runs whose element sizes have the ratio r, with the order p = 1.9 | `reference_runs` |
//! | F_s, c | safety factor and floor, calibrated on random scenes by the claim `error_bars` | `calibration` |
//! | c (h/a)² + noise | errors that no pair of meshes shows: the place of the contact's edge between two nodes, moved mass, contact chatter, rounding | `noise_floor` |
//! | U | the sum | `estimator` |
//!
//! The reference runs take a small share of the run's time:
//!
//! - **Explicit elements**: condensed bodies with the same penalty springs on the same mesh have the same error and cost a
//!   fortieth. The limit is that of condensed bodies whose nodes touch exactly, with the contact's edge at a node of
//!   both meshes. At large strain and with waves, which condensed bodies lack, a run of explicit elements twice as long
//!   is added, and the two estimates are added.
//! - **Condensed bodies**: the same bodies with elements twice as long.
//! - **Meshes from files** cannot be refined: the limit is that of generated meshes.
//! - Closed forms and contact laws have the error of their tolerance.
//!
//! The estimate decides on the mesh (`tolerance_check`, `refinement`, `refinement_cost_bound`) and on the warnings
//! (`tolerance_warnings`). The model-form error is the change by neglected effects (`results/uncertainty.rs`).

pub(crate) mod calibration;
mod elastic_null;
mod estimate;
mod estimator;
mod noise_floor;
mod reference_runs;
mod refinement;
mod refinement_cost_bound;
mod setting;
mod stress_error;
mod tolerance_check;
mod tolerance_warnings;

pub use elastic_null::ElasticNull;
pub use estimate::{BarParts, ErrorEstimate};
pub use estimator::ErrorEstimator;
pub(crate) use noise_floor::{
    MAX_NOISE, MAX_PENETRATION, Overlap, excess_of_restitution, is_unresolved, noise, overlap,
    unbalanced_energy, widest_contact,
};
pub use reference_runs::{CONDENSED_REFERENCE_TIME, first_contact};
pub use refinement::{ComputedCollision, RefinedBeforeRun, collide};
pub use refinement_cost_bound::RefinementBound;
pub use setting::Setting;
pub use stress_error::StressError;
pub use tolerance_warnings::MIN_ACROSS;
pub(crate) use tolerance_warnings::{
    early_pressure_warning, tolerance_warning, unresolved_warning,
};
