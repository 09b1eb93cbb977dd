//! Robust fits: least squares in which data far from the curve count little.
//!
//! The scatter is taken as Student's with ν = 4 degrees of freedom in place of a normal one. Its maximum of the
//! likelihood is that of least squares with the weights w, found with the scale s in turn with the parameters
//! (Lange, Little & Taylor, *J. Am. Stat. Assoc.* **84** (1989) 881; Liu & Rubin, *Stat. Sinica* **5** (1995) 19):
//!
//! ```math
//! w_i = \frac1{1+r_i^2/(\nu s^2)}, \qquad s^2 = \frac{\nu+1}\nu\,\frac{\sum w_i r_i^2}{N-p}
//! ```
//!
//! (their weights over (ν + 1)/ν, so that 1 is a point on the curve; N − p in place of N, as in least squares). The
//! influence ψ = x/(1 + x²/ν), x = r/s, falls again beyond 2 s: gross errors to one side do not shift the
//! result, as they do with Huber's constant influence. The variance is that of M-estimators (Huber, *Robust Statistics*, ch. 7; formula H1
//! of `statsmodels.RLM`),
//!
//! ```math
//! \mathrm{cov} = K^2\,\frac{s^2\sum\psi^2/(N-p)}{\overline{\psi'}^2}\,(J^TJ)^{-1}, \qquad
//! K = 1+\frac pN\,\frac{\mathrm{var}\,\psi'}{\overline{\psi'}^2},
//! ```
//!
//! with (JᵀJ)⁻¹ ≈ w̄ (Jᵀ w J)⁻¹, since outliers lie anywhere. Limits: fewer than half of the data are outliers; ν is not fitted.

use serde_json::{Value, json};

use crate::estimate::error::FitError;
use crate::estimate::least_squares::quantile;

/// Degrees of freedom ν of the scatter, as Gelman et al. take for gross errors (*Bayesian Data Analysis*, 3rd ed., ch. 20).
/// Normal scatter has 0.83 of its deviation as the scale s, and the parameters 0.89 of the efficiency of least squares.
const FREEDOM: f64 = 4.0;
/// The rounds end when no weight changes by more.
const SAME_WEIGHT: f64 = 1e-4;
const MAX_ROUNDS: usize = 60;
const MAX_SCALE_ROUNDS: usize = 200;
/// A larger share of outliers may be the curve itself.
const MANY: f64 = 0.3;
/// Least mean slope of the influence, which is 0.5 for scatter of the assumed kind.
const MIN_SLOPE: f64 = 0.1;

/// How a robust fit counts its data.
#[derive(Debug, Clone, PartialEq)]
pub struct Robustness {
    /// Weight of each residual, 1 on the curve to 0 far from it.
    pub weights: Vec<f64>,
    /// The scale s of the scatter, in units of the residuals. It is at least 1 if the data have uncertainties.
    pub scale: f64,
    /// −2 ln L of the residuals, but for constants.
    pub deviance: f64,
}

impl Robustness {
    /// Weights below this one are those of data that are weighted down: they lie 3.5 scales from the curve or farther.
    pub const FEW: f64 = 0.25;

    /// Returns the indices of the residuals that are weighted down.
    pub fn outliers(&self) -> impl Iterator<Item = usize> {
        (0..self.weights.len()).filter(|k| self.weights[*k] < Self::FEW)
    }

    /// Returns the stored form, with the number of points among these weights that are weighted down.
    pub fn numbers(&self, weights: &[f64]) -> Value {
        let n_down = weights.iter().filter(|weight| **weight < Self::FEW).count();
        json!({ "scale": self.scale, "weighted_down": n_down })
    }

    /// Returns a warning if so many data lie far from the curve that it may follow the wrong ones.
    pub fn warning(&self) -> Option<String> {
        let (n, n_far) = (self.weights.len(), self.outliers().count());
        (n_far as f64 > MANY * n as f64).then(|| {
            format!(
                "{n_far} of {n} values lie far from the curve: a robust fit follows the others, which need not be \
                 the right ones"
            )
        })
    }

    /// Returns the mean of the weights.
    pub fn mean_weight(&self) -> f64 {
        mean(self.weights.iter().copied())
    }

    /// Computes scale and weights of residuals that p parameters leave.
    fn of(residuals: &[f64], n_free: usize, least_scale: f64) -> Self {
        let freedom = residuals.len().saturating_sub(n_free).max(1) as f64;
        let sizes: Vec<f64> = residuals.iter().map(|residual| residual.abs()).collect();
        let mut scale = deviation_by_median(&sizes).max(least_scale);
        let weight =
            |residual: f64, scale: f64| (1.0 + (residual / scale).powi(2) / FREEDOM).recip();
        for _ in 0..MAX_SCALE_ROUNDS {
            let sum: f64 = residuals.iter().map(|r| weight(*r, scale) * r * r).sum();
            let next = ((FREEDOM + 1.0) / FREEDOM * sum / freedom).sqrt().max(least_scale);
            let is_same = (next / scale - 1.0).abs() < 1e-7;
            scale = next;
            if is_same {
                break;
            }
        }
        let weights: Vec<f64> = residuals.iter().map(|r| weight(*r, scale)).collect();
        let logarithms: f64 = weights.iter().map(|weight| -weight.ln()).sum();
        let deviance = 2.0 * residuals.len() as f64 * scale.ln() + (FREEDOM + 1.0) * logarithms;
        Self { weights, scale, deviance }
    }

    /// Returns the variance of a residual of weight w over w, which the inverse of Jᵀ w J is multiplied by.
    pub fn variance(&self, n_free: usize, least_scale: f64) -> f64 {
        let n = self.weights.len() as f64;
        let freedom = (n - n_free as f64).max(1.0);
        // With x² = ν (1/w − 1): ψ² = w² x² and ψ' = w² (1 − x²/ν) = w (2 w − 1).
        let influence = |w: &f64| FREEDOM * w * (1.0 - w);
        let slope = |w: &f64| w * (2.0 * w - 1.0);
        let mean_slope = mean(self.weights.iter().map(slope)).max(MIN_SLOPE);
        let spread = mean(self.weights.iter().map(|w| (slope(w) - mean_slope).powi(2)));
        let correction = 1.0 + n_free as f64 / n * spread / mean_slope.powi(2);
        let influences: f64 = self.weights.iter().map(influence).sum();
        let variance = (correction * self.scale / mean_slope).powi(2) * influences / freedom;
        self.mean_weight() * variance.max(least_scale.powi(2))
    }
}

/// A fit with the residuals of its data, before any weight, and the number of its free parameters.
pub struct Fitted<T> {
    /// Parameters at the minimum.
    pub found: T,
    /// Residuals of the data, without their robust weights.
    pub residuals: Vec<f64>,
    /// Number of free parameters.
    pub n_free: usize,
}

/// Fits in turn with the weights of the last fit's residuals until they stay; `first` is the fit of least squares.
///
/// # Errors
/// A fit fails, or the weights do not settle.
pub fn reweight<T>(
    first: Fitted<T>,
    least_scale: f64,
    mut fit: impl FnMut(&T, &[f64]) -> Result<Fitted<T>, FitError>,
) -> Result<(T, Robustness), FitError> {
    let robustness =
        |fitted: &Fitted<T>| Robustness::of(&fitted.residuals, fitted.n_free, least_scale);
    let mut fitted = first;
    let mut last = robustness(&fitted);
    for _ in 0..MAX_ROUNDS {
        fitted = fit(&fitted.found, &last.weights)?;
        let next = robustness(&fitted);
        let changes = next.weights.iter().zip(&last.weights).map(|(a, b)| (a - b).abs());
        let is_same = changes.fold(0.0, f64::max) < SAME_WEIGHT;
        last = next;
        if is_same {
            return Ok((fitted.found, last));
        }
    }
    let reason = format!("the weights of the data still change after {MAX_ROUNDS} rounds");
    Err(FitError::NotConverged { reason })
}

/// Returns the middle value of a list that is not empty; of an even number the upper one.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    let middle = sorted.len() / 2;
    *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Returns the standard deviation of normal residuals by the median of their magnitudes, which is Φ⁻¹(3/4) of it and which gross errors
/// hardly move; 0 without residuals.
pub fn deviation_by_median(magnitudes: &[f64]) -> f64 {
    if magnitudes.is_empty() { 0.0 } else { median(magnitudes) / quantile(0.5, None) }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let n = values.len().max(1) as f64;
    values.sum::<f64>() / n
}
