//! The largest value of a history.

use fem_collision::nan_aware_max_abs;

/// Largest value of a smooth function given at even steps, at least 0: the vertex of the parabola
/// through the highest three. NaN stays.
#[derive(Debug, Default)]
pub(crate) struct Peak {
    last: [f64; 2],
    /// So far.
    pub highest: f64,
}

impl Peak {
    /// Takes the next value.
    pub fn observe(&mut self, value: f64) {
        let [before, middle] = self.last;
        if middle >= before && middle > value {
            let (slope, bend) = (0.5 * (value - before), value - 2.0 * middle + before);
            self.note(middle - 0.5 * slope * slope / bend);
        }
        self.note(value);
        self.last = [middle, value];
    }

    fn note(&mut self, value: f64) {
        // What lies below zero is no candidate; NaN passes.
        self.highest = nan_aware_max_abs(self.highest, value.clamp(0.0, f64::INFINITY));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_of_a_parabola_lies_between_its_points() {
        let highest = |values: &[f64]| {
            let mut peak = Peak::default();
            values.iter().for_each(|&value| peak.observe(value));
            peak.highest
        };
        // 4 − (t − 1.5)²: the top lies between two points.
        assert_eq!(highest(&[1.75, 3.75, 3.75, 1.75, -9.0]), 4.0);
        assert_eq!(highest(&[1.0, 2.0, -3.0]), 2.0 + 0.5 * 2.0 * 2.0 / 6.0);
        assert!(highest(&[1.0, f64::NAN, 2.0]).is_nan());
    }
}
