//! How far a run is, on stderr: a bar on a terminal, a few plain lines elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use fem_case::engineering::show;
use fem_collision::{Monitor, Progress};
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressStyle};

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
    /// With what the first report said, and when.
    Lines {
        next_share: f64,
        last_line: Instant,
        first: Option<(f64, Instant)>,
    },
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
            Display::Lines { next_share: LINE_SHARE, last_line: Instant::now(), first: None }
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
            Display::Lines { next_share, last_line, first } => {
                let (first_share, start) =
                    *first.get_or_insert((progress.fraction, Instant::now()));
                let silence = last_line.elapsed();
                let is_due = progress.fraction >= *next_share && silence >= SHORTEST_SILENCE;
                if is_due || silence >= LONGEST_SILENCE {
                    let percent = (100.0 * progress.fraction).floor();
                    let left = left(start.elapsed(), first_share, progress.fraction);
                    // A closed stderr is no reason to end the run.
                    let _ = writeln!(stderr(), "{percent:>3} %  {}{left}", state(&progress));
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

/// What is left at the pace so far, of a run that went from one share to another in so long; nothing where it has not moved.
fn left(elapsed: Duration, first: f64, now: f64) -> String {
    let seconds = elapsed.as_secs_f64() * (1.0 - now) / (now - first);
    match Duration::try_from_secs_f64(seconds) {
        Ok(left) => format!("  about {} left", HumanDuration(left)),
        Err(_) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_goes_by_the_pace_so_far() {
        let ten = Duration::from_secs(10);
        assert_eq!(left(ten, 0.0, 0.001), "  about 3 hours left");
        assert_eq!(left(ten, 0.4, 0.6), "  about 20 seconds left");
        for (first, now) in [(0.0, 0.0), (0.5, 0.4), (0.0, f64::NAN)] {
            assert_eq!(left(ten, first, now), "");
        }
    }
}
