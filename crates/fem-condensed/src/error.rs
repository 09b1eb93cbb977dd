//! Reasons why a pair cannot be condensed or its collision cannot be computed.

use fem_collision::{ApproachError, Stop};
use fem_contact::ContactError;
use fem_material::engineering::{number, show};
use thiserror::Error;

/// Errors of condensed pairs, and the limits of the model.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CondensedError {
    /// The surfaces make no contact.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A setting lies outside of its range.
    #[error("{name} is {value}; allowed is {allowed}", value = number(*value, 5))]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Value that was given.
        value: f64,
        /// Range that is allowed.
        allowed: &'static str,
    },
    /// The bodies do not meet.
    #[error(transparent)]
    Approach(#[from] ApproachError),
    /// The stiffness matrix has no Cholesky factor.
    #[error(
        "the stiffness matrix of a body is not positive definite: an element is degenerate or \
         Poisson's ratio too near to its limits"
    )]
    NotPositiveDefinite,
    /// There is not enough memory for a factor.
    #[error("there is not enough memory for the factor of a body's stiffness matrix")]
    OutOfMemory,
    /// The contact grows beyond the condensed nodes already without relaxation.
    #[error(
        "the contact reached the radius {}, the end of the region that was condensed", show(*radius, "m")
    )]
    ContactBeyondCandidates {
        /// Candidate radius, m.
        radius: f64,
    },
    /// A collision was stopped before its end.
    #[error(transparent)]
    Stopped(#[from] Stop),
}
