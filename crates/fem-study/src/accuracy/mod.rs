//! What accuracy costs: how far results are from their limit, and what brings them nearer.
//!
//! A [`Ladder`] is a scene computed in many ways, from closed forms to fine explicit elements, one
//! [`Rung`] each. What the rungs give ([`Measurement`]) is judged together ([`Study`]): the limit to
//! which it tends, how far each rung is from it, where its error comes from, and which rungs no other
//! beats in both error and time.

mod convergence;
mod error_parts;
mod ladder;
mod limit;
mod measurement;
mod power_law;
mod rung;
mod stress_places;
mod study;

pub use convergence::{Convergence, ObservedOrder};
pub use error_parts::{ErrorPart, ErrorSource};
pub use fem_simulation::error::{BarParts, CONDENSED_REFERENCE_TIME, Setting};
pub use ladder::{Ladder, Lengths};
pub use limit::Limit;
pub use measurement::Measurement;
pub use power_law::PowerLaw;
pub use rung::{Rung, Series};
pub use study::{Judged, Study};
