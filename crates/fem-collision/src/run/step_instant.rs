//! Instants of a run that results and warnings refer to.

use fem_material::engineering::Unit;
use fem_material::engineering::show;
use serde::{Deserialize, Serialize};
use std::fmt;

/// An instant of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepInstant {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Number of the step.
    pub step: u64,
}

impl StepInstant {
    /// Returns the instant shifted by `delay`, s, for a run whose time starts at another instant.
    #[must_use]
    pub fn later_by(self, delay: f64) -> Self {
        Self { time: self.time + delay, ..self }
    }
}

impl fmt::Display for StepInstant {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{} (step {})", show(self.time, "s"), self.step)
    }
}

/// The deepest overlap of a run with its position and instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeepestOverlap {
    /// Numerical overlap, m.
    pub overlap: f64,
    /// Distance from the axis, m.
    pub radius: f64,
    /// Instant of the overlap.
    pub at: StepInstant,
}

impl DeepestOverlap {
    /// Returns the deeper one of the overlap so far and the present one; `None` without any overlap.
    pub fn of(so_far: Option<Self>, now: Self) -> Option<Self> {
        // NaN is no overlap; the energy residual shows it.
        let is_deeper = now.overlap > so_far.map_or(0.0, |deepest| deepest.overlap);
        if is_deeper { Some(now) } else { so_far }
    }

    /// Returns the overlap with its instant shifted by `delay`, s.
    #[must_use]
    pub fn later_by(self, delay: f64) -> Self {
        Self { at: self.at.later_by(delay), ..self }
    }
}

impl fmt::Display for DeepestOverlap {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let two_digits = |size: f64| Unit::fitting(size, "m").with_digits(2).show(size);
        let [overlap, radius] = [self.overlap, self.radius].map(two_digits);
        write!(to, "{overlap} at r = {radius} at {}", self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deepest_overlap_keeps_the_first_of_equal_maxima() {
        let of = |overlap: f64, step: u64| {
            let at = StepInstant { time: 1e-6 * step as f64, step };
            DeepestOverlap { overlap, radius: 0.0, at }
        };
        let seen = [of(0.0, 0), of(1e-9, 1), of(3e-9, 2), of(f64::NAN, 3), of(3e-9, 4), of(0.0, 5)];
        let found = seen.into_iter().fold(None, DeepestOverlap::of).unwrap();
        assert_eq!(found.at.step, 2);
        assert_eq!(found.later_by(1.0).to_string(), "3.0 nm at r = 0.0 m at 1.000 s (step 2)");
        assert_eq!(DeepestOverlap::of(None, of(0.0, 0)), None);
    }
}
