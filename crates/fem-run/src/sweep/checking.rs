//! Says on stderr how far the members of a sweep are checked, where that takes a while.

use std::io::{Write, stderr};
use std::time::{Duration, Instant};

/// Words come after this silence.
const SILENCE: Duration = Duration::from_secs(2);

/// Counts members that are looked at.
pub struct Checking {
    /// None: nothing is to be said.
    n_members: Option<usize>,
    n_checked: usize,
    last: Instant,
}

impl Checking {
    /// Of so many members; silent if `quiet`.
    pub fn new(n_members: usize, quiet: bool) -> Self {
        let n_members = (!quiet).then_some(n_members);
        Self { n_members, n_checked: 0, last: Instant::now() }
    }

    /// The next one.
    pub fn tick(&mut self) {
        if let Some(line) = self.line(self.last.elapsed()) {
            // A closed stderr is no reason to end the sweep.
            let _ = writeln!(stderr(), "{line}");
            self.last = Instant::now();
        }
        self.n_checked += 1;
    }

    /// What is to be said after a silence.
    fn line(&self, silence: Duration) -> Option<String> {
        let n_members = self.n_members.filter(|_| silence >= SILENCE)?;
        Some(format!("checking members: {} of {n_members}", self.n_checked))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_after_a_silence_and_count() {
        let mut checking = Checking::new(1000, false);
        checking.tick();
        checking.tick();
        assert_eq!(checking.line(Duration::from_secs(1)), None);
        let line = checking.line(SILENCE);
        assert_eq!(line.as_deref(), Some("checking members: 2 of 1000"));
        assert_eq!(Checking::new(1000, true).line(SILENCE), None);
    }
}
