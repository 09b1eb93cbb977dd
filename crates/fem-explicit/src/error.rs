//! What can be wrong with a model, and why a run stops early.

use fem_contact::ContactError;
use thiserror::Error;

/// Why no model can be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
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
}

/// Why a run ended before the bodies had separated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Stop {
    /// The caller asked for it.
    #[error("interrupted at {time:.4e} s (step {step})")]
    Interrupted {
        /// Time, s.
        time: f64,
        /// Step number.
        step: u64,
    },
    /// The contact grew out of the part of the boundary that is searched.
    #[error(
        "at {time:.4e} s (step {step}) the contact reached the radius {radius:.4e} m, \
         the end of the region in which it is looked for"
    )]
    ContactBeyondCandidates {
        /// Time, s.
        time: f64,
        /// Step number.
        step: u64,
        /// Candidate radius, m.
        radius: f64,
    },
    /// The energy is not finite or has grown.
    #[error(
        "at {time:.4e} s (step {step}) the energy is {ratio:.4} times the initial: \
         the time integration is unstable"
    )]
    EnergyGrowth {
        /// Time, s.
        time: f64,
        /// Step number.
        step: u64,
        /// Total energy over initial energy.
        ratio: f64,
    },
    /// The bodies stayed together too long.
    #[error("at {time:.4e} s (step {step}) the bodies have not separated")]
    NoSeparation {
        /// Time, s.
        time: f64,
        /// Step number.
        step: u64,
    },
}
