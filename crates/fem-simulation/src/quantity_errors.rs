//! [`QuantityErrors`]: one error for each quantity of interest, and the tolerance of each.

use fem_case::Accuracy;
use fem_collision::QuantityOfInterest;

/// Returns the tolerance of a quantity, absolute for the restitution and otherwise relative; approach and contact radius
/// have none.
pub fn tolerance_of(accuracy: &Accuracy, quantity: QuantityOfInterest) -> Option<f64> {
    match quantity {
        QuantityOfInterest::Restitution => Some(accuracy.restitution),
        QuantityOfInterest::ContactTime => Some(accuracy.contact_time),
        QuantityOfInterest::PeakForce => Some(accuracy.peak_force),
        QuantityOfInterest::PeakPressure => Some(accuracy.peak_pressure),
        QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => None,
    }
}

/// Errors of the quantities in the order of [`QuantityOfInterest::ALL`], SI; `None` if an error is not known. Both parts of
/// an error bar are stored as such: the discretisation error and the model-form error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QuantityErrors([Option<f64>; 6]);

impl QuantityErrors {
    /// The absence of any error.
    pub const ZERO: Self = Self([Some(0.0); 6]);

    /// Returns the errors whose size for each quantity `size` gives.
    pub fn from_fn(size: impl FnMut(QuantityOfInterest) -> Option<f64>) -> Self {
        Self(QuantityOfInterest::ALL.map(size))
    }

    /// Returns the error of one quantity.
    pub fn size(&self, quantity: QuantityOfInterest) -> Option<f64> {
        self.0[quantity as usize]
    }

    /// Replaces the error of one quantity.
    #[must_use]
    pub(crate) fn with(mut self, quantity: QuantityOfInterest, size: f64) -> Self {
        self.0[quantity as usize] = Some(size);
        self
    }

    /// Replaces values that are not finite by `None`.
    pub(crate) fn checked(self) -> Self {
        Self(self.0.map(|error| error.filter(|size| size.is_finite())))
    }

    /// Multiplies all errors by a factor.
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        Self(self.0.map(|error| error.map(|size| share * size)))
    }

    /// Adds two errors of each quantity; `None` if either is.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self::from_fn(|quantity| Some(self.size(quantity)? + other.size(quantity)?))
    }

    /// Replaces unknown errors by zero: sums of these are lower bounds.
    #[must_use]
    pub fn unknown_as_zero(self) -> Self {
        Self(self.0.map(|error| error.or(Some(0.0))))
    }
}
