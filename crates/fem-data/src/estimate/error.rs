//! Errors of fits, inverse problems and cradle trials.

use fem_laws::{LawError, LawParameter};
use fem_material::engineering::{number, show, takes_prefix};
use thiserror::Error;

/// The data do not determine the result, or a collision cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FitError {
    /// The collision is impossible.
    #[error(transparent)]
    Law(#[from] LawError),

    /// There are fewer data than parameters.
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

    /// The data do not depend on a parameter.
    #[error("the data do not depend on {key}: there every value of it fits as well")]
    Insensitive {
        /// Key of the parameter.
        key: &'static str,
    },

    /// The data determine some parameters only together.
    #[error(
        "the data do not tell {keys} apart: a change of one is made up for by the others \
         (condition number {condition:.1e})"
    )]
    Degenerate {
        /// Keys of these parameters.
        keys: String,
        /// Condition number of the Jacobian with its columns scaled to length 1.
        condition: f64,
    },

    /// There is nothing to fit.
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
        "no {} gives a restitution of {wanted} at {}: from {} to {} it runs from {} to {}",
        parameter.key, show(*speed, "m/s"), shown(range.0, parameter), shown(range.1, parameter), near_one(*least), near_one(*most),
        wanted = number(*wanted, 5)
    )]
    NoSolution {
        /// The parameter that is searched.
        parameter: &'static LawParameter,
        /// The wanted restitution.
        wanted: f64,
        /// Approach speed, m/s.
        speed: f64,
        /// Smallest and largest value of the parameter in the search, SI.
        range: (f64, f64),
        /// Smallest restitution in the search.
        least: f64,
        /// Largest restitution in the search.
        most: f64,
    },

    /// A number is out of range.
    #[error("{quantity} must be {allowed}, found {value}", value = number(*value, 5))]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
        /// The range of allowed values.
        allowed: &'static str,
    },

    /// The law ends contacts by another rule.
    #[error("{law} ends at zero force by its definition")]
    OwnEnd {
        /// Name of the quantity.
        law: &'static str,
    },

    /// No closed form has the plate.
    #[error(
        "a plate that is bonded below is computed by finite elements only, and not at the many speeds of a fit"
    )]
    BondedPlate,

    /// Another model cannot compute a collision.
    #[error("a collision cannot be computed: {reason}")]
    Collision {
        /// Message of the model.
        reason: String,
    },

    /// No body relaxes, as Ting's model needs.
    #[error("no body relaxes, so there is no decay rate to find")]
    NoRelaxation,
}

fn shown(value: f64, parameter: &LawParameter) -> String {
    match parameter.unit {
        unit if takes_prefix(unit) => show(value, unit),
        unit => format!("{} {unit}", number(value, 4)).trim_end().to_string(),
    }
}

/// Formats a restitution with enough digits to distinguish it from 0 and 1.
fn near_one(restitution: f64) -> String {
    match restitution {
        e if e > 0.9999 => format!("1 - {:.1e}", 1.0 - e),
        0.0 => "0".to_string(),
        e if e < 1e-3 => format!("{e:.1e}"),
        e => format!("{e:.4}"),
    }
}
