//! What a run takes, by the clock.

use std::time::{Duration, Instant};

use fem::results::Spent;
use fem_collision::{Monitor, Phase, Progress};

use crate::peak_memory::peak_memory;

/// A single run uses one thread; several serve several runs.
const THREADS: usize = 1;

/// What a run took.
pub struct Stopwatch {
    /// Start of the process, or of this run in it.
    started: Instant,
    setup: Duration,
    trials: Duration,
    solve: Duration,
}

/// A monitor that reads the clock where a run enters a phase, before another one that looks on.
pub struct Timed<M> {
    monitor: M,
    started: Instant,
    first: Option<Instant>,
    collision: Option<Instant>,
    fields: Option<Instant>,
}

impl<M> Timed<M> {
    /// Of a run that began at `started`.
    pub fn since(started: Instant, monitor: M) -> Self {
        Self { monitor, started, first: None, collision: None, fields: None }
    }

    /// The run has just ended; the other monitor is given back.
    pub fn stop(self) -> (Stopwatch, M) {
        let end = self.fields.unwrap_or_else(Instant::now);
        let collision = self.collision.unwrap_or(end);
        let first = self.first.unwrap_or(collision);
        let (setup, trials, solve) = (first - self.started, collision - first, end - collision);
        (Stopwatch { started: self.started, setup, trials, solve }, self.monitor)
    }
}

impl<M: Monitor> Monitor for Timed<M> {
    fn enter(&mut self, phase: Phase) {
        let now = Instant::now();
        match phase {
            Phase::Collision => {
                self.first.get_or_insert(now);
                (self.collision, self.fields) = (Some(now), None);
            }
            Phase::Fields => self.fields = Some(now),
        }
        self.monitor.enter(phase);
    }

    fn report(&mut self, progress: Progress) -> bool {
        self.monitor.report(progress)
    }
}

impl Stopwatch {
    /// What was spent up to now.
    pub fn spent(&self) -> Spent {
        Spent {
            wall: self.started.elapsed().as_secs_f64(),
            setup: self.setup.as_secs_f64(),
            trials: self.trials.as_secs_f64(),
            solve: self.solve.as_secs_f64(),
            threads: THREADS,
            peak_memory: peak_memory(),
        }
    }
}
