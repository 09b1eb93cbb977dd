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

use crate::effects::LeftOut;
use crate::estimate::Estimate;

/// By how much each quantity of a result may be off; sizes in SI, `None` where closed forms do not tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Doubt {
    /// Of the restitution.
    pub restitution: Option<f64>,
    /// Of the contact time, s.
    pub contact_time: Option<f64>,
    /// Of the peak force, N.
    pub peak_force: Option<f64>,
    /// Of the largest approach, m.
    pub max_approach: Option<f64>,
    /// Of the largest contact radius, m.
    pub max_contact_radius: Option<f64>,
    /// Of the peak pressure, Pa.
    pub peak_pressure: Option<f64>,
}

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
    pub const NOTHING: Self = Self {
        restitution: Some(0.0),
        contact_time: Some(0.0),
        peak_force: Some(0.0),
        max_approach: Some(0.0),
        max_contact_radius: Some(0.0),
        peak_pressure: Some(0.0),
    };

    /// Of an effect that changes so much of the numbers of an estimate.
    pub fn of(left_out: &LeftOut, estimate: &Estimate) -> Self {
        let LeftOut { restitution, contact_time_s, peak_force_n } = *left_out;
        let hertz = &estimate.hertz;
        let time = contact_time_s.map(|change| change / hertz.contact_time());
        let force = peak_force_n.map(|change| change / hertz.peak_force());
        let both = time.zip(force);
        Self {
            restitution,
            contact_time: contact_time_s,
            peak_force: peak_force_n,
            max_approach: time.map(|share| share * hertz.max_approach()),
            max_contact_radius: time.map(|share| 0.5 * share * hertz.max_contact_radius()),
            peak_pressure: both.map(|(time, force)| (time + force) * hertz.peak_pressure()),
        }
        .checked()
    }

    /// Nothing in place of what is no number.
    pub(super) fn checked(self) -> Self {
        self.each(|doubt| doubt.filter(|size| size.is_finite()))
    }

    /// A share of it.
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        self.each(|doubt| doubt.map(|size| share * size))
    }

    /// Both together: the sum, untold where either is.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let sum = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a + b);
        Self {
            restitution: sum(self.restitution, other.restitution),
            contact_time: sum(self.contact_time, other.contact_time),
            peak_force: sum(self.peak_force, other.peak_force),
            max_approach: sum(self.max_approach, other.max_approach),
            max_contact_radius: sum(self.max_contact_radius, other.max_contact_radius),
            peak_pressure: sum(self.peak_pressure, other.peak_pressure),
        }
    }

    fn each(self, change: impl Fn(Option<f64>) -> Option<f64>) -> Self {
        Self {
            restitution: change(self.restitution),
            contact_time: change(self.contact_time),
            peak_force: change(self.peak_force),
            max_approach: change(self.max_approach),
            max_contact_radius: change(self.max_contact_radius),
            peak_pressure: change(self.peak_pressure),
        }
    }
}
