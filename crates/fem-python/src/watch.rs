//! Work on a thread of its own, watched by the thread that called.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use fem_collision::{Monitor, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// What a panic is told as.
const BROKEN: &str = "a computation broke off; please report it";
/// How often the calling thread looks up.
const LOOK: Duration = Duration::from_millis(50);

/// How long work that shall end early is waited for, where its end can be done without.
const GRACE: Duration = Duration::from_secs(1);

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
    let done = done.map_err(|_| PyRuntimeError::new_err(BROKEN))?;
    Ok((done, error))
}

/// As [`watched`], of work that is left to end by itself if it goes on for a second after it was stopped, such
/// as the factor of a mesh that nothing interrupts: then there is no value.
///
/// # Errors
/// Work that panicked.
pub fn watched_apart<T: Send + 'static>(
    py: Python<'_>,
    report: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watched) -> T + Send + 'static,
) -> PyResult<(Option<T>, Option<PyErr>)> {
    let watched = Arc::new(Watched::default());
    let (sender, receiver) = channel();
    let own = Arc::clone(&watched);
    // Nobody may be there any more.
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
