//! What a claim costs.

/// What a claim cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Price {
    /// Runs that it is made of, those shared with other claims counted in each.
    pub runs: u64,
    /// Elements times steps.
    pub element_updates: u64,
    /// Seconds of one core.
    pub seconds: f64,
}
