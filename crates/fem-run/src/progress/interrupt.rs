//! Ctrl-C and the signals that end a process.

use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use crate::text::failure::Status;

/// Signals within this time count as one: `timeout` and some shells send one to the process and one to its
/// group.
const ONE_SIGNAL: Duration = Duration::from_secs(1);

#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens to SIGINT, SIGTERM and SIGHUP. The first one requests an orderly end, a later one ends the
    /// process at once.
    pub fn listen() -> Self {
        let interrupt = Self::default();
        let flag = interrupt.clone();
        // If no handler can be set, a signal ends the process.
        let first = Mutex::new(None);
        let _ = ctrlc::set_handler(move || {
            flag.0.store(true, Ordering::Relaxed);
            let Ok(mut first) = first.lock() else { return };
            let first = *first.get_or_insert_with(Instant::now);
            if first.elapsed() > ONE_SIGNAL {
                exit(Status::Interrupted as i32);
            }
        });
        interrupt
    }

    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
