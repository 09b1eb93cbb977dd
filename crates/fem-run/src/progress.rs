//! How far a run is, on stderr: a bar on a terminal, a few plain lines elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use fem_case::engineering::show;
use fem_collision::{Monitor, Progress};
use indicatif::{HumanCount, ProgressBar, ProgressStyle};

use crate::interrupt::Interrupt;

/// Plain lines come at each tenth of the run, ...
const LINE_SHARE: f64 = 0.1;
/// ... but not faster than this, ...
const SHORTEST_SILENCE: Duration = Duration::from_secs(1);
/// ... and at least so often.
const LONGEST_SILENCE: Duration = Duration::from_secs(30);
/// Ticks of the bar.
const BAR_LENGTH: u64 = 1000;

/// Tells the user how far the run is, and the run whether the user wants it to end.
pub struct Watch {
    interrupt: Interrupt,
    display: Display,
}

enum Display {
    Nothing,
    Bar(ProgressBar),
    Lines { next_share: f64, last_line: Instant },
}

impl Watch {
    /// A watch that shows nothing if `quiet`.
    pub fn new(interrupt: Interrupt, quiet: bool) -> Self {
        let display = if quiet {
            Display::Nothing
        } else if stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {eta} left");
            let bar = ProgressBar::new(BAR_LENGTH);
            Display::Bar(style.map_or(bar.clone(), |style| bar.with_style(style)))
        } else {
            Display::Lines { next_share: LINE_SHARE, last_line: Instant::now() }
        };
        Self { interrupt, display }
    }

    /// Takes the bar away.
    pub fn finish(self) {
        if let Display::Bar(bar) = self.display {
            bar.finish_and_clear();
        }
    }
}

impl Monitor for Watch {
    fn report(&mut self, progress: Progress) -> bool {
        match &mut self.display {
            Display::Nothing => {}
            Display::Bar(bar) => {
                bar.set_message(state(&progress));
                bar.set_position((progress.fraction * BAR_LENGTH as f64) as u64);
            }
            Display::Lines { next_share, last_line } => {
                let silence = last_line.elapsed();
                let is_due = progress.fraction >= *next_share && silence >= SHORTEST_SILENCE;
                if is_due || silence >= LONGEST_SILENCE {
                    let percent = (100.0 * progress.fraction).floor();
                    // A closed stderr is no reason to end the run.
                    let _ = writeln!(stderr(), "{percent:>3} %  {}", state(&progress));
                    *last_line = Instant::now();
                    *next_share = ((progress.fraction / LINE_SHARE).floor() + 1.0) * LINE_SHARE;
                }
            }
        }
        !self.interrupt.is_requested()
    }
}

fn state(progress: &Progress) -> String {
    format!(
        "t = {}  step {}  force {}",
        show(progress.time, "s"),
        HumanCount(progress.step),
        show(progress.contact_force, "N")
    )
}
