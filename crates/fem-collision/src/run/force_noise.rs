//! Noise of a contact force: its scatter from sample to sample.
//!
//! The middle one of three numbers with independent scatter s differs from the mean of the others by s √(3/2). For a smooth
//! pulse of a thousand samples this difference is only about 1e-5 of the peak.

use serde::{Deserialize, Serialize};

use crate::run::StepInstant;

/// Number of forces that an estimate needs.
const MIN_FORCES: u64 = 100;

/// Running scatter of a contact force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ForceNoise {
    /// The last two forces above zero, the later one first, N.
    last: [Option<f64>; 2],
    /// Number of forces above zero.
    n: u64,
    /// Sum of the squared differences, N².
    sum: f64,
    /// The largest squared difference and its instant.
    worst: Option<(f64, StepInstant)>,
}

impl ForceNoise {
    /// Adds the force (N) at an instant; zero forces do not count.
    pub fn observe(&mut self, force: f64, at: StepInstant) {
        // NaN counts, and shows in the result.
        if force <= 0.0 {
            return;
        }
        if let [Some(middle), Some(first)] = self.last {
            let bend = (middle - 0.5 * (first + force)).powi(2);
            self.sum += bend;
            if self.worst.is_none_or(|(worst, _)| bend > worst) {
                self.worst = Some((bend, at));
            }
        }
        self.last = [Some(force), self.last[0]];
        self.n = self.n.saturating_add(1);
    }

    /// Returns the instant of the largest difference.
    pub fn noisiest_instant(&self) -> Option<StepInstant> {
        self.worst.map(|(_, at)| at)
    }

    /// Returns the scatter so far, N; `None` if there are too few forces.
    pub fn force(&self) -> Option<f64> {
        (self.n > MIN_FORCES).then(|| (self.sum / self.n as f64 / 1.5).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pulse with every second force off by a known amount, open before and after.
    fn scatter(n: usize, off: f64) -> Option<f64> {
        let mut scatter = ForceNoise::default();
        for k in 0..n {
            let smooth = (std::f64::consts::PI * k as f64 / n as f64).sin();
            let at = StepInstant { time: 0.5 * k as f64, step: k as u64 };
            scatter.observe(0.0, at);
            scatter.observe(smooth + if k % 2 == 0 { off } else { -off }, at);
        }
        scatter.force()
    }

    #[test]
    fn force_noise_recovers_the_added_scatter() {
        // Alternating forces are anticorrelated: a bend is twice the deviation.
        let found = scatter(1000, 1e-2).unwrap();
        assert!((found - 2e-2 / 1.5_f64.sqrt()).abs() < 1e-4, "{found}");
        assert!(scatter(1000, 0.0).unwrap() < 1e-5);
        assert_eq!(scatter(100, 1e-2), None);
        assert!(scatter(1000, f64::NAN).unwrap().is_nan());
    }

    #[test]
    fn noisiest_instant_is_at_the_largest_second_difference() {
        let mut scatter = ForceNoise::default();
        assert_eq!(scatter.noisiest_instant(), None);
        for (step, force) in [1.0, 1.1, 1.0, 4.0, 1.0, 1.2].into_iter().enumerate() {
            scatter.observe(force, StepInstant { time: 2.0 * step as f64, step: step as u64 });
        }
        // As it is seen: with the force after the spike.
        assert_eq!(scatter.noisiest_instant(), Some(StepInstant { time: 8.0, step: 4 }));
    }
}
