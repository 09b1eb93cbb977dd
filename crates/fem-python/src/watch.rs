//! Work on a thread of its own, watched by the calling thread.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use fem_collision::{Monitor, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The message of a panic.
pub const BROKEN: &str = "a computation stopped unexpectedly; please report it";
/// Interval at which the calling thread looks up.
const LOOK: Duration = Duration::from_millis(50);

/// State shared by the work and the calling thread.
#[derive(Default)]
pub struct WatchState {
    is_stopped: AtomicBool,
    fraction: AtomicU64,
}

impl WatchState {
    /// Whether the work should end.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// Sets the progress of the work, 0 to 1.
    pub fn set(&self, fraction: f64) {
        self.fraction.store(fraction.to_bits(), Ordering::Relaxed);
    }

    fn fraction(&self) -> f64 {
        f64::from_bits(self.fraction.load(Ordering::Relaxed))
    }
}

/// The monitor of a watched run.
pub struct RunWatch<'a>(pub &'a WatchState);

impl Monitor for RunWatch<'_> {
    fn report(&mut self, progress: Progress) -> bool {
        self.0.set(progress.fraction);
        !self.0.is_stopped()
    }
}

/// Runs `work` without Python's lock. Signals and exceptions of `report` stop it early; they are returned with its value.
/// There is no value if stopped work, such as the factorisation of a mesh, which nothing interrupts, does not end within
/// `grace`; it then continues by itself.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    grace: Duration,
    work: impl FnOnce(&WatchState) -> T + Send + 'static,
) -> PyResult<(Option<T>, Option<PyErr>)> {
    let watched = Arc::new(WatchState::default());
    let (sender, receiver) = channel();
    let own = Arc::clone(&watched);
    // The receiver may be gone.
    thread::spawn(move || drop(sender.send(work(&own))));
    let receiver = Mutex::new(receiver);
    let wait = || receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(LOOK);
    let mut stopped: Option<(Instant, PyErr)> = None;
    loop {
        match py.detach(wait) {
            Ok(done) => return Ok((Some(done), stopped.map(|(_, error)| error))),
            Err(RecvTimeoutError::Disconnected) => return Err(PyRuntimeError::new_err(BROKEN)),
            Err(RecvTimeoutError::Timeout) => {}
        }
        let looked = py.check_signals().and_then(|()| match (&stopped, report) {
            (None, Some(report)) => report.call1((watched.fraction(),)).map(drop),
            _ => Ok(()),
        });
        if let Err(error) = looked {
            watched.is_stopped.store(true, Ordering::Relaxed);
            stopped.get_or_insert((Instant::now(), error));
        }
        match stopped {
            Some((at, error)) if at.elapsed() > grace => return Ok((None, Some(error))),
            other => stopped = other,
        }
    }
}
