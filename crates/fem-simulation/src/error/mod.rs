//! How far a result is from its limit, and finer meshes until that is within the tolerance.

mod coarser;
mod companion;
mod discretisation;
pub(crate) mod early_pressure;
pub(crate) mod finer_meshes;
pub(crate) mod foresight;
mod foretold;
mod margins;
pub(crate) mod refinement;
pub(crate) mod resolution;
mod setting;
pub(crate) mod uncertainty;

pub use coarser::condensed_companion_time;
pub use companion::first_contact;
pub(crate) use companion::{Beside, Coarser, ORDER, companion_updates};
pub(crate) use discretisation::{discretisation_errors, far_mesh_errors, far_mesh_key};
pub(crate) use foretold::{ByCoarser, foretold_errors, foretold_lengthening, lengthening};
pub(crate) use margins::{FEW, of_moved_mass, scatter_of_any_mesh};
pub use setting::Setting;
