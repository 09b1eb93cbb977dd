//! The time and the memory that a run takes.

use std::time::{Duration, Instant};

use fem::results::{CostSummary, Summary};
use fem::{ComputedCollision, ErrorEstimator, Simulation};
use fem_collision::{Monitor, Phase, Progress};

/// Threads of a single run.
const THREADS: usize = 1;

/// The times of a finished run.
pub struct Stopwatch {
    /// Start of the process, or of this run in it.
    started: Instant,
    setup: Duration,
    trials: Duration,
    solve: Duration,
}

/// A monitor that records when a run enters its phases, and passes everything on to another monitor.
pub struct Timed<M> {
    monitor: M,
    started: Instant,
    first: Option<Instant>,
    collision: Option<Instant>,
    fields: Option<Instant>,
}

impl<M> Timed<M> {
    /// Creates the monitor of a run that began at `started`.
    pub fn since(started: Instant, monitor: M) -> Self {
        Self { monitor, started, first: None, collision: None, fields: None }
    }

    /// Ends the timing now; returns the times and the other monitor.
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
    /// Returns the summary of a run with what it has spent until now and the names of its files.
    pub fn summary(&self, ran: &ComputedCollision, files: Vec<String>) -> Summary {
        let ComputedCollision { simulation, collision, errors } = ran;
        Summary::of(simulation, collision, errors, self.spent(), ran.warnings(), files)
    }

    /// Returns what has been spent until now.
    pub fn spent(&self) -> CostSummary {
        CostSummary {
            wall_s: self.started.elapsed().as_secs_f64(),
            setup_s: self.setup.as_secs_f64(),
            trials_s: self.trials.as_secs_f64(),
            solve_s: self.solve.as_secs_f64(),
            threads: THREADS,
            peak_memory_bytes: peak_memory(),
            ..CostSummary::default()
        }
    }
}

/// Returns the peak memory (bytes) of the process at the end of a run, reference runs before and after it
/// included; `None` for models without elements.
pub fn peak_memory_with(simulation: &Simulation, estimator: &ErrorEstimator) -> Option<u64> {
    let (run, reference_runs) = estimator.memory_ahead(simulation)?;
    let held = peak_memory().unwrap_or(0);
    Some(run.max(held + reference_runs.unwrap_or(0)))
}

/// Returns the peak memory of this process in bytes; `None` if the system does not report it.
///
/// On Linux it is the high-water mark of the resident set since the program was loaded (`VmHWM`); `getrusage`
/// would also count the process that started this one.
#[cfg(target_os = "linux")]
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}

#[cfg(all(unix, not(target_os = "linux")))]
fn peak_memory() -> Option<u64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let size = u64::try_from(getrusage(UsageWho::RUSAGE_SELF).ok()?.max_rss()).ok()?;
    Some(if cfg!(target_vendor = "apple") { size } else { 1024 * size })
}

#[cfg(not(unix))]
fn peak_memory() -> Option<u64> {
    None
}
