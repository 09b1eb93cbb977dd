//! A Prony series from restitutions, and how well the data determine it.
//!
//! For given relaxation times τ_k it finds the weights w_k = G_k/G_0 that minimise
//!
//! ```math
//! \sum_i \left(\frac{e_i(\mathbf w)-\hat e_i}{\rho_i}\right)^2 + \lambda^2\sum_k w_k^2,
//! \qquad w_k \ge 0, \quad \sum_k w_k \le 1,
//! ```
//!
//! with ρ_i the uncertainty over the rms uncertainty (1 without), and λ in units of e: a weight of 1 costs as
//! much as an error of λ at one point (Tikhonov's ridge; Honerkamp & Weese, *Rheol. Acta* 32 (1993)
//! 65, for relaxation spectra). The Gauss–Newton method solves each linear problem by exact non-negative least
//! squares (`bounded`).
//!
//! A mild loss is linear in the weights, 1 − e ≈ Σ w_k φ(T/τ_k), and φ is broad: φ ∝ T/τ for terms
//! slower than the contact, τ/T for faster ones. Over the narrow range of T that speeds make
//! (T ∝ v^(−1/5)) the columns are nearly parallel, and few combinations of weights are determined
//! ([`Resolution`]). The [`Range`] of a single weight is found with all others free.
//!
//! Limits: the relaxation times are not searched. Intervals approximate the nonlinear collision by chords, and
//! assume independent normal errors.

pub mod bounded;
mod parts;
mod ranges;
mod resolution;
mod solve;
mod speed_exponent;

pub use parts::{Parts, Share};
pub use ranges::Range;
pub use ranges::moments;
pub use resolution::{Combination, Resolution};
pub use speed_exponent::{SpeedExponent, SpeedPoint, speed_exponent};

use super::error::FitError;
use super::robust::Robustness;

/// A function from weights to the restitutions of all data.
pub type Restitutions<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, FitError> + 'a;

/// What is known of the weights without the data.
#[derive(Clone, Debug)]
pub struct WeightPrior {
    /// The most probable weights.
    pub weights: Vec<f64>,
    /// Residuals of the weights over their standard uncertainties.
    pub rows: bounded::Linear,
}

/// The data and settings from which the weights of a series are found.
pub struct SpectrumProblem<'a> {
    /// Weights to restitutions, in the order of the data.
    pub restitutions: &'a Restitutions<'a>,
    /// The measured restitutions.
    pub measured: &'a [f64],
    /// The number of each point's collision; points of one number are repeats.
    pub collisions: &'a [usize],
    /// Their standard uncertainties, if known.
    pub uncertainties: Option<&'a [f64]>,
    /// Relaxation times, s.
    pub times: &'a [f64],
    /// λ, in units of e, ≥ 0.
    pub regularisation: f64,
    /// Whether data far from the curve count little ([`crate::estimate::Robustness`]).
    pub is_robust: bool,
    /// What is known of the weights without the data, with uncertainties of the data only.
    pub prior: Option<&'a WeightPrior>,
}

impl SpectrumProblem<'_> {
    /// Returns the rms uncertainty; 1 without uncertainties.
    pub(super) fn unit(&self) -> f64 {
        self.uncertainties.map_or(1.0, root_mean_square)
    }

    /// Returns the ratio ρ_i.
    pub(super) fn ratio(&self, i: usize) -> f64 {
        self.uncertainties.map_or(1.0, |u| u[i] / self.unit())
    }
}

/// Returns √(Σ x²/N).
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// Smaller errors of restitution are those of the mesh and the time step.
pub const MODEL_ERROR: f64 = 4e-4;

/// The best weights and how well they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFit {
    /// The weights w_k in the order of the times.
    pub weights: Vec<f64>,
    /// Restitutions of the best series.
    pub restitutions: Vec<f64>,
    /// Root mean square error, √(Σ (e − ê)²/N), in a robust fit with its weights.
    pub rms: f64,
    /// Error of a restitution that the intervals assume: the rms uncertainty; without
    /// uncertainties the scatter, or [`MODEL_ERROR`] if that is larger.
    pub error: f64,
    /// Number of points less that of the weights that are neither 0 nor redundant; at most as many weights count as
    /// there are collisions.
    pub degrees_of_freedom: usize,
    /// Half-width of an interval in standard errors.
    pub quantile: f64,
    /// Weighted misfit over the uncertainties, √(χ²/freedom), freedom at least 1; without
    /// uncertainties over the repeats' scatter, which is left out of it; `None` without either.
    pub misfit: Option<f64>,
    /// The scatter of repeats, if there are any.
    pub pure_error: Option<PureError>,
    /// The combinations of weights and how well they are determined.
    pub resolution: Resolution,
    /// Range of each weight, the others free.
    pub weight_ranges: Vec<Range>,
    /// Ranges of Σ w_k, Σ w_k/τ_k (1/s) and Σ w_k τ_k (s).
    pub moments: [Range; 3],
    /// Number of evaluations of all collisions.
    pub n_evaluations: usize,
    /// The weights of the data in a robust fit.
    pub robustness: Option<Robustness>,
    /// Parts of a prior and of the data, if there is a prior.
    pub parts: Option<Parts>,
}

/// With fewer degrees of freedom than this a misfit cannot be distinguished from chance.
const MIN_DEGREES_OF_FREEDOM: usize = 3;

/// The scatter of measurements that repeat the same collision, which no model can explain.
///
/// It is the pure error of Box & Draper, *Empirical Model-Building and Response Surfaces*, ch. 3: the sum
/// of squares about the means of repeats, over the number of measurements less that of collisions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PureError {
    /// Standard deviation of one measurement.
    pub error: f64,
    /// Number of measurements less that of collisions, at least 1.
    pub degrees_of_freedom: usize,
}

impl PureError {
    /// Computes the scatter from measurements and the collision that each belongs to; `None` if none is repeated.
    pub(super) fn of(measured: &[f64], collisions: &[usize]) -> Option<Self> {
        let degrees_of_freedom = measured.len().checked_sub(n_distinct(collisions))?;
        let mean = |collision: usize| {
            let own = collisions.iter().zip(measured).filter(|(own, _)| **own == collision);
            let (n, sum) = own.fold((0, 0.0), |(n, sum), (_, value)| (n + 1, sum + value));
            sum / f64::from(n)
        };
        let both = measured.iter().zip(collisions);
        let sum: f64 = both.map(|(value, collision)| (value - mean(*collision)).powi(2)).sum();
        let error = (sum / degrees_of_freedom as f64).sqrt();
        (degrees_of_freedom > 0).then_some(Self { error, degrees_of_freedom })
    }

    /// Returns the misfit of a fit relative to the scatter of repeats, from the fit's sum of squares and the number of
    /// its collisions less that of its free weights; `None` if there are too few repeats.
    pub(super) fn misfit(&self, sum: f64, freedom: usize) -> Option<f64> {
        let own = self.error.powi(2) * self.degrees_of_freedom as f64;
        let lack = ((sum - own).max(0.0) / freedom.max(1) as f64).sqrt();
        (self.degrees_of_freedom >= MIN_DEGREES_OF_FREEDOM && self.error > 0.0)
            .then(|| lack / self.error)
    }
}

/// Returns the number of collisions.
pub(super) fn n_distinct(collisions: &[usize]) -> usize {
    let mut known = collisions.to_vec();
    known.sort_unstable();
    known.dedup();
    known.len()
}
