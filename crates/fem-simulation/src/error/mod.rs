//! The error of a result: discretisation error, model-form error, and finer meshes until the tolerance is met.
//!
//! The discretisation error of each quantity q follows the standard procedure (grid convergence index: Roache 1994,
//! J. Fluids Eng. 116, 405–413; Celik et al. 2008, J. Fluids Eng. 130, 078001; ASME V&V 20-2009):
//!
//! ```math
//! U = F_s\,|q(h) - q_0| + c\,\Bigl(\frac ha\Bigr)^2 + \text{noise}, \qquad
//! q_0 = q_1 + \frac{q_1 - q_2}{r^p - 1},
//! ```
//!
//! with q₀ the Richardson limit of two runs whose elements differ by the ratio r, the order p = 1.9 that is observed, a
//! safety factor F_s, and a floor: the place of the contact's edge between two nodes adds an error that no pair of
//! meshes shows, of second order in h over the contact radius a; added mass, contact chatter and rounding add noise.
//! All constants are in `calibration`, calibrated by the claim `error_bars`.
//!
//! The reference runs (`reference_runs`) cost a small share of the run:
//!
//! - **Explicit elements**: condensed bodies with the same penalty springs on the same mesh have the same error, and
//!   cost a fortieth. Their limit is that of condensed bodies whose nodes touch exactly, with the contact's edge at a
//!   node of both meshes. At large strain and beside waves, which condensed bodies lack, a run of the model itself with
//!   elements twice as long is added, and both estimates count.
//! - **Condensed bodies**: the same bodies with elements twice as long.
//! - **Meshes from files** have neither coarser nor finer ones: the limit is that of meshes that are made here.
//! - Closed forms and contact laws have the error of their tolerance.

mod advice;
mod calibration;
mod elastic_null;
mod estimator;
mod model_form;
mod noise_floor;
mod reference_runs;
mod refinement;
mod refinement_cost_bound;
mod setting;
mod tolerance_check;

pub(crate) use advice::{
    early_pressure_warning, is_unresolved, tolerance_warning, unresolved_warning, widest_contact,
};
pub use elastic_null::ElasticNull;
pub use estimator::{BarParts, ErrorEstimate, ErrorEstimator};
pub(crate) use model_form::uncertainty;
pub(crate) use noise_floor::{LARGEST_NOISE, excess_of_restitution, noise, unbalanced_energy};
pub use reference_runs::{CONDENSED_REFERENCE_TIME, first_contact};
pub(crate) use refinement::refined_because;
pub use refinement::{RefinedBeforeRun, RefinementLevel};
pub use refinement_cost_bound::RefinementBound;
pub(crate) use refinement_cost_bound::refinement_bound;
pub use setting::Setting;
