//! Exact time step of a Maxwell element.
//!
//! The spring's strain q of a Maxwell element that is strained by u obeys q̇ + q/τ = u̇. Over a
//! step Δt of constant rate u̇ = Δu/Δt its solution is
//!
//! ```math
//! q \leftarrow a\, q + b\, \Delta u, \qquad a = e^{-\Delta t/\tau}, \quad b = (1-a)\,\tau/\Delta t
//! ```
//!
//! for any Δt/τ: there is no stability limit, and the only approximation is the constant rate
//! (Taylor, Pister & Goudreau 1970).

/// Factors of the update for a relaxation time and a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationStep {
    /// Factor a on q, in 0 ..= 1.
    pub decay: f64,
    /// Factor b on Δu, in 0 ..= 1.
    pub gain: f64,
}

impl RelaxationStep {
    /// Creates the factors for a relaxation time and a time step, both positive, s.
    pub fn new(relaxation_time: f64, time_step: f64) -> Self {
        let ratio = time_step / relaxation_time;
        // The limit Δt/τ → 0, also reached when the ratio underflows.
        let gain = if ratio == 0.0 { 1.0 } else { -(-ratio).exp_m1() / ratio };
        Self { decay: (-ratio).exp(), gain }
    }

    /// Returns q at the end of a step in which u grew by `increment`.
    #[inline]
    pub fn advance(&self, q: f64, increment: f64) -> f64 {
        self.decay * q + self.gain * increment
    }
}
