//! A Prony series from restitutions, and what the data leave open of it.
//!
//! The relaxation times τ_k are given; found are the weights w_k = G_k/G_0, those that minimise
//!
//! ```math
//! \sum_i \left(\frac{e_i(\mathbf w)-\hat e_i}{\rho_i}\right)^2 + \lambda^2\sum_k w_k^2,
//! \qquad w_k \ge 0, \quad \sum_k w_k \le 1,
//! ```
//!
//! ρ_i the uncertainty over the rms uncertainty (1 without), λ in units of e: a weight of 1 costs as
//! much as an error of λ at one point (Tikhonov's ridge; Honerkamp & Weese, *Rheol. Acta* 32 (1993)
//! 65, for relaxation spectra). By Gauss and Newton, each linear problem an exact non-negative least
//! squares (`bounded`).
//!
//! A mild loss is linear in the weights, 1 − e ≈ Σ w_k φ(T/τ_k), and φ is broad: φ ∝ T/τ for terms
//! slower than the contact, τ/T for faster ones. Over the narrow range of T that speeds make
//! (T ∝ v^(−1/5)) the columns are nearly parallel, and few combinations of weights are determined
//! ([`Resolution`]); what a single weight can be is asked with all others free ([`Range`]).
//!
//! Limits: the relaxation times are not searched; intervals follow the curved collision by chords,
//! the statistics are those of independent normal errors.

mod bounded;
mod ranges;
mod repeats;
mod resolution;
mod solve;
mod speed_exponent;

pub use ranges::Range;
pub use repeats::PureError;
pub use resolution::{Combination, Resolution};
pub use speed_exponent::{SpeedExponent, SpeedPoint, speed_exponent};

use crate::error::FitError;

/// Restitutions of all data for given weights.
pub type Restitutions<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, FitError> + 'a;

/// Errors of restitution below this are the mesh's and the time step's own.
pub const MODEL_ERROR: f64 = 4e-4;

/// Weights of a series, sought from restitutions.
pub struct SpectrumProblem<'a> {
    /// Weights to restitutions, in the order of the data.
    pub restitutions: &'a Restitutions<'a>,
    /// Measured restitutions.
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

/// The best weights.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFit {
    /// w_k in the order of the times.
    pub weights: Vec<f64>,
    /// e of the best series.
    pub restitutions: Vec<f64>,
    /// √(Σ (e − ê)²/N).
    pub rms: f64,
    /// Error of a restitution that the intervals assume: the rms uncertainty; without
    /// uncertainties the scatter, or [`MODEL_ERROR`] if that is larger.
    pub error: f64,
    /// Data less weights that are neither 0 nor spare, of which no more count than collisions.
    pub degrees_of_freedom: usize,
    /// How many errors an interval reaches.
    pub quantile: f64,
    /// Weighted misfit over the uncertainties, √(χ²/freedom), freedom at least 1; without
    /// uncertainties over the repeats' scatter, which is left out of it; `None` without either.
    pub misfit: Option<f64>,
    /// The scatter of repeats, if there are any.
    pub pure_error: Option<PureError>,
    /// Which combinations are determined.
    pub resolution: Resolution,
    /// Each weight's, the others free.
    pub weight_ranges: Vec<Range>,
    /// Σ w_k, of w_k/τ_k (1/s) and of w_k τ_k (s).
    pub moments: [Range; 3],
    /// Collisions of all data that were computed.
    pub n_evaluations: usize,
}

/// √(Σ x²/N).
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

impl SpectrumProblem<'_> {
    /// The best weights and their intervals at this level of confidence (such as 0.95).
    ///
    /// # Errors
    /// Fewer data than weights without regularisation; a level outside (0, 1); a λ that is negative
    /// or not finite; a collision that cannot be computed.
    pub fn fit(&self, confidence: f64) -> Result<SpectrumFit, FitError> {
        let range = |quantity, value, allowed, is_good: bool| {
            let error = FitError::OutOfRange { quantity, value, allowed };
            if is_good { Ok(()) } else { Err(error) }
        };
        let is_level = confidence > 0.0 && confidence < 1.0;
        range("confidence", confidence, "between 0 and 1", is_level)?;
        let is_ridge = self.regularisation >= 0.0 && self.regularisation.is_finite();
        range("regularisation", self.regularisation, "at least 0 and finite", is_ridge)?;
        let (n_values, n_free) = (self.measured.len(), self.times.len());
        if n_values < n_free && self.regularisation == 0.0 {
            let free = "the weights of the series".to_string();
            return Err(FitError::TooFewData { n_values, n_free, free });
        }
        solve::Solver::new(self).fit(confidence)
    }

    /// rms uncertainty; 1 without uncertainties.
    fn unit(&self) -> f64 {
        self.uncertainties.map_or(1.0, root_mean_square)
    }

    /// ρ_i.
    fn ratio(&self, i: usize) -> f64 {
        self.uncertainties.map_or(1.0, |u| u[i] / self.unit())
    }
}
