//! Explicit dynamics of two viscoelastic bodies in contact, at small or finite strain.
//!
//! ```math
//! M \ddot u = -\int B^T (K_{bulk} + G\,dev)\, d V + f_{nodes} + f_{contact}
//! ```
//!
//! Strains of a glass collision are of the order of 1 %, so the bodies are linear: geometry is
//! computed once, and a step touches only nodal vectors. Elements are axisymmetric quads with one
//! mean stress and hourglass stiffness ([`fem_element`]), masses are lumped, time is stepped by
//! central differences at a step that is proved stable for bodies and contact alike ([`Model`]).
//!
//! A body may be computed at finite strain instead, by a law of [`fem_material::finite`]
//! ([`Parts::finite_strain`]): total Lagrangian elements, which still read the undeformed geometry
//! alone. Their stiffness changes, and the step follows the critical one of the deformed bodies.
//!
//! What acts on the nodes are parts behind three ports, chosen once, when the model is built:
//!
//! ```text
//! a step                     Stress                NodeForce             Contact
//!                            of each body          list of each body     of both bodies
//!                            elastic               bulk viscosity,       massless boundary,
//!                            constant_poisson      or none               penalty springs
//!                            relaxing_shear
//!                            finite
//!
//! update forces              subtract_forces       add_forces            add_forces
//! observe: log, ledger,      add_energies          add_energies          contact_radius,
//!   observed, history,       effective                                   centre_pressure,
//!   recorder                                                             is_closed_next
//! where stiffness changes     add_stiffness_bound,
//!   bound the step           strain_rate, urgency
//! advance: nodes (leapfrog)
//!   what stress remembers    advance
//!   what contact remembers,                                              advance
//!   nodes without mass       shift
//!   what forces remember                           advance
//!
//! when the model is built    largest_eigenvalue    add_stiffness_bound   add_stiffness_bound
//!                            stiffness_of_step     add_damping_bound     massless_nodes
//!                            set_time_step         set_time_step         set_time_step
//! ```
//!
//! A part declares the nodal fields of history that it needs; the run keeps them beside displacement
//! and velocity, in a [`Memory`] that is all of a restart. A part tells what it stores, gives and
//! dissipates to [`Accounts`], which the ledger balances. What is off is absent: an elastic body has
//! no history, an empty list costs nothing.
//!
//! A rigid sphere is a body of one node that carries its mass, without stress: contact gives it the sum
//! of its forces, its list of forces acts on it as on any node, and it has no elements. A wall is the
//! same with infinite mass and no forces.
//!
//! [`collide`] runs a [`Model`] from first touch until the bodies have separated and returns a
//! [`Collision`](fem_collision::Collision): history with energy ledger, snapshots, and the quantities
//! of the collision; [`Run`] is the same in steps. [`FreeMotion`] is one body without contact.

mod body;
mod boundary_mass;
mod contact;
mod contact_log;
mod contact_work;
mod error;
mod fingerprint;
mod forces;
mod free_motion;
mod ledger;
mod lumped;
mod memory;
mod model;
mod motion;
mod nodal_sums;
mod observed;
mod outcome;
mod pace;
mod part;
mod probing;
mod recorder;
mod run;
mod snapshot;
mod sound;
mod stability;
mod state;
mod step;
mod stress;
#[cfg(test)]
mod test_support;
#[cfg(test)]
mod tests;
mod time_step;

pub use body::Body;
pub use contact::{Contact, ContactMethod, Massless, MovedContact};
pub use error::ModelError;
pub use forces::{BulkViscosity, NodeForce, ViscosityCoefficients, Weight};
pub use free_motion::FreeMotion;
pub use memory::Memory;
pub use model::{Model, Parts, Settings};
pub use part::{Accounts, Field, Motion, MotionMut, NodalField, Part};
pub use run::{Run, collide};
pub use snapshot::n_states;
pub use stress::{Collapse, LumpedElement, MOST_FINITE_STRAIN_TERMS, Stress, Unstable};
