//! How many steps condensed bodies take, and how far they are.

use fem_case::CondensedOptions;
use fem_collision::{Monitor, Phase, Progress};

use crate::flow::Slower;

/// Steps over the elastic contact time: no fewer of bodies that flow.
const FEWEST_STEPS: usize = 10;

/// Steps over the elastic contact time: as many over the time in which the bodies are stopped, if that is
/// longer.
pub(super) fn n_steps(options: CondensedOptions, slower: Slower) -> usize {
    let slowed = (options.steps as f64 / slower.stop).ceil() as usize;
    slowed.max(FEWEST_STEPS.min(options.steps))
}

/// Tells a monitor the share of the time that was foretold.
pub(super) struct Foretold<'a> {
    pub monitor: &'a mut dyn Monitor,
    /// Of the case, s.
    pub begin: f64,
    /// s.
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
