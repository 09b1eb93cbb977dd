//! The accuracy study: the error and the cost of a case over models, meshes and settings.
//!
//! [`Variants`] transform a case into variants with other models, meshes and settings, from closed forms to
//! fine explicit elements; a table lists the [`Series`] of variants. [`Study`] compares their results, each a
//! [`Measurement`]: the limit of each quantity of interest, the errors of each variant, the sources of
//! error, and the variants for which no other one has both a smaller error and a shorter run.

mod convergence;
mod measurement;
mod series;
mod study;
mod variants;

pub use convergence::{Convergence, Limit, ObservedOrder, PowerLaw};
pub use measurement::Measurement;
pub use series::Series;
pub use study::{ErrorPart, ErrorSource, Study, VariantErrors, VariantRun};
pub use variants::{Variant, Variants};
