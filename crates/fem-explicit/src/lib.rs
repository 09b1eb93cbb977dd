//! Explicit dynamics of two small-strain viscoelastic bodies in contact.
//!
//! ```math
//! M \ddot u = -\int B^T (K_{bulk} + G\,dev)\, d V + f_{contact}
//! ```
//!
//! Strains of a glass collision are of the order of 1 %, so the bodies are
//! linear: geometry is computed once, and a step touches only nodal vectors.
//! Elements are axisymmetric quads with one mean stress and hourglass stiffness
//! ([`fem_element`]), masses are lumped, time is stepped by central differences
//! at a step that is proved stable for bodies and contact alike ([`Model`]).
//! Viscoelastic bodies keep one nodal vector a Prony term.
//!
//! [`collide`] runs a [`Model`] from first touch until the bodies have separated
//! and returns a [`Collision`](fem_collision::Collision): history with energy
//! ledger, snapshots, and the quantities of the collision. [`FreeMotion`] is one
//! body without contact.

mod block;
mod body;
mod contact_log;
mod error;
mod free_motion;
mod kernel;
mod lanes;
mod ledger;
mod memory;
mod model;
mod nodes;
mod recorder;
mod run;
mod snapshot;
mod state;
mod step;
#[cfg(test)]
mod test_support;
#[cfg(test)]
mod tests;
mod time_step;

pub use body::Body;
pub use error::ModelError;
pub use free_motion::FreeMotion;
pub use memory::Memory;
pub use model::{Model, Settings};
pub use run::{Run, Status, collide};
pub use snapshot::n_states;
