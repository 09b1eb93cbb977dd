//! Checks: one quantity compared with its reference.

use std::fmt;

use fem_case::engineering::Unit;
use serde::Deserialize;

/// Kind of a reference, which says how independent it is of this program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A closed form, a theorem or a limit.
    Analytic,
    /// A number or a curve that others have published.
    Published,
    /// A result of another program.
    CrossCode,
    /// An earlier value of this program, which detects changes but does not show correctness.
    Regression,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Analytic => "analytic",
            Self::Published => "published",
            Self::CrossCode => "cross-code",
            Self::Regression => "regression",
        })
    }
}

/// Allowed deviation of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// |ours − reference| over |reference|.
    Relative(f64),
    /// |ours − reference|, in the quantity's unit.
    Absolute(f64),
    /// An upper bound, without a reference.
    AtMost(f64),
    /// A lower bound, without a reference.
    AtLeast(f64),
    /// A range that includes both ends.
    Within(f64, f64),
}

/// A quantity, its reference and its tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Name that the study gives the quantity.
    pub quantity: String,
    /// Label in tables.
    pub label: String,
    /// SI unit; empty for numbers.
    pub unit: String,
    /// Kind of the reference.
    pub kind: Kind,
    /// Where the reference comes from.
    pub source: String,
    /// The reference, SI; `None` for bounds.
    pub reference: Option<f64>,
    /// The allowed deviation.
    pub tolerance: Tolerance,
    /// Reason for the tolerance.
    pub reason: String,
}

/// Result of a check.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckResult {
    /// The check that was made.
    pub check: Check,
    /// Measured value, SI; `None` if the study did not measure it.
    pub measured: Option<f64>,
    /// Whether it lies within the tolerance.
    pub passed: bool,
}

impl Check {
    /// Compares a measured value with the reference. NaN never passes.
    pub fn judge(&self, measured: Option<f64>) -> CheckResult {
        let passed = measured.is_some_and(|value| match (self.tolerance, self.reference) {
            (Tolerance::Relative(most), Some(reference)) => {
                (value - reference).abs() <= most * reference.abs()
            }
            (Tolerance::Absolute(most), Some(reference)) => (value - reference).abs() <= most,
            (Tolerance::AtMost(most), _) => value <= most,
            (Tolerance::AtLeast(least), _) => value >= least,
            (Tolerance::Within(from, to), _) => (from..=to).contains(&value),
            (Tolerance::Relative(_) | Tolerance::Absolute(_), None) => false,
        });
        CheckResult { check: self.clone(), measured, passed }
    }

    fn show(&self, value: f64) -> String {
        if self.unit.is_empty() {
            return plain(value);
        }
        Unit::fitting(value, &self.unit).with_digits(5).show(value)
    }

    /// Returns the reference, or the bound, as text.
    pub fn reference_text(&self) -> String {
        match (self.reference, self.tolerance) {
            (Some(reference), _) => self.show(reference),
            (None, Tolerance::AtMost(most)) => format!("≤ {}", self.show(most)),
            (None, Tolerance::AtLeast(least)) => format!("≥ {}", self.show(least)),
            (None, Tolerance::Within(from, to)) => {
                format!("{} to {}", self.show(from), self.show(to))
            }
            (None, _) => "none".into(),
        }
    }

    /// Returns the tolerance as text; empty for bounds.
    pub fn tolerance_text(&self) -> String {
        match self.tolerance {
            Tolerance::Relative(most) => format!("{} %", plain(100.0 * most)),
            Tolerance::Absolute(most) => self.show(most),
            _ => String::new(),
        }
    }
}

impl CheckResult {
    /// Returns the measured value as text.
    pub fn measured_text(&self) -> String {
        self.measured.map_or("not measured".into(), |value| self.check.show(value))
    }

    /// Returns the difference from the reference as text; empty for bounds.
    pub fn difference_text(&self) -> String {
        let (Some(value), Some(reference)) = (self.measured, self.check.reference) else {
            return String::new();
        };
        let difference = value - reference;
        match self.check.tolerance {
            Tolerance::Relative(_) => format!("{:+.2} %", 100.0 * difference / reference.abs()),
            _ if self.check.unit.is_empty() => format!("{difference:+.1e}"),
            _ => self.check.show(difference),
        }
    }

    /// Returns `pass` or `FAIL`.
    pub fn verdict(&self) -> &'static str {
        if self.passed { "pass" } else { "FAIL" }
    }
}

/// Formats a number without unit with five digits, small and large ones with an exponent.
pub(crate) fn plain(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(1e-3..1e5).contains(&size) {
        let text = format!("{value:.2e}");
        return match text.split_once('e') {
            Some((digits, power)) if digits.contains('.') => {
                format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'))
            }
            _ => text,
        };
    }
    let decimals = (4 - size.log10().floor() as i32).clamp(0, 5) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(reference: Option<f64>, tolerance: Tolerance) -> Check {
        Check {
            quantity: "q".into(),
            label: "q".into(),
            unit: String::new(),
            kind: Kind::Analytic,
            source: String::new(),
            reference,
            tolerance,
            reason: String::new(),
        }
    }

    #[test]
    fn check_applies_tolerances_on_both_sides_and_rejects_nan() {
        let cases = [
            (check(Some(2.0), Tolerance::Relative(0.01)), [1.99, 2.01], [1.97, 2.03]),
            (check(Some(-2.0), Tolerance::Relative(0.01)), [-1.99, -2.01], [-1.97, 2.0]),
            (check(Some(2.0), Tolerance::Absolute(0.1)), [1.95, 2.05], [1.8, 2.2]),
            (check(None, Tolerance::AtMost(1.0)), [1.0, -9.0], [1.1, f64::INFINITY]),
            (check(None, Tolerance::AtLeast(1.0)), [1.0, 9.0], [0.9, -1.0]),
            (check(None, Tolerance::Within(1.0, 2.0)), [1.0, 2.0], [0.9, 2.1]),
            (check(None, Tolerance::Absolute(1.0)), [f64::NAN; 2], [0.0, f64::NAN]),
        ];
        for (check, good, bad) in cases {
            for value in good.into_iter().filter(|value| !value.is_nan()) {
                assert!(check.judge(Some(value)).passed, "{check:?} {value}");
            }
            for value in bad.into_iter().chain([f64::NAN]) {
                assert!(!check.judge(Some(value)).passed, "{check:?} {value}");
            }
            assert!(!check.judge(None).passed);
        }
    }

    #[test]
    fn plain_numbers_are_short() {
        for (value, expected) in [
            (0.927634, "0.92763"),
            (1.0, "1"),
            (3.4e-7, "3.4e-7"),
            (1234.5, "1234.5"),
            (0.0, "0"),
            (-0.0005, "-5e-4"),
            (2e6, "2e6"),
        ] {
            assert_eq!(plain(value), expected);
        }
    }
}
