//! Work on a thread of its own, watched by the thread that called.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use fem_collision::{Monitor, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How often the calling thread looks up.
const LOOK: Duration = Duration::from_millis(50);

/// What work and watch share.
#[derive(Default)]
pub struct Watched {
    is_stopped: AtomicBool,
    fraction: AtomicU64,
}

impl Watched {
    /// Whether the work is to end.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// The work is so far, 0 to 1.
    pub fn set(&self, fraction: f64) {
        self.fraction.store(fraction.to_bits(), Ordering::Relaxed);
    }

    fn fraction(&self) -> f64 {
        f64::from_bits(self.fraction.load(Ordering::Relaxed))
    }
}

/// A run that is watched.
pub struct RunWatch<'a>(pub &'a Watched);

impl Monitor for RunWatch<'_> {
    fn report(&mut self, progress: Progress) -> bool {
        self.0.set(progress.fraction);
        !self.0.is_stopped()
    }
}

/// Does `work` without Python's lock. Signals and what `report` raises end it early; they are returned beside
/// what it gave.
///
/// # Errors
/// Work that panicked.
pub fn watched<T: Send>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watched) -> T + Send,
) -> PyResult<(T, Option<PyErr>)> {
    let watched = Watched::default();
    let mut error = None;
    let done = thread::scope(|scope| {
        let (sender, receiver) = channel();
        let watched = &watched;
        let worker = scope.spawn(move || {
            let done = work(watched);
            // Who waits is there until the thread has ended.
            let _ = sender.send(());
            done
        });
        let look = || -> PyResult<()> {
            py.check_signals()?;
            report.map_or(Ok(()), |report| report.call1((watched.fraction(),)).map(drop))
        };
        let receiver = Mutex::new(receiver);
        let wait = || receiver.lock().map_or(Ok(()), |receiver| receiver.recv_timeout(LOOK));
        while py.detach(wait) == Err(RecvTimeoutError::Timeout) {
            if let Err(found) = look() {
                error.get_or_insert(found);
                watched.is_stopped.store(true, Ordering::Relaxed);
            }
        }
        py.detach(|| worker.join())
    });
    let done =
        done.map_err(|_| PyRuntimeError::new_err("a computation broke off; please report it"))?;
    Ok((done, error))
}
