//! Ctrl-C and the signals that end a process.

use std::io::{Write, stderr};
use std::process::exit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::text::failure::Status;

/// Signals within this time count as one: `timeout` and some shells send one to the process and one to its
/// group.
const ONE_SIGNAL: Duration = Duration::from_secs(1);

/// Makes writes beyond a limit on the size of files fail like those on a full disk, instead of ending the process by SIGXFSZ.
pub fn survive_file_limits() {
    #[cfg(unix)]
    {
        // If no handler can be set, the signal ends the process.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    }
}

/// Whether the process is asked to end. Until somebody watches, nothing has been computed that is worth keeping, and a signal
/// ends the process at once.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    is_requested: Arc<AtomicBool>,
    is_watched: Arc<AtomicBool>,
}

impl Interrupt {
    /// Listens to the signals that ask a process to end. The first one requests an orderly end if somebody watches, and a later
    /// SIGINT, SIGTERM or SIGHUP ends the process at once. SIGXCPU, which comes again every second, and SIGUSR1 are what batch
    /// systems send before a job's time is over.
    pub fn listen() -> Self {
        let interrupt = Self::default();
        // If no handler can be set, a signal ends the process.
        let _ = interrupt.handle_signals();
        interrupt
    }

    #[cfg(unix)]
    fn handle_signals(&self) -> std::io::Result<()> {
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGXCPU};

        let asked = [SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1];
        let mut signals = signal_hook::iterator::Signals::new(asked)?;
        let interrupt = self.clone();
        std::thread::spawn(move || {
            let mut first = None;
            for signal in signals.forever() {
                match signal {
                    SIGXCPU | SIGUSR1 => interrupt.request(),
                    _ => interrupt.request_or_exit(&mut first),
                }
            }
        });
        Ok(())
    }

    #[cfg(not(unix))]
    fn handle_signals(&self) -> Result<(), ctrlc::Error> {
        let interrupt = self.clone();
        let first = std::sync::Mutex::new(None);
        ctrlc::set_handler(move || {
            if let Ok(mut first) = first.lock() {
                interrupt.request_or_exit(&mut first);
            }
        })
    }

    fn request(&self) {
        self.is_requested.store(true, Ordering::Relaxed);
        if !self.is_watched.load(Ordering::Relaxed) {
            let _ = writeln!(stderr(), "error: interrupted; no result was written");
            exit(Status::Interrupted as i32);
        }
    }

    fn request_or_exit(&self, first: &mut Option<Instant>) {
        self.request();
        if first.get_or_insert_with(Instant::now).elapsed() > ONE_SIGNAL {
            exit(Status::Interrupted as i32);
        }
    }

    /// From now on a request is seen to.
    pub fn watch(&self) {
        self.is_watched.store(true, Ordering::Relaxed);
    }

    /// Whether an end is requested; from now on a request is seen to.
    pub fn is_requested(&self) -> bool {
        self.watch();
        self.is_requested.load(Ordering::Relaxed)
    }
}
