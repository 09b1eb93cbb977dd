//! Progress on stderr: a bar on a terminal, plain lines elsewhere.

pub mod interrupt;
pub mod stopwatch;

use std::io::{IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use fem_case::engineering::show;
use fem_collision::{Monitor, Progress};
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressStyle};

use crate::text::standard_output::one_line;
use interrupt::Interrupt;

/// A run prints a line at every tenth of its progress ...
const LINE_SHARE: f64 = 0.1;
/// ... but not more often than this, ...
const SHORTEST_SILENCE: Duration = Duration::from_secs(1);
/// ... and at least this often.
const LONGEST_SILENCE: Duration = Duration::from_secs(30);
const TICKS: u64 = 1000;

enum Display {
    Nothing,
    Bar(ProgressBar),
    Lines,
}

impl Display {
    /// Chooses the display; a bar has this length and indicatif template. Its message, `wide_msg`, is cut to the terminal's width.
    fn choose(quiet: bool, length: u64, template: &str) -> Self {
        if quiet {
            return Self::Nothing;
        }
        if !stderr().is_terminal() {
            return Self::Lines;
        }
        let bar = ProgressBar::new(length);
        let style = ProgressStyle::with_template(template);
        Self::Bar(style.map_or(bar.clone(), |style| bar.with_style(style)))
    }

    fn bar(&self) -> Option<&ProgressBar> {
        match self {
            Self::Bar(bar) => Some(bar),
            _ => None,
        }
    }

    fn line(&self, line: &str) {
        if let Self::Lines = self {
            // A closed stderr is no reason to end.
            let _ = writeln!(stderr(), "{line}");
        }
    }

    fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// The progress of one run. As its monitor it ends the run when the user interrupts.
pub struct RunProgress {
    interrupt: Interrupt,
    display: Display,
    next_share: f64,
    last_line: Instant,
    /// Share and time of the first report.
    first: Option<(f64, Instant)>,
}

impl RunProgress {
    pub fn new(interrupt: Interrupt, quiet: bool) -> Self {
        let display =
            Display::choose(quiet, TICKS, "{bar:16} {percent:>3} %  {wide_msg}  {eta} left");
        let (next_share, last_line) = (LINE_SHARE, Instant::now());
        Self { interrupt, display, next_share, last_line, first: None }
    }

    /// Ends the display. What has been computed is written whole from now on, also of a model that never reported.
    pub fn finish(self) {
        self.interrupt.watch();
        self.display.finish();
    }
}

impl Monitor for RunProgress {
    fn report(&mut self, progress: Progress) -> bool {
        let Progress { fraction, time, step, contact_force, .. } = progress;
        let state = || {
            let (time, force) = (show(time, "s"), show(contact_force, "N"));
            format!("t = {time}  step {}  force {force}", HumanCount(step))
        };
        match &self.display {
            Display::Nothing => {}
            Display::Bar(bar) => {
                bar.set_message(state());
                bar.set_position((fraction * TICKS as f64) as u64);
            }
            Display::Lines => {
                let (first, start) = *self.first.get_or_insert((fraction, Instant::now()));
                let silence = self.last_line.elapsed();
                let is_due = fraction >= self.next_share && silence >= SHORTEST_SILENCE;
                if is_due || silence >= LONGEST_SILENCE {
                    let percent = (100.0 * fraction).floor();
                    let left = time_left(start.elapsed(), first, fraction);
                    self.display.line(&format!("{percent:>3} %  {}{left}", state()));
                    self.last_line = Instant::now();
                    self.next_share = ((fraction / LINE_SHARE).floor() + 1.0) * LINE_SHARE;
                }
            }
        }
        !self.interrupt.is_requested()
    }
}

/// Returns the time left at the speed so far, for a run that went from one share to another in `elapsed`;
/// empty if it has not moved.
fn time_left(elapsed: Duration, first: f64, now: f64) -> String {
    let seconds = elapsed.as_secs_f64() * (1.0 - now) / (now - first);
    match Duration::try_from_secs_f64(seconds) {
        Ok(left) => format!("  about {} left", HumanDuration(left)),
        Err(_) => String::new(),
    }
}

/// The progress of many items that are computed in parallel: members of a sweep, claims, variants of a study.
pub struct ItemProgress {
    interrupt: Interrupt,
    is_aborted: AtomicBool,
    what: &'static str,
    n_items: usize,
    n_done: AtomicUsize,
    display: Display,
}

impl ItemProgress {
    /// Creates the progress of `n_items` items that the plural `what` names.
    pub fn new(interrupt: Interrupt, what: &'static str, n_items: usize, quiet: bool) -> Self {
        let length = n_items as u64 * TICKS;
        let template = "{bar:16} {percent:>3} %  {wide_msg}  {elapsed}, {eta} left";
        let display = Display::choose(quiet || n_items == 0, length, template);
        if let Some(bar) = display.bar() {
            bar.set_message(format!("0 of {n_items} {what}"));
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        Self {
            interrupt,
            is_aborted: AtomicBool::new(false),
            what,
            n_items,
            n_done: AtomicUsize::new(0),
            display,
        }
    }

    /// Whether the user, or a failure elsewhere, has asked to end.
    pub fn is_stopped(&self) -> bool {
        self.interrupt.is_requested() || self.is_aborted.load(Ordering::Relaxed)
    }

    pub(crate) fn abort(&self) {
        self.is_aborted.store(true, Ordering::Relaxed);
    }

    pub(crate) fn begin(&self) -> ItemMonitor<'_> {
        ItemMonitor { progress: self, ticks: 0 }
    }

    /// Counts an item as done; where there is no bar, a line tells what came of it.
    pub fn finish_item(&self, line: &str) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        let n_items = self.n_items;
        if let Some(bar) = self.display.bar() {
            bar.set_message(format!("{n_done} of {n_items} {}", self.what));
        }
        self.display.line(&format!("[{n_done}/{n_items}] {}", one_line(line)));
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.display.finish();
    }
}

pub struct ItemMonitor<'a> {
    progress: &'a ItemProgress,
    ticks: u64,
}

impl ItemMonitor<'_> {
    fn advance(&mut self, ticks: u64) {
        if let Some(bar) = self.progress.display.bar() {
            bar.inc(ticks.saturating_sub(self.ticks));
        }
        self.ticks = self.ticks.max(ticks);
    }

    pub fn finish(mut self) {
        self.advance(TICKS);
    }
}

impl Monitor for ItemMonitor<'_> {
    fn report(&mut self, progress: Progress) -> bool {
        self.advance((progress.fraction * TICKS as f64) as u64);
        !self.progress.is_stopped()
    }
}

/// Reports on stderr how many members of a sweep have been checked, if that takes a while.
pub struct CheckProgress {
    n_members: Option<usize>,
    n_checked: usize,
    last: Instant,
}

impl CheckProgress {
    const SILENCE: Duration = Duration::from_secs(2);

    pub fn new(n_members: usize, quiet: bool) -> Self {
        let n_members = (!quiet).then_some(n_members);
        Self { n_members, n_checked: 0, last: Instant::now() }
    }

    pub fn tick(&mut self) {
        if let Some(line) = self.line(self.last.elapsed()) {
            let _ = writeln!(stderr(), "{line}");
            self.last = Instant::now();
        }
        self.n_checked += 1;
    }

    fn line(&self, silence: Duration) -> Option<String> {
        let n_members = self.n_members.filter(|_| silence >= Self::SILENCE)?;
        Some(format!("checking members: {} of {n_members}", self.n_checked))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_follows_from_the_speed_so_far() {
        let ten = Duration::from_secs(10);
        assert_eq!(time_left(ten, 0.0, 0.001), "  about 3 hours left");
        assert_eq!(time_left(ten, 0.4, 0.6), "  about 20 seconds left");
        for (first, now) in [(0.0, 0.0), (0.5, 0.4), (0.0, f64::NAN)] {
            assert_eq!(time_left(ten, first, now), "");
        }
    }

    #[test]
    fn checking_is_reported_after_a_silence() {
        let mut checking = CheckProgress::new(1000, false);
        checking.tick();
        checking.tick();
        assert_eq!(checking.line(Duration::from_secs(1)), None);
        let line = checking.line(CheckProgress::SILENCE);
        assert_eq!(line.as_deref(), Some("checking members: 2 of 1000"));
        assert_eq!(CheckProgress::new(1000, true).line(CheckProgress::SILENCE), None);
    }
}
