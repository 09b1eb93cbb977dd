//! Who looks on while a collision is computed.

/// Steps that a run does between two reports to its monitor.
pub const STEPS_BETWEEN_REPORTS: u64 = 64;

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// Estimated share of the run that is done, 0 to 1.
    pub fraction: f64,
    /// Contact force, N.
    pub contact_force: f64,
}

impl Progress {
    /// Share of a run that is done after so long, s, of one that is expected to take `expected`, s: in
    /// proportion up to nine tenths, and where it takes longer ever less of the last one.
    pub fn share(elapsed: f64, expected: f64) -> f64 {
        const IN_PROPORTION: f64 = 0.9;
        let done = elapsed / expected;
        if done <= IN_PROPORTION {
            done.max(0.0)
        } else {
            1.0 - (1.0 - IN_PROPORTION) * IN_PROPORTION / done
        }
    }
}

/// What a run does from now on. Nothing below the caller reads a clock; who wants to know where the
/// time goes reads one here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The collision itself; once more if it has to be begun again.
    Collision,
    /// Fields at the instants that are asked for.
    Fields,
}

/// Looks on while a run goes on.
pub trait Monitor {
    /// Called where a phase begins.
    fn enter(&mut self, _: Phase) {}

    /// Called every few steps; `false` interrupts the run.
    fn report(&mut self, progress: Progress) -> bool;
}

/// Nobody looks on.
impl Monitor for () {
    fn report(&mut self, _: Progress) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It never goes back, never ends early, and half of it is half of what was expected.
    #[test]
    fn the_share_that_is_done_grows_and_stays_below_the_whole() {
        assert_eq!(Progress::share(0.5, 1.0), 0.5);
        let shares = (0..1000).map(|k| Progress::share(0.02 * f64::from(k), 1.0));
        let shares: Vec<f64> = shares.collect();
        assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && shares[999] < 1.0);
        // Ten times as long as expected is not 99 % for nine tenths of the way.
        assert!(Progress::share(2.0, 1.0) < 0.96);
        assert_eq!(Progress::share(-1.0, 1.0), 0.0);
    }
}
