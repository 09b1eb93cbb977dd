//! The data and settings from which a Prony series is computed.

use crate::fit::error::FitError;

/// Restitutions of all data for given weights.
pub type Restitutions<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, FitError> + 'a;

/// Weights of a series, sought from restitutions.
pub struct SpectrumProblem<'a> {
    /// Weights to restitutions, in the order of the data.
    pub restitutions: &'a Restitutions<'a>,
    /// The measured restitutions.
    pub measured: &'a [f64],
    /// Which collision each is of, any number: those of one number are repeats.
    pub collisions: &'a [usize],
    /// Their standard uncertainties, if known.
    pub uncertainties: Option<&'a [f64]>,
    /// Relaxation times, s.
    pub times: &'a [f64],
    /// λ, in units of e, ≥ 0.
    pub regularisation: f64,
}

impl SpectrumProblem<'_> {
    /// rms uncertainty; 1 without uncertainties.
    pub(super) fn unit(&self) -> f64 {
        self.uncertainties.map_or(1.0, root_mean_square)
    }

    /// Returns the residuals ρ_i.
    pub(super) fn ratio(&self, i: usize) -> f64 {
        self.uncertainties.map_or(1.0, |u| u[i] / self.unit())
    }
}

/// Returns √(Σ x²/N).
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}
