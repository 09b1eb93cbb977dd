//! The relevance of an effect to a scene.

use fem_case::engineering;

use crate::estimate::Estimate;

/// The relevance of an effect to a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Relevance {
    /// Whether the scene calls for it.
    pub is_needed: bool,
    /// The deciding number, as text.
    pub number: String,
    /// The text after the number if the scene does not need the effect.
    pub if_not_needed: String,
    /// The remaining uncertainty in a model that lacks the effect, as text.
    pub open_error: String,
    /// A warning for models that lack the effect.
    pub warning: Option<String>,
}

/// Formats a share in per cent, with a power of ten if it would print as 0.00 or with many digits.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let is_plain = percent == 0.0 || (5e-3..1e5).contains(&percent.abs());
    match is_plain {
        _ if !percent.is_finite() => "an unknown share".to_string(),
        true => format!("{percent:.2} %"),
        false => format!("{percent:.1e} %"),
    }
}

/// Approach speed over shear wave speed above which inertia shortens the contact by more than
/// 0.15 %: 0.05 % at 1.5e-3 and 0.45 % at 1.5e-2 were measured on the glass pair.
pub const QUASI_STATIC_LIMIT: f64 = 5e-3;
/// Approach speed over shear wave speed above which an impact sends shocks.
pub(crate) const MACH_LIMIT: f64 = 0.02;

/// Returns the approach speed over the shear wave speed, as text.
pub(in crate::effects) fn number(estimate: &Estimate) -> String {
    format!(
        "approach speed / shear wave speed = {}",
        engineering::number(estimate.effective_mach, 2)
    )
}

/// Compares the approach speed, as a share of the shear wave speed, with a limit.
pub(in crate::effects) fn above(estimate: &Estimate, limit: f64) -> String {
    format!(
        "the approach speed is {} of the shear wave speed, above {}",
        percent(estimate.effective_mach),
        percent(limit)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentages_of_any_size_are_short() {
        let shares = [0.0, 1e-11, 4.9e-5, 5.1e-5, 0.01, 1.5, -1e60, f64::NAN, f64::INFINITY];
        let words = [
            "0.00 %",
            "1.0e-9 %",
            "4.9e-3 %",
            "0.01 %",
            "1.00 %",
            "150.00 %",
            "-1.0e62 %",
            "an unknown share",
            "an unknown share",
        ];
        assert_eq!(shares.map(percent), words);
    }
}
