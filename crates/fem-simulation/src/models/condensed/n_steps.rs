//! Number of steps of condensed bodies, and their progress.

use fem_case::CondensedOptions;
use fem_collision::{Monitor, Phase, Progress};

use crate::estimate::viscous_flow::Slower;

/// Least number of steps per elastic contact time for bodies that flow.
const FEWEST_STEPS: usize = 10;

/// Loss of the moduli over the contact above which the force peaks early and needs smaller steps.
const MUCH: f64 = 0.8;
/// Factor on the number of steps of such bodies.
const MORE_OF_SOFTENED: usize = 4;
/// Largest number of steps that the factor leads to.
const ENOUGH: usize = 1000;

/// Returns the number of steps per elastic contact time for bodies that lose a share of their moduli in it. The steps are
/// longer if the bodies stop later, and shorter if they relax to little.
pub(super) fn n_steps(options: CondensedOptions, slower: Slower, relaxed: f64) -> usize {
    let steps = match relaxed > MUCH {
        true => (MORE_OF_SOFTENED * options.steps).min(ENOUGH).max(options.steps),
        false => options.steps,
    };
    let slowed = (steps as f64 / slower.stop).ceil() as usize;
    slowed.max(FEWEST_STEPS.min(steps))
}

/// A monitor that reports the share of the expected duration.
pub(super) struct ExpectedProgress<'a> {
    pub monitor: &'a mut dyn Monitor,
    /// Time of the case, in seconds.
    pub begin: f64,
    /// Predicted duration, in seconds.
    pub duration: f64,
}

impl Monitor for ExpectedProgress<'_> {
    fn enter(&mut self, phase: Phase) {
        self.monitor.enter(phase);
    }

    fn report(&mut self, progress: Progress) -> bool {
        let fraction = Progress::share(progress.time - self.begin, self.duration);
        self.monitor.report(Progress { fraction, ..progress })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_that_relax_to_little_take_more_steps() {
        let steps = |steps: usize, stop: f64, relaxed: f64| {
            let options = CondensedOptions { steps, ..CondensedOptions::default() };
            n_steps(options, Slower { stop, end: stop }, relaxed)
        };
        assert_eq!([0.0, 0.5, 0.9].map(|relaxed| steps(250, 1.0, relaxed)), [250, 250, 1000]);
        assert_eq!([100, 400, 8000].map(|own| steps(own, 1.0, 1.0)), [400, 1000, 8000]);
        assert_eq!([5.0, 1e4].map(|stop| steps(250, stop, 1.0)), [200, FEWEST_STEPS]);
    }
}
