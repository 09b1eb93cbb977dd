//! The accuracy study: the error and the cost of a case over models, meshes and settings.
//!
//! [`Variants`] are a scene with different models, meshes and settings, from closed forms to fine explicit
//! elements; each is a [`Variant`]. [`Study`] compares their results ([`Measurement`]): the limit of each
//! quantity of interest, the error of each variant and its sources, and the variants for which no other one
//! has both a smaller error and a shorter run.

mod convergence;
mod error_parts;
mod limit;
mod measurement;
mod power_law;
mod stress_places;
mod study;
mod variant;
mod variants;

pub use convergence::{Convergence, ObservedOrder};
pub use error_parts::{ErrorPart, ErrorSource};
pub use fem_simulation::error::{BarParts, CONDENSED_REFERENCE_TIME, Setting};
pub use limit::Limit;
pub use measurement::Measurement;
pub use power_law::PowerLaw;
pub use study::{Study, VariantErrors};
pub use variant::{Series, Variant};
pub use variants::{Lengths, Variants};
