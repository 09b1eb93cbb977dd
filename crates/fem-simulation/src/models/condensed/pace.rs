//! Number of steps of condensed bodies, and their progress.

use fem_case::CondensedOptions;
use fem_collision::{Monitor, Phase, Progress};

use crate::estimate::viscous_flow::Slower;

/// Steps over the elastic contact time: no fewer of bodies that flow.
const FEWEST_STEPS: usize = 10;

/// Bodies that lose more than this share of their moduli over the contact press hardest early, ...
const MUCH: f64 = 0.8;
/// ... which takes so many times the steps, ...
const MORE_OF_SOFTENED: usize = 4;
/// ... up to so many.
const ENOUGH: usize = 1000;

/// Steps over the elastic contact time, of bodies that lose this share of their moduli in it: as many over the time in
/// which the bodies are stopped, if that is longer, and more of those that relax to little.
pub(super) fn n_steps(options: CondensedOptions, slower: Slower, relaxed: f64) -> usize {
    let steps = match relaxed > MUCH {
        true => (MORE_OF_SOFTENED * options.steps).min(ENOUGH).max(options.steps),
        false => options.steps,
    };
    let slowed = (steps as f64 / slower.stop).ceil() as usize;
    slowed.max(FEWEST_STEPS.min(steps))
}

/// Reports the share of the predicted time to a monitor.
pub(super) struct Foretold<'a> {
    pub monitor: &'a mut dyn Monitor,
    /// Time of the case, in seconds.
    pub begin: f64,
    /// Predicted duration, in seconds.
    pub duration: f64,
}

impl Monitor for Foretold<'_> {
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
