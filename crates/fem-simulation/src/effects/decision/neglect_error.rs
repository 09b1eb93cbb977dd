//! Error of neglecting an effect, and the model-form errors that follow from it.
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

use std::fmt;

use fem_case::Scene;
use fem_case::engineering::{Unit, number};
use fem_collision::QuantityOfInterest;
use serde::Serialize;

use super::{Effect, is_needed};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// The status of an effect in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EffectStatus {
    /// Whether the run lacks the effect.
    pub is_lacking: bool,
    /// Error of neglecting the effect ([`Effect::neglect_error`](super::Effect::neglect_error)).
    pub neglect_error: Option<NeglectError>,
}

impl EffectStatus {
    /// Returns the error of neglecting an effect if the run lacks it.
    pub(crate) fn error<E: Effect + ?Sized>(
        &self,
        effect: &E,
        scene: &Scene,
        estimate: &Estimate,
    ) -> QuantityErrors {
        if !self.is_lacking {
            return QuantityErrors::ZERO;
        }
        match &self.neglect_error {
            Some(neglect_error) => neglect_error.of_all_quantities(estimate),
            None if is_needed(effect, scene, estimate) => QuantityErrors::default(),
            None => QuantityErrors::ZERO,
        }
    }
}

/// Change of a collision's results if an effect is neglected, estimated by closed forms. All are
/// magnitudes; `None` if there is no estimate.
///
/// The estimates are good within a factor of three; tests hold them to that. What vibrations give back depends on their phase at
/// the end of the contact: glass balls of 22 mm at 20 and 50 m/s change by a fifth of the estimates of force and restitution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct NeglectError {
    /// Change of the restitution.
    pub restitution: Option<f64>,
    /// Change of the contact time, in seconds.
    pub contact_time_s: Option<f64>,
    /// Change of the peak force, in newtons.
    pub peak_force_n: Option<f64>,
}

impl NeglectError {
    /// The absence of any change.
    pub const NOTHING: Self =
        Self { restitution: Some(0.0), contact_time_s: Some(0.0), peak_force_n: Some(0.0) };

    /// Returns the magnitudes of changes of restitution, contact time (s) and peak force (N), without those that
    /// are not finite. A restitution changes by at most 1.
    pub(in crate::effects) fn of(changes: [Option<f64>; 3]) -> Self {
        let [restitution, contact_time_s, peak_force_n] =
            changes.map(|change| change.filter(|change| change.is_finite()).map(f64::abs));
        let restitution = restitution.map(|change| change.min(1.0));
        Self { restitution, contact_time_s, peak_force_n }
    }

    /// Returns changes given as shares of the estimate's contact time and peak force; the restitution is
    /// unchanged.
    pub(crate) fn shares(estimate: &Estimate, contact_time: f64, peak_force: f64) -> Self {
        let sizes = &estimate.effective.sizes;
        let [time, force] = [contact_time * sizes.contact_time, peak_force * sizes.peak_force];
        Self::of([Some(0.0), Some(time), Some(force)])
    }

    /// Returns the sum of two changes; `None` where either is.
    pub(in crate::effects) fn plus(&self, other: &Self) -> Self {
        let sum = |one: Option<f64>, other: Option<f64>| Some(one? + other?);
        Self::of([
            sum(self.restitution, other.restitution),
            sum(self.contact_time_s, other.contact_time_s),
            sum(self.peak_force_n, other.peak_force_n),
        ])
    }

    /// Returns the model-form errors that follow from neglecting the effect.
    pub(crate) fn of_all_quantities(&self, estimate: &Estimate) -> QuantityErrors {
        let Self { restitution, contact_time_s, peak_force_n } = *self;
        let sizes = &estimate.effective.sizes;
        let time = contact_time_s.map(|change| change / sizes.contact_time);
        let force = peak_force_n.map(|change| change / sizes.peak_force);
        let both = time.zip(force);
        // Bodies that stay together have no contact time, and come as much closer as they press less.
        let softer = time.or(force);
        let errors = QuantityErrors::from_fn(|quantity| match quantity {
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
        errors.checked()
    }

    /// Returns the warning for an effect that is called for but switched off.
    pub(crate) fn warning(&self, effect: &str) -> String {
        format!("{effect} is needed, but switched off, which neglects {self}")
    }

    /// Returns a change of the restitution, with the other two unknown.
    pub(crate) fn restitution(change: f64) -> Self {
        Self::of([Some(change), None, None])
    }

    /// Returns the magnitudes of changes of the quantities in order, relative to the estimate's; that of the restitution
    /// is absolute. Changes that are not finite are unknown.
    pub(in crate::effects) fn errors_of(estimate: &Estimate, changes: [f64; 6]) -> QuantityErrors {
        let error = |quantity| Some(changes[quantity as usize].abs() * estimate.scale(quantity));
        QuantityErrors::from_fn(error).checked()
    }

    /// Returns those of the first three such changes.
    pub(in crate::effects) fn of_changes(estimate: &Estimate, changes: [f64; 6]) -> Self {
        let errors = Self::errors_of(estimate, changes);
        let [e, time, force, ..] = QuantityOfInterest::ALL.map(|quantity| errors.size(quantity));
        Self::of([e, time, force])
    }
}

/// "about 0.012 of the restitution, 1.3 µs of the contact time".
impl fmt::Display for NeglectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.restitution, "", "of the restitution"),
            (self.contact_time_s, "s", "of the contact time"),
            (self.peak_force_n, "N", "of the peak force"),
        ];
        let known: Vec<_> =
            parts.into_iter().filter_map(|(change, unit, of)| Some((change?, unit, of))).collect();
        let shown = |(change, unit, of): &(f64, &'static str, &str)| match *unit {
            "" => format!("{} {of}", number(*change, 2)),
            unit => {
                let rounded = format!("{change:.1e}").parse().unwrap_or(*change);
                format!("{} {of}", Unit::fitting(rounded, unit).with_digits(2).show(rounded))
            }
        };
        let parts: Vec<String> = known.iter().filter(|part| part.0 != 0.0).map(shown).collect();
        match (known.is_empty(), parts.is_empty()) {
            (true, _) => write!(f, "an unknown amount"),
            (false, true) => write!(f, "nothing"),
            (false, false) => write!(f, "about {}", parts.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_changes_are_not_shown() {
        assert_eq!(
            NeglectError::restitution(-0.0123).to_string(),
            "about 0.012 of the restitution"
        );
        assert_eq!(NeglectError::restitution(f64::NAN), NeglectError::default());
        assert!(NeglectError::default().to_string().contains("unknown"));
        assert_eq!(NeglectError::NOTHING.to_string(), "nothing");
        let all = NeglectError {
            contact_time_s: Some(4.41e-10),
            peak_force_n: Some(2.83e-4),
            ..NeglectError::restitution(5.4e-5)
        };
        let expected =
            "about 5.4e-5 of the restitution, 440 ps of the contact time, 280 µN of the peak force";
        assert_eq!(all.to_string(), expected);
    }
}
