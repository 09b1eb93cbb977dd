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
