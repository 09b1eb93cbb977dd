//! What can be wrong with the data of a collision.

use fem_material::engineering::number;
use thiserror::Error;

/// A collision that cannot happen, or that f64 cannot hold.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LawError {
    /// Zero, negative, infinite or NaN where only a positive number has a meaning.
    #[error("{quantity} must be positive and finite, found {value:?}")]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value found.
        value: f64,
    },

    /// Two rigid walls.
    #[error("a collision needs at least one sphere, found two walls")]
    TwoWalls,

    /// Two half-spaces, or one and a wall.
    #[error("a collision needs at least one sphere, found two bodies without a radius")]
    NoSphere,

    /// Two bodies that do not deform.
    #[error("a collision needs at least one body that deforms, found two rigid ones")]
    TwoRigidBodies,

    /// Two infinite masses.
    #[error("a collision needs at least one body that moves, found two of infinite mass")]
    NothingMoves,

    /// A negative, infinite or NaN value where 0 or a positive number has a meaning.
    #[error("{quantity} must be at least 0 and finite, found {value:?}")]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value found.
        value: f64,
    },

    /// A value outside the range of its meaning.
    #[error("{quantity} must be in {range}, found {value:?}")]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value found.
        value: f64,
        /// Values allowed.
        range: &'static str,
    },

    /// A model asked for what it does not describe.
    #[error("{quantity} must be at most {limit}, found {}: outside the validity of the model", number(*value, 4))]
    OutsideValidity {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value found.
        value: f64,
        /// Largest valid value.
        limit: f64,
    },

    /// An integration in time that did not reach the end of contact.
    #[error("{model}: no end of contact within {n_steps} steps; reached {time:?} s")]
    NotFinished {
        /// Name of the model.
        model: &'static str,
        /// Steps taken.
        n_steps: usize,
        /// Time reached, s.
        time: f64,
    },
}

/// `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(LawError::NotPositive { quantity, value })
    }
}

/// `value` if it is positive, be it infinite.
pub(crate) fn positive_or_infinite(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 { Ok(value) } else { Err(LawError::NotPositive { quantity, value }) }
}

/// `value` if it is at least 0 and finite.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value >= 0.0 && value.is_finite() {
        // Makes −0 a 0.
        Ok(value + 0.0)
    } else {
        Err(LawError::Negative { quantity, value })
    }
}

/// `value` if it is a restitution that leaves something and gains nothing.
pub(crate) fn restitution(value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value <= 1.0 {
        Ok(value)
    } else {
        Err(LawError::OutOfRange { quantity: "restitution", value, range: "(0, 1]" })
    }
}

/// `value` if an integration can be asked for this accuracy.
pub(crate) fn tolerance(value: f64) -> Result<f64, LawError> {
    if (1e-10..=1e-2).contains(&value) {
        Ok(value)
    } else {
        Err(LawError::OutOfRange { quantity: "tolerance", value, range: "1e-10 ..= 1e-2" })
    }
}
