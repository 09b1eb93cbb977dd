//! What a scene needs of an effect.

use fem_case::engineering;

use crate::estimate::Estimate;

/// What a scene needs of an effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Need {
    /// Whether the scene calls for it.
    pub is_called_for: bool,
    /// The number that decides, in words.
    pub number: String,
    /// What follows where it is not called for.
    pub otherwise: String,
    /// What stays open in a model that lacks it.
    pub left_open: String,
    /// What a user should know of a model that lacks it.
    pub warning: Option<String>,
}

/// A share in per cent; of what would be 0.00, or many digits, the power of ten.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let is_plain = percent == 0.0 || (5e-3..1e5).contains(&percent.abs());
    match is_plain {
        _ if !percent.is_finite() => "an untold share".to_string(),
        true => format!("{percent:.2} %"),
        false => format!("{percent:.1e} %"),
    }
}

/// Approach speed over shear wave speed above which inertia shortens the contact by more than
/// 0.15 %: 0.05 % at 1.5e-3 and 0.45 % at 1.5e-2 were measured on the glass pair.
pub const QUASI_STATIC_LIMIT: f64 = 5e-3;
/// Above this share of the shear wave speed an impact sends shocks.
pub(in crate::effects) const MACH_LIMIT: f64 = 0.02;

/// Returns the approach speed over the shear wave speed, as the deciding number in words.
pub(in crate::effects) fn number(estimate: &Estimate) -> String {
    format!(
        "approach speed / shear wave speed = {}",
        engineering::number(estimate.softened_mach, 2)
    )
}

/// Compares the approach speed, as a share of the shear wave speed, with a limit.
pub(in crate::effects) fn above(estimate: &Estimate, limit: f64) -> String {
    format!(
        "the approach speed is {} of the shear wave speed; above {}",
        percent(estimate.softened_mach),
        percent(limit)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_any_size_are_short() {
        let shares = [0.0, 1e-11, 4.9e-5, 5.1e-5, 0.01, 1.5, -1e60, f64::NAN, f64::INFINITY];
        let words = [
            "0.00 %",
            "1.0e-9 %",
            "4.9e-3 %",
            "0.01 %",
            "1.00 %",
            "150.00 %",
            "-1.0e62 %",
            "an untold share",
            "an untold share",
        ];
        assert_eq!(shares.map(percent), words);
    }
}
