//! What accuracy costs: how far results are from their limit, and what brings them nearer.
//!
//! A [`Ladder`] is a scene computed in many ways, from closed forms to fine explicit elements, one
//! [`Rung`] each. What the rungs give ([`Measurement`]) is judged together ([`Study`]): the limit to
//! which it tends, how far each rung is from it, where its error comes from, and which rungs no other
//! beats in both error and time.

mod coarser;
mod companion;
mod convergence;
mod discretisation;
mod error_parts;
mod foretold;
mod ladder;
mod limit;
mod margins;
mod measurement;
mod power_law;
mod rung;
mod setting;
mod stress_places;
mod study;

pub use coarser::condensed_companion_time;
pub(crate) use companion::{Beside, Coarser, ORDER, companion_updates};
pub use convergence::{Convergence, ObservedOrder};
pub(crate) use discretisation::{discretisation_errors, far_mesh_errors, far_mesh_key};
pub use error_parts::{ErrorPart, ErrorSource};
pub(crate) use foretold::{ByCoarser, foretold_errors, foretold_lengthening, lengthening};
pub use ladder::{Ladder, Lengths};
pub use limit::Limit;
pub(crate) use margins::{FEW, of_moved_mass, scatter_of_any_mesh};
pub use measurement::Measurement;
pub use power_law::PowerLaw;
pub use rung::{Rung, Series};
pub use setting::Setting;
pub use study::{Judged, Study};
