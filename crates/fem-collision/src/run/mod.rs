//! Quantities that a run accumulates step by step.

mod energy_ledger;
mod force_noise;
mod history;
mod monitor;
mod post_contact;
mod pulse;
mod rest_criterion;
mod sampling_interval;
mod step_instant;

pub use energy_ledger::{
    Account, BalanceSide, DissipatedEnergies, EnergyLedger, ShownIn, energy_key,
};
pub use force_noise::ForceNoise;
pub use history::{History, HistoryRow, RowKind, TangentialRow};
pub use monitor::{Monitor, Phase, Progress, STEPS_BETWEEN_REPORTS};
pub use post_contact::PostContactVibration;
pub use pulse::{ForcePulse, PEAK_WINDOW, PulsePeaks, RESOLVING_ELEMENTS, longest_at_pole};
pub use rest_criterion::{RelativeMotion, RestCriterion};
pub use sampling_interval::SamplingInterval;
pub use step_instant::{DeepestOverlap, StepInstant};

/// Returns the larger magnitude; a NaN in either argument is kept.
pub fn nan_aware_max_abs(so_far: f64, value: f64) -> f64 {
    if so_far.is_nan() || value.abs() <= so_far { so_far } else { value.abs() }
}

/// Returns the larger number; a NaN in either argument is kept.
pub fn nan_aware_max(so_far: f64, value: f64) -> f64 {
    if so_far.is_nan() || value <= so_far { so_far } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_aware_max_returns_the_largest_value_or_nan() {
        let of = |values: &[f64]| {
            values.iter().fold(0.0, |so_far, &value| nan_aware_max_abs(so_far, value))
        };
        assert_eq!(of(&[0.1, -0.3, 0.2]), 0.3);
        assert_eq!(of(&[0.1, f64::NEG_INFINITY, 0.2]), f64::INFINITY);
        assert!(of(&[0.1, f64::NAN, 0.2]).is_nan());
        assert!(of(&[0.1, f64::NAN]).is_nan());
        let of =
            |values: &[f64]| values.iter().fold(0.0, |so_far, &value| nan_aware_max(so_far, value));
        assert_eq!(of(&[0.1, -0.3, 0.2]), 0.2);
        assert!(of(&[0.1, f64::NAN, 0.2]).is_nan());
    }
}
