//! Errors of fits, inverse problems and cradle trials.

use fem_laws::LawError;
use fem_material::engineering::number;
use thiserror::Error;

/// Data that do not determine what is asked for, or a collision that cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FitError {
    /// A collision that cannot happen.
    #[error(transparent)]
    Law(#[from] LawError),

    /// Fewer data than parameters.
    #[error(
        "{n_values} measured {} cannot determine {n_free} parameters ({free})",
        if *n_values == 1 { "value" } else { "values" }
    )]
    TooFewData {
        /// Number of measured values.
        n_values: usize,
        /// Number of free parameters.
        n_free: usize,
        /// Keys of the free parameters.
        free: String,
    },

    /// A parameter that changes nothing in the data.
    #[error("the data do not depend on {key}: there every value of it fits as well")]
    Insensitive {
        /// Key of the parameter.
        key: &'static str,
    },

    /// Parameters that the data determine only together.
    #[error(
        "the data do not tell {keys} apart: a change of one is made up for by the others \
         (condition number {condition:.1e})"
    )]
    Degenerate {
        /// The parameters that take part.
        keys: String,
        /// Condition number of the Jacobian with its columns scaled to length 1.
        condition: f64,
    },

    /// Nothing to fit.
    #[error("no parameter is free")]
    NothingFree,

    /// The minimum was not reached.
    #[error("the fit did not converge: {reason}")]
    NotConverged {
        /// Message of the least-squares library.
        reason: String,
    },

    /// No value of the parameter gives the restitution.
    #[error(
        "no {key} gives a restitution of {wanted} at {} m/s: from {} to {} it runs from \
         {} to {}", number(*speed, 4), number(range.0, 4), number(range.1, 4), near_one(*least), near_one(*most)
    )]
    NoSolution {
        /// Key of the parameter.
        key: &'static str,
        /// The wanted restitution.
        wanted: f64,
        /// Approach speed, m/s.
        speed: f64,
        /// Values of the parameter that were tried, SI.
        range: (f64, f64),
        /// Smallest restitution within.
        least: f64,
        /// Largest value that is allowed.
        most: f64,
    },

    /// A number outside the range of its meaning.
    #[error("{quantity} must be {allowed}, found {value:?}")]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
        /// The range of allowed values.
        allowed: &'static str,
    },

    /// Another end than the law's own.
    #[error("{law} ends at zero force by its definition")]
    OwnEnd {
        /// Name of the quantity.
        law: &'static str,
    },

    /// A collision of a model outside of this crate.
    #[error("a collision cannot be computed: {reason}")]
    Collision {
        /// Message of the model.
        reason: String,
    },

    /// Ting's model of bodies that do not relax.
    #[error("no body relaxes, so there is no decay rate to find")]
    NoRelaxation,
}

/// Formats a restitution with enough digits to distinguish it from 0 and 1.
fn near_one(restitution: f64) -> String {
    match restitution {
        e if e > 0.9999 => format!("1 - {:.1e}", 1.0 - e),
        e if e < 1e-3 => format!("{e:.1e}"),
        e => format!("{e:.4}"),
    }
}
