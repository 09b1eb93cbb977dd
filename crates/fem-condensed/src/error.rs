//! Why a pair cannot be condensed, or its collision not be computed.

use fem_contact::ContactError;
use thiserror::Error;

/// What went wrong, and where the condensed model ends.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CondensedError {
    /// The surfaces make no contact.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A setting lies outside of its range.
    #[error("{name} is {value}; allowed is {allowed}")]
    Setting {
        /// Which setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The bodies do not approach each other.
    #[error("the bodies approach each other at {0} m/s; it must be positive and finite")]
    NotApproaching(f64),
    /// The stiffness matrix has no Cholesky factor.
    #[error(
        "the stiffness matrix of a body is not positive definite: an element is degenerate or \
         Poisson's ratio too near to its limits"
    )]
    NotPositiveDefinite,
    /// There is no memory for a factor.
    #[error("there is not enough memory for the factor of a body's stiffness matrix")]
    OutOfMemory,
    /// The contact grew out of the nodes that were condensed.
    #[error(
        "the contact reached the radius {radius:.4e} m, the end of the region that was condensed"
    )]
    ContactBeyondCandidates {
        /// Candidate radius, m.
        radius: f64,
    },
    /// Even the whole near hemisphere is too small for the contact.
    #[error(
        "the contact reached {ratio:.2} of the smaller radius: the bodies are not linear there; \
         lower the speed"
    )]
    ContactTooLarge {
        /// Contact radius over the smaller sphere's.
        ratio: f64,
    },
    /// The bodies stayed together too long.
    #[error("at {time:.4e} s ({steps} steps) the bodies have not separated")]
    NoSeparation {
        /// Time since first touch, s.
        time: f64,
        /// Steps done.
        steps: usize,
    },
    /// The contact problem of a step has no solution within reach.
    #[error("at {time:.4e} s no contact state without tension and overlap was found")]
    NoContactState {
        /// Time since first touch, s.
        time: f64,
    },
    /// Energy came from nowhere.
    #[error("at {time:.4e} s the energy does not add up by {relative:.1e} of the initial")]
    EnergyImbalance {
        /// Time since first touch, s.
        time: f64,
        /// Imbalance over the initial energy.
        relative: f64,
    },
    /// Whoever looked on stopped it.
    #[error("interrupted at {time:.4e} s, step {steps}")]
    Interrupted {
        /// Time since first touch, s.
        time: f64,
        /// Steps done.
        steps: usize,
    },
}
