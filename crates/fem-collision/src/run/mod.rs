//! Quantities that a run accumulates step by step.

mod energy_ledger;
mod force_noise;
mod history;
mod monitor;
mod nan_aware_max;
mod post_contact;
mod pulse;
mod rest_criterion;
mod sampling_interval;
mod step_instant;

pub use energy_ledger::{Account, BalanceSide, DissipatedEnergies, EnergyLedger, ShownIn};
pub use force_noise::ForceNoise;
pub use history::{History, HistoryRow, RowKind};
pub use monitor::{Monitor, Phase, Progress, STEPS_BETWEEN_REPORTS};
pub use nan_aware_max::{nan_aware_max, nan_aware_max_abs};
pub use post_contact::PostContactVibration;
pub use pulse::{ForcePulse, PEAK_WINDOW, PulsePeaks, RESOLVING_ELEMENTS, longest_at_pole};
pub use rest_criterion::{RelativeMotion, RestCriterion};
pub use sampling_interval::SamplingInterval;
pub use step_instant::{DeepestOverlap, StepInstant};
