//! Cost of a claim.

/// Cost of a claim: runs, element updates and time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Price {
    /// Number of runs; runs that claims share count in each.
    pub runs: u64,
    /// Elements times steps.
    pub element_updates: u64,
    /// Seconds of one core.
    pub seconds: f64,
}
