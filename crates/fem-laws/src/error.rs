//! What can be wrong with the data of a collision.

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
}

/// `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(LawError::NotPositive { quantity, value })
    }
}
