//! How far a sweep is, on stderr: one bar over its members on a terminal, a line a member
//! elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use fem_collision::{Monitor, Progress};
use indicatif::{ProgressBar, ProgressStyle};

use crate::interrupt::Interrupt;
use crate::standard_output::one_line;

/// Ticks of the bar for one member.
const MEMBER_LENGTH: u64 = 1000;

/// What all members of this process share while they run.
pub struct Board {
    interrupt: Interrupt,
    is_aborted: AtomicBool,
    n_members: usize,
    n_done: AtomicUsize,
    display: Display,
}

enum Display {
    Nothing,
    Bar(ProgressBar),
    Lines,
}

impl Board {
    /// A board for so many members that shows nothing if `quiet`.
    pub fn new(interrupt: Interrupt, n_members: usize, quiet: bool) -> Self {
        let display = if quiet || n_members == 0 {
            Display::Nothing
        } else if stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {eta} left");
            let bar = ProgressBar::new(n_members as u64 * MEMBER_LENGTH);
            let bar = style.map_or(bar.clone(), |style| bar.with_style(style));
            bar.set_message(format!("0 of {n_members} members"));
            Display::Bar(bar)
        } else {
            Display::Lines
        };
        let is_aborted = AtomicBool::new(false);
        Self { interrupt, is_aborted, n_members, n_done: AtomicUsize::new(0), display }
    }

    /// Whether members shall end early.
    pub fn is_stopped(&self) -> bool {
        self.interrupt.is_requested() || self.is_aborted.load(Ordering::Relaxed)
    }

    /// Makes all members end early.
    pub fn abort(&self) {
        self.is_aborted.store(true, Ordering::Relaxed);
    }

    /// A member is done; `line` says which and what came out.
    pub fn finish_member(&self, line: &str) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        match &self.display {
            Display::Nothing => {}
            Display::Bar(bar) => bar.set_message(format!("{n_done} of {} members", self.n_members)),
            // A closed stderr is no reason to end the sweep.
            Display::Lines => {
                let _ = writeln!(stderr(), "[{n_done}/{}] {}", self.n_members, one_line(line));
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

/// Watches one member.
pub struct MemberWatch<'a> {
    board: &'a Board,
    ticks: u64,
}

impl<'a> MemberWatch<'a> {
    /// A watch of a member that begins.
    pub fn new(board: &'a Board) -> Self {
        Self { board, ticks: 0 }
    }

    fn advance(&mut self, ticks: u64) {
        if let Display::Bar(bar) = &self.board.display {
            bar.inc(ticks.saturating_sub(self.ticks));
        }
        self.ticks = self.ticks.max(ticks);
    }

    /// The member is done.
    pub fn finish(mut self) {
        self.advance(MEMBER_LENGTH);
    }
}

impl Monitor for MemberWatch<'_> {
    fn report(&mut self, progress: Progress) -> bool {
        self.advance((progress.fraction * MEMBER_LENGTH as f64) as u64);
        !self.board.is_stopped()
    }
}
