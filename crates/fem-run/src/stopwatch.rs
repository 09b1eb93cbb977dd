//! What a run takes, by the clock.

use std::time::{Duration, Instant};

use fem::Simulation;
use fem::results::Spent;
use fem_collision::{Collision, Monitor, Phase, Progress};

use crate::peak_memory::peak_memory;

/// A single run uses one thread; several serve several runs.
const THREADS: usize = 1;

/// Reads the clock where a run enters a phase, for who looks on.
pub struct Stopwatch {
    /// Start of the process, or of this run in it.
    started: Instant,
    setup: Duration,
    solve: Duration,
}

/// A monitor between a run and who looks on.
struct Watched<'a> {
    monitor: &'a mut dyn Monitor,
    collision: Instant,
    fields: Option<Instant>,
}

impl Monitor for Watched<'_> {
    fn enter(&mut self, phase: Phase) {
        let now = Instant::now();
        match phase {
            Phase::Collision => (self.collision, self.fields) = (now, None),
            Phase::Fields => self.fields = Some(now),
        }
        self.monitor.enter(phase);
    }

    fn report(&mut self, progress: Progress) -> bool {
        self.monitor.report(progress)
    }
}

impl Stopwatch {
    /// Runs a model that has just been built.
    pub fn run(
        started: Instant,
        simulation: &mut Simulation,
        monitor: &mut dyn Monitor,
    ) -> (Collision, Self) {
        let mut watched = Watched { monitor, collision: Instant::now(), fields: None };
        let collision = simulation.run(&mut watched);
        let end = watched.fields.unwrap_or_else(Instant::now);
        let (setup, solve) = (watched.collision - started, end - watched.collision);
        (collision, Self { started, setup, solve })
    }

    /// What was spent up to now.
    pub fn spent(&self) -> Spent {
        Spent {
            wall: self.started.elapsed().as_secs_f64(),
            setup: self.setup.as_secs_f64(),
            solve: self.solve.as_secs_f64(),
            threads: THREADS,
            peak_memory: peak_memory(),
        }
    }
}
