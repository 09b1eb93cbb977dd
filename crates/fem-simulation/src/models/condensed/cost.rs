//! Number of steps, progress and expected memory of condensed bodies.

use fem_case::{Body, CondensedOptions};
use fem_collision::{Monitor, Phase, Progress};
use fem_material::{ActsOn, Material};

use crate::estimate::viscous_flow::SlowdownFactors;

/// Least number of steps per elastic contact time for bodies that flow.
const MIN_STEPS: usize = 10;

/// Loss of the moduli over the contact above which the force peaks early and needs smaller steps.
const LOSS_OF_MODULI_OF_EARLY_PEAK: f64 = 0.8;
/// Factor on the number of steps of such bodies.
const MORE_OF_SOFTENED: usize = 4;
/// Largest number of steps that the factor leads to.
const MAX_STEPS_BY_FACTOR: usize = 1000;

/// Returns the number of steps per elastic contact time for bodies that lose a share of their moduli in it. The steps are
/// longer if the bodies stop later, and shorter if they relax to little.
pub(super) fn n_steps(options: CondensedOptions, slower: SlowdownFactors, relaxed: f64) -> usize {
    let steps = match relaxed > LOSS_OF_MODULI_OF_EARLY_PEAK {
        true => (MORE_OF_SOFTENED * options.steps).min(MAX_STEPS_BY_FACTOR).max(options.steps),
        false => options.steps,
    };
    let slowed = (steps as f64 / slower.stop).ceil() as usize;
    slowed.max(MIN_STEPS.min(steps))
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

/// Bytes per element during elimination. Measured like the others for pairs, a wall and a half-space with 2,300 to 46,000
/// elements: 0.5 to 0.9 kB, 2.8 kB if the factor is kept for snapshots, and 5 to 7 kB with springs of relaxation.
const BYTES_PER_ELIMINATED_ELEMENT: u64 = 800;
/// Bytes per element with its share of a kept factor.
const BYTES_PER_KEPT_ELEMENT: u64 = 2_800;
/// Bytes per element with its share of the factor and of the springs of a relaxing shear modulus.
const BYTES_PER_RELAXING_ELEMENT: u64 = 7_000;
/// Largest number of bytes per element.
pub(crate) const MAX_BYTES: u64 = 8_000;

/// Returns whether condensed bodies need springs for the relaxation of a body.
pub(crate) fn relaxes_in_shear(body: &Body) -> bool {
    let series = body.material().and_then(Material::relaxation);
    series.is_some_and(|series| series.acts_on() == ActsOn::Shear)
}

/// Returns the expected bytes of bodies with these numbers of elements.
pub(crate) fn expected_bytes(bodies: [(&Body, u64); 2], keeps_factors: bool) -> u64 {
    let has_springs = bodies.map(|(body, _)| relaxes_in_shear(body));
    let plain = if keeps_factors || has_springs.contains(&true) {
        BYTES_PER_KEPT_ELEMENT
    } else {
        BYTES_PER_ELIMINATED_ELEMENT
    };
    let each = has_springs.map(|has| if has { BYTES_PER_RELAXING_ELEMENT } else { plain });
    bodies.iter().zip(each).map(|((_, elements), bytes)| elements.saturating_mul(bytes)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_that_relax_to_little_take_more_steps() {
        let steps = |steps: usize, stop: f64, relaxed: f64| {
            let options = CondensedOptions { steps, ..fem_case::defaults::CONDENSED };
            n_steps(options, SlowdownFactors { stop, end: stop }, relaxed)
        };
        assert_eq!([0.0, 0.5, 0.9].map(|relaxed| steps(250, 1.0, relaxed)), [250, 250, 1000]);
        assert_eq!([100, 400, 8000].map(|own| steps(own, 1.0, 1.0)), [400, 1000, 8000]);
        assert_eq!([5.0, 1e4].map(|stop| steps(250, stop, 1.0)), [200, MIN_STEPS]);
    }
}
