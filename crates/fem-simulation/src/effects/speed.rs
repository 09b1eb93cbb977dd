//! The approach speed next to that of shear waves, with the moduli that the contact meets: the number that several
//! effects go by.

use super::need::percent;
use crate::estimate::Estimate;
use fem_case::engineering;

/// Approach speed over shear wave speed above which inertia shortens the contact by more than
/// 0.15 %: 0.05 % at 1.5e-3 and 0.45 % at 1.5e-2 were measured on the glass pair.
pub const QUASI_STATIC_LIMIT: f64 = 5e-3;
/// Above this share of the shear wave speed an impact sends shocks.
pub(super) const MACH_LIMIT: f64 = 0.02;

/// The number that decides, in words.
pub(super) fn number(estimate: &Estimate) -> String {
    format!(
        "approach speed / shear wave speed = {}",
        engineering::number(estimate.softened_mach, 2)
    )
}

/// What the approach speed is next to that of shear waves, and above which share something follows.
pub(super) fn above(estimate: &Estimate, limit: f64) -> String {
    format!(
        "the approach speed is {} of the shear wave speed; above {}",
        percent(estimate.softened_mach),
        percent(limit)
    )
}
