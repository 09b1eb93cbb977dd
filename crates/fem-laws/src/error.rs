//! Errors in the data of a collision.

use fem_material::engineering::number;
use thiserror::Error;

/// A collision that is impossible, or whose numbers leave the range of f64.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LawError {
    /// A quantity that must be positive and finite is not.
    #[error("{quantity} must be positive and finite, found {value}", value = number(*value, 5))]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
    },

    /// Both bodies are rigid walls.
    #[error("a collision needs at least one sphere, found two walls")]
    TwoWalls,

    /// Neither body is a sphere: two half-spaces, or a half-space and a wall.
    #[error("a collision needs at least one sphere, found two bodies without a radius")]
    NoSphere,

    /// Neither body deforms.
    #[error("a collision needs at least one body that deforms, found two rigid ones")]
    TwoRigidBodies,

    /// Both masses are infinite.
    #[error("a collision needs at least one body that moves, found two of infinite mass")]
    NothingMoves,

    /// A quantity that must be at least 0 and finite is not.
    #[error("{quantity} must be at least 0 and finite, found {value}", value = number(*value, 5))]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
    },

    /// A value is outside its valid range.
    #[error("{quantity} must be in {range}, found {value}", value = number(*value, 5))]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
        /// The range of allowed values.
        range: &'static str,
    },

    /// A model is used outside its validity.
    #[error(
        "{quantity} must be at most {limit}, found {}: outside the validity of the model",
        number(*value, 4), limit = number(*limit, 5)
    )]
    OutsideValidity {
        /// Name of the quantity.
        quantity: &'static str,
        /// The value that was found.
        value: f64,
        /// Largest valid value.
        limit: f64,
    },

    /// The integration in time did not reach the end of contact.
    #[error(
        "{model}: no end of contact within {n_steps} steps; reached {time} s",
        time = number(*time, 5)
    )]
    NotFinished {
        /// Name of the model.
        model: &'static str,
        /// The number of steps taken.
        n_steps: usize,
        /// Time reached, s.
        time: f64,
    },
}

/// Returns `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(LawError::NotPositive { quantity, value })
    }
}

/// Returns `value` if it is positive; it may be infinite.
pub(crate) fn positive_or_infinite(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 { Ok(value) } else { Err(LawError::NotPositive { quantity, value }) }
}

/// Returns `value` if it is at least 0 and finite.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value >= 0.0 && value.is_finite() {
        // Makes −0 a 0.
        Ok(value + 0.0)
    } else {
        Err(LawError::Negative { quantity, value })
    }
}

/// Returns `value` if it is a restitution in (0, 1].
pub(crate) fn restitution(value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value <= 1.0 {
        Ok(value)
    } else {
        Err(LawError::OutOfRange { quantity: "restitution", value, range: "(0, 1]" })
    }
}

/// Returns `value` if it is a tolerance that the integration supports.
pub(crate) fn tolerance(value: f64) -> Result<f64, LawError> {
    if (1e-10..=1e-2).contains(&value) {
        Ok(value)
    } else {
        Err(LawError::OutOfRange { quantity: "tolerance", value, range: "1e-10 ..= 1e-2" })
    }
}
