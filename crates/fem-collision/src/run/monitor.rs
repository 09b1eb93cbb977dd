//! Progress reports of a run, and its interruption.

/// Number of steps between two reports of a run to its monitor.
pub const STEPS_BETWEEN_REPORTS: u64 = 64;

/// The progress of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Number of completed steps.
    pub step: u64,
    /// Estimated completed fraction of the run, 0 to 1.
    pub fraction: f64,
    /// Contact force, N.
    pub contact_force: f64,
}

impl Progress {
    /// Returns the completed fraction of a run after the time `elapsed` (s) of `expected` (s). It is proportional to
    /// the time up to 0.9 and then approaches 1, in case the run takes longer.
    pub fn share(elapsed: f64, expected: f64) -> f64 {
        const IN_PROPORTION: f64 = 0.9;
        let done = elapsed / expected;
        if done <= IN_PROPORTION {
            done.max(0.0)
        } else {
            1.0 - (1.0 - IN_PROPORTION) * IN_PROPORTION / done
        }
    }
}

/// A phase of a run. A monitor can time the phases; the models never read a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The collision itself; reported again if it starts again.
    Collision,
    /// Fields at the requested instants.
    Fields,
}

/// Receives the progress of a run.
pub trait Monitor {
    /// Receives the start of a phase.
    fn enter(&mut self, _: Phase) {}

    /// Receives the progress every few steps; returning `false` interrupts the run.
    fn report(&mut self, progress: Progress) -> bool;
}

/// Ignores the progress.
impl Monitor for () {
    fn report(&mut self, _: Progress) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fraction never decreases and never reaches 1; after half of the expected time it is a half.
    #[test]
    fn progress_fraction_increases_and_stays_below_one() {
        assert_eq!(Progress::share(0.5, 1.0), 0.5);
        let shares = (0..1000).map(|k| Progress::share(0.02 * f64::from(k), 1.0));
        let shares: Vec<f64> = shares.collect();
        assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && shares[999] < 1.0);
        // Ten times as long as expected is not 99 % for nine tenths of the way.
        assert!(Progress::share(2.0, 1.0) < 0.96);
        assert_eq!(Progress::share(-1.0, 1.0), 0.0);
    }
}
