//! Work on a thread of its own, watched by the calling thread.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use fem_collision::{Monitor, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The message of a panic.
const BROKEN: &str = "a computation stopped unexpectedly; please report it";
/// Interval at which the calling thread looks up.
const LOOK: Duration = Duration::from_millis(50);

/// Time that stopped work gets to end, if its end is not needed.
const GRACE: Duration = Duration::from_secs(1);

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

/// Runs `work` without Python's lock. Signals and exceptions of `report` end it early; they are returned
/// beside its value.
///
/// # Errors
/// The work panicked.
pub fn watched<T: Send>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&WatchState) -> T + Send,
) -> PyResult<(T, Option<PyErr>)> {
    let watched = WatchState::default();
    let mut error = None;
    let done = thread::scope(|scope| {
        let (sender, receiver) = channel();
        let watched = &watched;
        let worker = scope.spawn(move || {
            let done = work(watched);
            // The receiver exists until the thread has ended.
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
    let done = done.map_err(|_| PyRuntimeError::new_err(BROKEN))?;
    Ok((done, error))
}

/// Does the same for work that may continue by itself if it does not end within a second after it was
/// stopped, such as the factorisation of a mesh, which nothing interrupts: then there is no value.
///
/// # Errors
/// The work panicked.
pub fn watched_apart<T: Send + 'static>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&WatchState) -> T + Send + 'static,
) -> PyResult<(Option<T>, Option<PyErr>)> {
    let watched = Arc::new(WatchState::default());
    let (sender, receiver) = channel();
    let own = Arc::clone(&watched);
    // The receiver may be gone.
    thread::spawn(move || drop(sender.send(work(&own))));
    let receiver = Mutex::new(receiver);
    let wait = || {
        let receiver = receiver.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        receiver.recv_timeout(LOOK)
    };
    let mut stopped: Option<(Instant, PyErr)> = None;
    loop {
        match py.detach(wait) {
            Ok(done) => return Ok((Some(done), stopped.map(|(_, error)| error))),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(BROKEN));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        let signals = py.check_signals();
        let looked = signals.and_then(|()| match &stopped {
            None => report.map_or(Ok(()), |report| report.call1((watched.fraction(),)).map(drop)),
            Some(_) => Ok(()),
        });
        if let Err(error) = looked {
            watched.is_stopped.store(true, Ordering::Relaxed);
            stopped.get_or_insert((Instant::now(), error));
        }
        match stopped {
            Some((at, error)) if at.elapsed() > GRACE => return Ok((None, Some(error))),
            other => stopped = other,
        }
    }
}
