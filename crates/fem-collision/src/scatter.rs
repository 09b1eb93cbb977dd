//! How far a force scatters from instant to instant: what a smooth pulse does not.
//!
//! The middle of three numbers with independent scatter s is off the mean of the others by
//! s √(3/2); a smooth pulse bends by some 1e-5 of its peak over three of a thousand instants.

use serde::{Deserialize, Serialize};

/// Fewer forces than this tell nothing.
const FEWEST: u64 = 100;

/// Running scatter of a contact force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scatter {
    /// The last two forces above zero, the later one first, N.
    last: [Option<f64>; 2],
    /// Number of forces above zero.
    n: u64,
    /// Σ of squared bends, N².
    sum: f64,
}

impl Scatter {
    /// Takes the force (N) at an instant; those of zero do not count.
    pub fn observe(&mut self, force: f64) {
        // What is no number counts, and shows.
        if force <= 0.0 {
            return;
        }
        if let [Some(middle), Some(first)] = self.last {
            self.sum += (middle - 0.5 * (first + force)).powi(2);
        }
        self.last = [Some(force), self.last[0]];
        self.n = self.n.saturating_add(1);
    }

    /// The scatter so far, N; `None` of too few forces to tell.
    pub fn force(&self) -> Option<f64> {
        (self.n > FEWEST).then(|| (self.sum / self.n as f64 / 1.5).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pulse with every second force off by a known amount, open before and after.
    fn scatter(n: usize, off: f64) -> Option<f64> {
        let mut scatter = Scatter::default();
        for k in 0..n {
            let smooth = (std::f64::consts::PI * k as f64 / n as f64).sin();
            scatter.observe(0.0);
            scatter.observe(smooth + if k % 2 == 0 { off } else { -off });
        }
        scatter.force()
    }

    #[test]
    fn the_scatter_of_a_pulse_is_what_was_put_on_it() {
        // Alternating forces are anticorrelated: a bend is twice the deviation.
        let found = scatter(1000, 1e-2).unwrap();
        assert!((found - 2e-2 / 1.5_f64.sqrt()).abs() < 1e-4, "{found}");
        assert!(scatter(1000, 0.0).unwrap() < 1e-5);
        assert_eq!(scatter(100, 1e-2), None);
        assert!(scatter(1000, f64::NAN).unwrap().is_nan());
    }
}
