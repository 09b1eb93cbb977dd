//! Rounded levels on both sides of zero.

/// The limits of bands.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    step: f64,
    edges: Vec<f64>,
}

impl Levels {
    /// Returns multiples of 1, 2 or 5 times a power of ten that cover a range, with about `n` bands on the
    /// larger side of zero. Values within one step of zero share a neutral band; it begins at zero where negative
    /// values are less than half a step, and ends there where positive ones are.
    pub fn about_zero(smallest: f64, largest: f64, n: usize) -> Self {
        let side = |value: f64| if value.is_finite() { value.max(0.0) } else { 0.0 };
        let (below, above) = (side(-smallest), side(largest));
        let span = below.max(above);
        let step = if span > 0.0 { rounded(span / n.max(1) as f64) } else { 1.0 };
        // Rounding adds no band at a multiple of the step.
        let count = |value: f64| ((value / step - 1e-9).ceil() as i64).max(1);
        let (below, above) = (count(below), count(above));
        let multiples = (-below..=above).filter(|k| *k != 0);
        let mut edges: Vec<f64> = multiples.map(|k| k as f64 * step).collect();
        if -smallest < 0.5 * step && largest >= step {
            edges[0] = 0.0;
        } else if largest < 0.5 * step && -smallest >= step {
            edges.last_mut().into_iter().for_each(|edge| *edge = 0.0);
        }
        Self { step, edges }
    }

    /// Returns the limits in ascending order, one more than there are bands.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// Returns the distance between levels.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Returns the position of a band from −1 (lowest) over 0 (neutral) to 1, for
    /// `band_colour`.
    pub(crate) fn position(&self, band: usize) -> f64 {
        let neutral = self.neutral() as f64;
        let n_bands = self.edges.len() as f64 - 1.0;
        let largest = neutral.max(n_bands - 1.0 - neutral).max(1.0);
        (band as f64 - neutral) / largest
    }

    /// Returns the index of the band around zero.
    pub(crate) fn neutral(&self) -> usize {
        (self.edges.partition_point(|edge| *edge <= 0.0) - 1).min(self.edges.len() - 2)
    }
}

/// Returns the smallest 1, 2 or 5 times a power of ten that is not below a positive value.
fn rounded(value: f64) -> f64 {
    let power = value.log10().floor() as i32;
    let candidates = [(1, power), (2, power), (5, power), (1, power + 1)];
    let number = |(digit, power): (u32, i32)| {
        // Parsing a decimal number gives the nearest double.
        format!("{digit}e{power}").parse::<f64>().unwrap_or(value)
    };
    let sizes = candidates.map(number);
    sizes.into_iter().find(|size| *size >= value * (1.0 - 1e-9)).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_round_and_leave_zero_out() {
        let levels = Levels::about_zero(-1.03, 0.02, 10);
        assert_eq!(levels.step(), 0.2);
        assert_eq!((levels.edges().len(), levels.edges()[6]), (7, 0.0));
        let levels = Levels::about_zero(-1.03, 0.12, 11);
        assert_eq!((levels.step(), levels.edges().len()), (0.1, 13));
        assert_eq!((levels.edges()[0], levels.edges()[12]), (-11.0 * 0.1, 0.2));
        assert_eq!(levels.neutral(), 10);
        assert_eq!(Levels::about_zero(-0.3, 4.4, 10).step(), 0.5);
        let levels = Levels::about_zero(0.0, 2.0, 4);
        assert_eq!((levels.edges(), levels.neutral()), (&[0.0, 0.5, 1.0, 1.5, 2.0][..], 0));
        let levels = Levels::about_zero(-2.0, 0.0, 4);
        assert_eq!((levels.edges(), levels.neutral()), (&[-2.0, -1.5, -1.0, -0.5, 0.0][..], 3));
        assert_eq!(Levels::about_zero(-3e9, 3e9, 3).edges(), [-3e9, -2e9, -1e9, 1e9, 2e9, 3e9]);
    }

    #[test]
    fn fields_without_a_range_have_one_band() {
        for (smallest, largest) in [(0.0, 0.0), (f64::NAN, f64::NAN), (f64::INFINITY, -1.0)] {
            let levels = Levels::about_zero(smallest, largest, 10);
            assert_eq!((levels.edges(), levels.neutral()), (&[-1.0, 1.0][..], 0));
        }
    }
}
