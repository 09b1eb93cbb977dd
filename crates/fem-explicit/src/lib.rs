//! Explicit dynamics of two viscoelastic bodies in contact, at small or finite strain.
//!
//! ```math
//! M \ddot u = -\int B^T (K_{bulk} + G\,dev)\, d V + f_{nodes} + f_{contact}
//! ```
//!
//! Strains in a collision of glass are of the order of 1 %, so bodies are linear by default: the geometry is integrated
//! once, and a step reads and writes nodal vectors alone. Elements are axisymmetric quads with one mean stress and
//! hourglass stiffness ([`fem_element`]), masses are lumped, and time is advanced by central differences, with a step
//! that is proved stable for bodies and contact ([`ExplicitBodies`]).
//!
//! A body may be at finite strain instead, by a law of [`fem_material::finite`] ([`ModelParts::finite_strain`]). Its
//! elements are total Lagrangian and read the undeformed geometry too. Their stiffness changes, and the time step
//! follows the critical step of the deformed bodies.
//!
//! A step is a list of phases. Stress, forces on nodes and contact are parts, chosen once when the model is built:
//!
//! ```text
//! phase of a step               stress of a body         forces on nodes         contact
//!                               (internal trait Stress)  (NodeForce, a list)     (Contact)
//!                               elastic, prony, finite   viscosity, weight       springs, massless, moved
//!
//! forces                        subtract_forces          add_forces              add_forces
//! time step (finite strain)     add_stiffness_bound,                             add_bound_growth
//!                               strain_rate,
//!                               allowance_rate
//! observe and record            add_energies             add_energies            add_energies,
//!                                                                                radius_and_pressure,
//!                                                                                is_closed_next
//! motion: nodes (leapfrog)
//!   history of the stress       advance
//!   contact, massless nodes     shift                                            advance
//!   history of the forces                                advance
//!
//! when the model is built       largest_eigenvalues,     add_stiffness_bound,    add_stiffness_bound,
//!                               stiffness_of_step        add_damping_bound       massless_nodes
//!                               set_time_step            set_time_step           set_time_step
//! ```
//!
//! A part declares the fields of history that it needs. The run keeps them with displacement and velocity, in a
//! [`RunState`]. A part adds the energies that it stores, gives and dissipates to [`Accounts`], which the ledger
//! balances. A part that is switched off is absent: an elastic body has no history, and an empty list costs nothing.
//!
//! A rigid sphere is a body of one node that carries its mass, without stress and elements: the contact adds its forces
//! to that node. A wall is the same with infinite mass and without forces.
//!
//! [`collide`] runs [`ExplicitBodies`] from first touch until the bodies have separated and returns a
//! [`Collision`](fem_collision::Collision): history with energies, snapshots, and the quantities of the collision.
//! [`Run`] does the same in pieces. [`FreeMotion`] is one body without contact.
//!
//! ```text
//! run        a run in steps, its restart state, its stops, its results
//! energy     balance of energy and momentum
//! snapshots  snapshots, probes, and which states are kept
//! state      state of a run, scratch space
//! model      bodies, contact and time step, constant over a run
//! body       masses, bounds of the stiffness, state of a body
//! contact    contact methods
//! forces     forces on nodes: bulk viscosity, weight
//! stress     stress at small and at finite strain
//! time       leapfrog, time step control
//! lanes      several elements at once
//! ```

mod body;
mod contact;
mod energy;
mod error;
mod forces;
mod free_motion;
mod lanes;
mod model;
mod part;
mod run;
mod settings;
mod snapshots;
mod state;
mod stress;
#[cfg(test)]
mod test_support;
#[cfg(test)]
mod tests;
mod time;

pub use body::Body;
pub use contact::{Contact, DeformedContact, Massless, SmallStrainContact, Springs};
pub use error::ModelError;
pub use forces::{BulkViscosity, NodeForce, ViscosityCoefficients, Weight};
pub use free_motion::FreeMotion;
#[doc(hidden)]
pub use lanes::limit_lanes;
pub use model::{ExplicitBodies, ModelParts};
pub use part::{Accounts, Field, Motion, MotionMut, NodalField, Part};
pub use run::{Run, RunState, collide};
pub use settings::Settings;
pub use snapshots::n_states;
pub use stress::{Collapse, MAX_FINITE_STRAIN_TERMS};
