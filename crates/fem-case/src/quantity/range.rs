//! The ranges of the numbers that keys allow. Validation, its messages and the JSON schema follow from them.

/// A range of numbers. A bound that is open is not in the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    pub low: f64,
    pub is_low_open: bool,
    pub high: f64,
    pub is_high_open: bool,
    /// Whether only whole numbers are allowed.
    pub is_whole: bool,
}

impl Range {
    pub const ANY: Self = Self::from(f64::NEG_INFINITY, f64::INFINITY);
    pub const POSITIVE: Self = Self::above(0.0, f64::INFINITY);
    pub const NOT_NEGATIVE: Self = Self::from(0.0, f64::INFINITY);
    /// The whole numbers up to the largest that doubles represent without gaps.
    pub const COUNT: Self = Self::whole(1.0, 9e15);
    pub const GROWTH: Self = Self::above(1.0, f64::INFINITY);
    pub const STEP_FACTOR: Self = Self::above(0.0, 1.0);
    pub const MASS_SCALING: Self = Self::from(0.0, 0.1);
    /// The largest number is more than any ball makes before it comes to rest.
    pub const BOUNCES: Self = Self::whole(1.0, 1e4);
    pub const SNAPSHOTS: Self = Self::whole(1.0, 1e5);
    pub const VIBRATION_MODES: Self = Self::whole(0.0, 100.0);
    pub const CONDENSED_STEPS: Self = Self::whole(50.0, 1e5);
    /// Tolerances of results.
    pub const TOLERANCE: Self = Self::above(0.0, 0.5);
    /// Tolerances of integrations.
    pub const INTEGRATION_TOLERANCE: Self = Self::from(1e-10, 1e-2);
    /// Works of adhesion, J/m²: over a range of 0.4 nm the largest pulls with 2.6 TPa, by the attraction of Lennard and Jones, which no
    /// solid bears.
    pub const WORK_OF_ADHESION: Self = Self::from(0.0, 1000.0);
    /// Surface energies, J/m², of which two are a work of adhesion.
    pub const SURFACE_ENERGY: Self = Self::above(0.0, 500.0);
    pub const RESTITUTION: Self = Self::above(0.0, 1.0);
    #[cfg(all(test, feature = "schema"))]
    pub const POISSONS_RATIO: Self = Self::between(-1.0, 0.5);
    /// A coefficient of a contact law with the meaning of Poisson's ratio.
    pub const LIKE_POISSONS_RATIO: Self = Self::between(-1.0, 1.0);
    /// Exponents of Swift's power law of hardening.
    pub const HARDENING_EXPONENT: Self = Self::above(0.0, 1.0);
    /// Weights of terms, and uncertainties over their values.
    pub const SHARE: Self = Self::from(0.0, 1.0);

    const fn from(low: f64, high: f64) -> Self {
        Self { low, is_low_open: false, high, is_high_open: false, is_whole: false }
    }

    const fn above(low: f64, high: f64) -> Self {
        Self { is_low_open: true, ..Self::from(low, high) }
    }

    const fn between(low: f64, high: f64) -> Self {
        Self { is_high_open: true, ..Self::above(low, high) }
    }

    const fn whole(low: f64, high: f64) -> Self {
        Self { is_whole: true, ..Self::from(low, high) }
    }

    /// Returns whether a number is in the range.
    pub fn has(&self, x: f64) -> bool {
        let is_above = if self.is_low_open { x > self.low } else { x >= self.low };
        let is_below = if self.is_high_open { x < self.high } else { x <= self.high };
        is_above && is_below && (!self.is_whole || x.fract() == 0.0)
    }

    /// Describes the range: "greater than 0 and at most 1", "a whole number from 1 to 10000".
    pub fn words(&self) -> String {
        let [low, high] = [self.low, self.high].map(|x| match x.abs() {
            size if size >= 1e9 || (size > 0.0 && size < 1e-3) => format!("{x:e}"),
            _ => x.to_string(),
        });
        let whole = if self.is_whole { "a whole number " } else { "" };
        match (self.low.is_finite(), self.high.is_finite(), self.is_low_open) {
            (false, ..) => "any number".to_string(),
            (true, false, true) => format!("greater than {low}"),
            (true, false, false) => format!("{low} or greater"),
            (true, true, true) if self.is_high_open => format!("between {low} and {high}"),
            (true, true, true) => format!("greater than {low} and at most {high}"),
            (true, true, false) => format!("{whole}from {low} to {high}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_range_say_which_bounds_belong_to_it() {
        for (range, words, inside, outside) in [
            (Range::POSITIVE, "greater than 0", 1e-300, 0.0),
            (Range::NOT_NEGATIVE, "0 or greater", 0.0, -1e-300),
            (Range::STEP_FACTOR, "greater than 0 and at most 1", 1.0, 1.1),
            (Range::COUNT, "a whole number from 1 to 9e15", 2.0, 1.5),
            (Range::INTEGRATION_TOLERANCE, "from 1e-10 to 0.01", 1e-10, 0.011),
            (Range::LIKE_POISSONS_RATIO, "between -1 and 1", 0.0, 1.0),
        ] {
            assert_eq!(range.words(), words);
            assert!(range.has(inside) && !range.has(outside), "{words}");
        }
        assert!(Range::ANY.has(-1e300) && !Range::ANY.has(f64::NAN));
    }
}
