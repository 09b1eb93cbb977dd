//! By how much nature may differ from a result because of what a model leaves out.
//!
//! Of an effect that changes contact time and peak force by the shares t and f the other quantities
//! follow as those of a contact that is softer: by Hertz' powers of E* (T, δ ∝ E*^(−2/5), a ∝ E*^(−1/5),
//! F ∝ E*^(2/5), p₀ ∝ F/a²)
//!
//! ```math
//! \frac{\Delta\delta}\delta = t, \qquad \frac{\Delta a}a = \tfrac12 t, \qquad
//! \frac{\Delta p_0}{p_0} = f + t .
//! ```
//!
//! What several effects leave open is **the sum of their magnitudes**. Closed forms tell no signs, and the
//! causes are not independent of each other, as a root of squares would want: all grow with the contact
//! radius and the speed, and most make a contact softer.

use fem_collision::QuantityOfInterest;

use crate::effects::LeftOut;
use crate::estimate::Estimate;

/// By how much each quantity of a result may be off, in the order of [`QuantityOfInterest::ALL`]; sizes in SI, `None`
/// where closed forms do not tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Doubt([Option<f64>; 6]);

/// How a run stands to an effect.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Standing {
    /// Whether the run lacks it.
    pub is_lacking: bool,
    /// By how much the numbers change without it ([`Effect::left_out`](super::Effect::left_out)).
    pub left_out: Option<LeftOut>,
}

impl Doubt {
    /// No doubt at all.
    pub const NOTHING: Self = Self([Some(0.0); 6]);

    /// Of each quantity what `size` says.
    pub fn by(size: impl FnMut(QuantityOfInterest) -> Option<f64>) -> Self {
        Self(QuantityOfInterest::ALL.map(size))
    }

    /// Of an effect that changes so much of the numbers of an estimate.
    pub fn of(left_out: &LeftOut, estimate: &Estimate) -> Self {
        let LeftOut { restitution, contact_time_s, peak_force_n } = *left_out;
        let sizes = &estimate.softened.sizes;
        let time = contact_time_s.map(|change| change / sizes.contact_time);
        let force = peak_force_n.map(|change| change / sizes.peak_force);
        let both = time.zip(force);
        // Bodies that stay together have no contact time, and come as much closer as they press less.
        let softer = time.or(force);
        let doubt = Self::by(|headline| match headline {
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
        doubt.checked()
    }

    /// Of a loss that is not known: of the restitution. The other quantities go by the moduli, of whose
    /// scatter nothing is said here.
    pub fn of_loss() -> Self {
        Self::by(|headline| (headline != QuantityOfInterest::Restitution).then_some(0.0))
    }

    /// Of one quantity.
    pub fn size(&self, headline: QuantityOfInterest) -> Option<f64> {
        self.0[headline as usize]
    }

    /// With another size of one quantity.
    #[must_use]
    pub(in crate::effects) fn with(mut self, headline: QuantityOfInterest, size: f64) -> Self {
        self.0[headline as usize] = Some(size);
        self
    }

    /// Nothing in place of what is no number.
    pub(in crate::effects) fn checked(self) -> Self {
        Self(self.0.map(|doubt| doubt.filter(|size| size.is_finite())))
    }

    /// A share of it.
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        Self(self.0.map(|doubt| doubt.map(|size| share * size)))
    }

    /// Both together: the sum, untold where either is.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self::by(|headline| {
            self.size(headline).zip(other.size(headline)).map(|(one, more)| one + more)
        })
    }

    /// What is told of it, nothing elsewhere: the sum of such is what doubts come to at least.
    #[must_use]
    pub fn told(self) -> Self {
        Self(self.0.map(|doubt| doubt.or(Some(0.0))))
    }
}
