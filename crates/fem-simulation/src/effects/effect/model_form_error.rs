//! Model-form error: the change of each result by the neglected effects.
//!
//! If an effect changes contact time and peak force by the shares t and f, the other quantities follow from
//! Hertz' powers of a softer contact's E* (T, δ ∝ E*^(−2/5), a ∝ E*^(−1/5), F ∝ E*^(2/5), p₀ ∝ F/a²):
//!
//! ```math
//! \frac{\Delta\delta}\delta = t, \qquad \frac{\Delta a}a = \tfrac12 t, \qquad
//! \frac{\Delta p_0}{p_0} = f + t .
//! ```
//!
//! The errors of several effects are combined as **the sum of their magnitudes**. Closed forms give no
//! signs, and the causes are not independent, as a root of squares would require: all grow with contact
//! radius and speed, and most make the contact softer.

use fem_collision::QuantityOfInterest;

use crate::effects::NeglectError;
use crate::estimate::Estimate;

/// Model-form error of each quantity in the order of [`QuantityOfInterest::ALL`], in SI units; `None` if
/// closed forms cannot estimate it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModelFormError([Option<f64>; 6]);

/// The status of an effect in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EffectStatus {
    /// Whether the run lacks the effect.
    pub is_lacking: bool,
    /// Error of neglecting the effect ([`Effect::neglect_error`](super::Effect::neglect_error)).
    pub neglect_error: Option<NeglectError>,
}

impl ModelFormError {
    /// The absence of any error.
    pub const NOTHING: Self = Self([Some(0.0); 6]);

    /// Returns the error whose size for each quantity `size` gives.
    pub fn from_fn(size: impl FnMut(QuantityOfInterest) -> Option<f64>) -> Self {
        Self(QuantityOfInterest::ALL.map(size))
    }

    /// Returns the error that follows from neglecting an effect.
    pub fn of(neglect_error: &NeglectError, estimate: &Estimate) -> Self {
        let NeglectError { restitution, contact_time_s, peak_force_n } = *neglect_error;
        let sizes = &estimate.effective.sizes;
        let time = contact_time_s.map(|change| change / sizes.contact_time);
        let force = peak_force_n.map(|change| change / sizes.peak_force);
        let both = time.zip(force);
        // Bodies that stay together have no contact time, and come as much closer as they press less.
        let softer = time.or(force);
        let error = Self::from_fn(|quantity| match quantity {
            QuantityOfInterest::Restitution => restitution,
            QuantityOfInterest::ContactTime => contact_time_s,
            QuantityOfInterest::PeakForce => peak_force_n,
            QuantityOfInterest::MaxApproach => softer.map(|share| share * sizes.max_approach),
            QuantityOfInterest::MaxContactRadius => {
                softer.map(|share| 0.5 * share * sizes.max_contact_radius)
            }
            QuantityOfInterest::PeakPressure => {
                both.or(force.zip(force)).map(|(time, force)| (time + force) * sizes.peak_pressure)
            }
        });
        error.checked()
    }

    /// Returns the error of an unknown loss: the restitution is unknown. The other quantities depend on the
    /// moduli, whose scatter is not included.
    pub fn of_loss() -> Self {
        Self::from_fn(|quantity| (quantity != QuantityOfInterest::Restitution).then_some(0.0))
    }

    /// Returns the error of one quantity.
    pub fn size(&self, quantity: QuantityOfInterest) -> Option<f64> {
        self.0[quantity as usize]
    }

    /// Replaces the error of one quantity.
    #[must_use]
    pub(in crate::effects) fn with(mut self, quantity: QuantityOfInterest, size: f64) -> Self {
        self.0[quantity as usize] = Some(size);
        self
    }

    /// Replaces values that are not finite by `None`.
    pub(in crate::effects) fn checked(self) -> Self {
        Self(self.0.map(|error| error.filter(|size| size.is_finite())))
    }

    /// Multiplies all errors by a factor.
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        Self(self.0.map(|error| error.map(|size| share * size)))
    }

    /// Adds two errors; `None` if either is.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self::from_fn(|quantity| {
            self.size(quantity).zip(other.size(quantity)).map(|(one, more)| one + more)
        })
    }

    /// Replaces unknown errors by zero: sums of these are lower bounds.
    #[must_use]
    pub fn unknown_as_zero(self) -> Self {
        Self(self.0.map(|error| error.or(Some(0.0))))
    }
}
