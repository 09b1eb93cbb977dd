//! How far a validation is, on stderr: one bar over the claims on a terminal, a line a claim
//! elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use fem_case::engineering::show;
use fem_validate::{ClaimResult, Observer};
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt::Interrupt;

/// What all claims share while they are tried.
pub struct Board {
    interrupt: Interrupt,
    started: Instant,
    n_claims: usize,
    n_done: AtomicUsize,
    bar: Option<ProgressBar>,
    is_quiet: bool,
}

impl Board {
    /// For so many claims; shows nothing if `quiet`.
    pub fn new(interrupt: Interrupt, n_claims: usize, quiet: bool) -> Self {
        let bar = (!quiet && stderr().is_terminal()).then(|| {
            let style =
                ProgressStyle::with_template("{bar:32} {pos} of {len} claims  {elapsed}  {msg}");
            let bar = ProgressBar::new(n_claims as u64);
            let bar = style.map_or(bar.clone(), |style| bar.with_style(style));
            bar.enable_steady_tick(Duration::from_millis(500));
            bar
        });
        let (started, n_done) = (Instant::now(), AtomicUsize::new(0));
        Self { interrupt, started, n_claims, n_done, bar, is_quiet: quiet }
    }

    /// Whether the user has asked for the end.
    pub fn was_interrupted(&self) -> bool {
        self.interrupt.is_requested()
    }

    /// A claim has been tried.
    pub fn finish_claim(&self, result: &ClaimResult) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        let verdict = if result.passed() { "pass" } else { "FAIL" };
        let name = &result.claim.name;
        let line = format!("{verdict}  {name}  {}", show(result.price.seconds, "s"));
        match &self.bar {
            Some(bar) => {
                bar.set_message(format!("{verdict}  {name}"));
                bar.inc(1);
            }
            None if self.is_quiet => {}
            // A closed stderr is no reason to end.
            None => {
                let _ = writeln!(stderr(), "[{n_done}/{}] {line}", self.n_claims);
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Observer for Board {
    fn clock(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn is_interrupted(&self) -> bool {
        self.was_interrupted()
    }
}
