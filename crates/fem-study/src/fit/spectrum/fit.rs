//! The best series, and how well its weights are known.

use super::ranges::Range;
use super::repeats::PureError;
use super::resolution::Resolution;

/// Errors of restitution below this are the mesh's and the time step's own.
pub const MODEL_ERROR: f64 = 4e-4;

/// The best weights.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFit {
    /// w_k in the order of the times.
    pub weights: Vec<f64>,
    /// e of the best series.
    pub restitutions: Vec<f64>,
    /// Root mean square error, √(Σ (e − ê)²/N).
    pub rms: f64,
    /// Error of a restitution that the intervals assume: the rms uncertainty; without
    /// uncertainties the scatter, or [`MODEL_ERROR`] if that is larger.
    pub error: f64,
    /// Data less weights that are neither 0 nor spare, of which no more count than collisions.
    pub degrees_of_freedom: usize,
    /// Half-width of an interval in standard errors.
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
