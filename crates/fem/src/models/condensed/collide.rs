//! Running a case with condensed bodies.

use std::sync::Arc;
use std::time::Instant;

use fem_condensed::{
    CollideSettings, Collision, CondensedError, CondensedPair, Ending, Frame, Glance,
};
use fem_explicit::{Monitor, Progress};
use fem_collision::Snapshot;
use fem_material::PronySeries;

use super::{CANDIDATE_GROWTH, Condensed};
use crate::case::Case;
use crate::outcome::{Outcome, Timing};

/// A run gives up after so many elastic contact times.
const GIVE_UP_AFTER: f64 = 50.0;

impl Condensed {
    /// Computes the collision; `halt` says why if it cannot.
    pub fn run(&mut self, monitor: &mut dyn Monitor) -> Outcome {
        let settings = CollideSettings {
            n_steps: self.options.steps,
            history: true,
            give_up_after: GIVE_UP_AFTER,
        };
        let frame = self.frame();
        let mut watch = |glance: Glance| {
            monitor.report(Progress {
                time: frame.first_touch() + glance.time,
                step: glance.step as u64,
                fraction: glance.fraction,
                contact_force: glance.contact_force,
            })
        };
        let relaxations = relaxations(&self.case);
        let speed = frame.approach_speed();
        match collide(&mut self.pair, speed, relaxations, &settings, &mut watch) {
            Ok((collision, timing)) => self.finish(&collision, timing),
            Err(error) => self.stopped(error),
        }
    }

    fn finish(&self, collision: &Collision, timing: Timing) -> Outcome {
        match self.snapshots(collision) {
            Ok((snapshots, missing)) => self.outcome(collision, timing, snapshots, missing),
            Err(error) => Outcome {
                halt: Some(error.into()),
                ..self.outcome(collision, timing, Vec::new(), Vec::new())
            },
        }
    }

    /// The same bodies at another speed, m/s, with other relaxations, lower body first: the factors
    /// are kept.
    ///
    /// # Errors
    /// As [`CondensedPair::collide`].
    pub fn collide_with(
        &mut self,
        speed: f64,
        relaxations: [Option<&PronySeries>; 2],
        n_steps: usize,
    ) -> Result<Collision, CondensedError> {
        let settings = CollideSettings { n_steps, history: false, give_up_after: GIVE_UP_AFTER };
        let (collision, _) = collide(&mut self.pair, speed, relaxations, &settings, &mut |_| true)?;
        match collision.ending {
            Ending::Stopped(error) => Err(error),
            _ => Ok(collision),
        }
    }

    fn snapshots(
        &self,
        collision: &Collision,
    ) -> Result<(Vec<Snapshot>, Vec<String>), CondensedError> {
        let relaxations = relaxations(&self.case);
        self.pair.snapshots(&self.frame(), relaxations, collision, &self.plan.snapshots)
    }

    pub(super) fn frame(&self) -> Frame {
        let velocities = self.case.scene.bodies.each_ref().map(|body| body.velocity);
        Frame { velocities, gap: self.plan.gap }
    }
}

/// Condenses further out as long as the contact reaches the end.
fn collide(
    pair: &mut Arc<CondensedPair>,
    speed: f64,
    relaxations: [Option<&PronySeries>; 2],
    settings: &CollideSettings,
    watch: &mut dyn FnMut(Glance) -> bool,
) -> Result<(Collision, Timing), CondensedError> {
    let start = Instant::now();
    loop {
        let prepared = pair.prepare(speed, relaxations);
        let setup = start.elapsed();
        let run = prepared.and_then(|()| pair.follow(speed, relaxations, settings, watch));
        let radius = match &run {
            Err(CondensedError::ContactBeyondCandidates { radius })
            | Ok(Collision {
                ending: Ending::Stopped(CondensedError::ContactBeyondCandidates { radius }),
                ..
            }) => *radius,
            _ => {
                let collision = start.elapsed() - setup;
                return run.map(|run| (run, Timing { setup, collision }));
            }
        };
        match (pair.enlarge(CANDIDATE_GROWTH * radius), run) {
            (Ok(larger), _) => *pair = Arc::new(larger),
            (Err(error), Ok(mut so_far)) => {
                let collision = start.elapsed() - setup;
                so_far.ending = Ending::Stopped(error);
                return Ok((so_far, Timing { setup, collision }));
            }
            (Err(error), Err(_)) => return Err(error),
        }
    }
}

fn relaxations(case: &Case) -> [Option<&PronySeries>; 2] {
    case.scene.bodies.each_ref().map(|body| body.material()?.relaxation())
}
