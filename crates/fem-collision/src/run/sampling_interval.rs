//! Sampling of a run at an even stride that adapts to its length.

use serde::{Deserialize, Serialize};

/// Ratio of samples to the expected number above which every second sample is dropped.
const SAMPLES_OVER_EXPECTED: usize = 4;
/// Smallest number of samples.
const MIN_SAMPLES: usize = 16;

/// An even stride over the steps of a run that doubles whenever there are too many samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SamplingInterval {
    stride: u64,
    /// Number of samples that are kept so far.
    n: usize,
    most: usize,
}

impl SamplingInterval {
    /// Creates a stride for about `n_instants` samples over `expected_steps` steps; there are at
    /// most four times as many.
    pub fn new(n_instants: usize, expected_steps: f64) -> Self {
        let stride = (expected_steps / n_instants.max(1) as f64).floor().max(1.0) as u64;
        Self {
            stride,
            n: 0,
            most: SAMPLES_OVER_EXPECTED.saturating_mul(n_instants.max(MIN_SAMPLES)),
        }
    }

    /// Creates the nearest stride: two thirds to three halves of the requested samples, if there
    /// are enough steps.
    pub fn nearest(n_instants: usize, expected_steps: f64) -> Self {
        let stride = (expected_steps / n_instants.max(1) as f64).round().max(1.0) as u64;
        Self { stride, ..Self::new(n_instants, expected_steps) }
    }

    /// Returns whether this step is sampled.
    pub fn is_due(&self, step: u64) -> bool {
        step.is_multiple_of(self.stride)
    }

    /// Counts a sample. If there are too many, halves the count, doubles the stride and returns
    /// true.
    pub fn count(&mut self) -> bool {
        self.n = self.n.saturating_add(1);
        let too_many = self.n > self.most;
        if too_many {
            self.n = self.n.div_ceil(2);
            self.stride = self.stride.saturating_mul(2);
        }
        too_many
    }

    /// Sets the number of samples that are left, if it is not half of them.
    pub(crate) fn recount(&mut self, n: usize) {
        self.n = n;
    }

    /// Returns the number of samples so far.
    pub(crate) fn n(&self) -> usize {
        self.n
    }

    /// Returns the largest number of samples.
    pub(crate) fn most(&self) -> usize {
        self.most
    }

    /// Returns the number of steps between samples.
    pub fn stride(&self) -> u64 {
        self.stride
    }

    /// Returns whether a restart state is consistent.
    pub fn is_consistent(&self) -> bool {
        self.stride > 0 && self.n < usize::MAX
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_come_at_the_stride_of_the_estimate() {
        for (n_instants, expected_steps, stride) in
            [(1000, 7600.0, 7), (1000, 50.0, 1), (0, 5.0, 5), (10, f64::NAN, 1)]
        {
            let interval = SamplingInterval::new(n_instants, expected_steps);
            assert!(interval.is_consistent());
            let due: Vec<u64> = (0..30).filter(|&step| interval.is_due(step)).collect();
            let expected: Vec<u64> = (0..30).step_by(stride).collect();
            assert_eq!(due, expected);
        }
    }

    /// The number of samples is close to the requested one for any number of steps.
    #[test]
    fn nearest_stride_gives_about_the_requested_number_of_samples() {
        for n_steps in [700_u64, 1000, 1400, 1499, 1500, 1999, 2999, 7600, 123_456] {
            let interval = SamplingInterval::nearest(1000, n_steps as f64);
            assert!(interval.is_consistent());
            let n = (0..n_steps).filter(|&step| interval.is_due(step)).count();
            assert!((667..1500).contains(&n), "{n} of {n_steps}");
        }
        assert_eq!(SamplingInterval::nearest(10, f64::NAN).stride(), 1);
    }

    /// A long run keeps two to four times as many samples as requested.
    #[test]
    fn long_run_keeps_two_to_four_times_the_requested_samples() {
        for n_steps in [10_000_u64, 300_000, 1 << 20] {
            let mut interval = SamplingInterval::new(100, 300.0);
            for step in 0..n_steps {
                if interval.is_due(step) {
                    interval.count();
                }
            }
            assert!((200..=400).contains(&interval.n), "{}", interval.n);
            let even = n_steps.div_ceil(interval.stride) as usize;
            // All that is left lies at the present stride.
            assert_eq!(interval.n, even);
        }
    }
}
