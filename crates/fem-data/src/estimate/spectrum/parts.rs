//! Parts of a prior and of the data in the weights and the restitutions.
//!
//! About the best weights everything is linear. With J the derivatives of the restitutions over their uncertainties and P the
//! rows of the prior the covariance of the weights is (PᵀP)⁻¹ by the prior and (PᵀP + JᵀJ)⁻¹ by both. The share of the data in a weight is
//! that of the prior's variance which they take away; the trace of (PᵀP + JᵀJ)⁻¹ JᵀJ is the number of weights that they determine in all
//! (Rodgers, *Inverse Methods for Atmospheric Sounding*, ch. 2).
//!
//! Limits: the bounds of the weights are left out of these errors, which are too large where a weight is zero.

use nalgebra::{DMatrix, DVector};

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The best estimate of it.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// Parts of a prior and of the data in the weights and the restitutions.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    /// The weights by the prior alone.
    pub weights: Vec<Share>,
    /// Standard errors of the weights by both.
    pub errors: Vec<f64>,
    /// Share of the data in each weight, 0 to 1.
    pub shares: Vec<f64>,
    /// Number of weights that the data determine.
    pub n_of_data: f64,
    /// The mean restitution, each with the inverse square of its uncertainty, by the prior alone, by the data alone, and by both.
    pub restitution: [Share; 3],
    /// Restitutions by the prior alone.
    pub restitutions: Vec<f64>,
}

/// The derivatives of the restitutions, those of the prior's residuals, and the restitutions.
pub(super) struct Evidence<'a> {
    pub jacobian: &'a DMatrix<f64>,
    pub prior: &'a DMatrix<f64>,
    pub prior_weights: &'a [f64],
    pub uncertainties: &'a [f64],
    pub measured: &'a [f64],
    pub best: &'a [f64],
    pub of_prior: Vec<f64>,
}

impl Parts {
    /// Returns the parts; `None` if the prior leaves a weight undetermined.
    pub(super) fn of(evidence: Evidence<'_>) -> Option<Self> {
        let Evidence { jacobian, prior, uncertainties, .. } = evidence;
        let (rows, n) = jacobian.shape();
        let scaled = DMatrix::from_fn(rows, n, |i, k| jacobian[(i, k)] / uncertainties[i]);
        let of_data = scaled.transpose() * &scaled;
        let of_prior = prior.transpose() * prior;
        let before = of_prior.clone().cholesky()?.inverse();
        let after = (of_prior + &of_data).cholesky()?.inverse();
        let counts: Vec<f64> = uncertainties.iter().map(|u| u.powi(-2)).collect();
        let all: f64 = counts.iter().sum();
        let mean = |values: &[f64]| {
            values.iter().zip(&counts).map(|(value, count)| value * count).sum::<f64>() / all
        };
        let slope = DVector::from_fn(n, |k, _| {
            (0..rows).map(|i| jacobian[(i, k)] * counts[i]).sum::<f64>()
        });
        let slope = slope / all;
        let error = |covariance: &DMatrix<f64>| slope.dot(&(covariance * &slope)).max(0.0).sqrt();
        let n_of_data = (&after * of_data).trace();
        let errors = |covariance: &DMatrix<f64>| -> Vec<f64> {
            covariance.diagonal().iter().map(|variance| variance.max(0.0).sqrt()).collect()
        };
        let (own, left) = (errors(&before), errors(&after));
        let shares = own.iter().zip(&left).map(|(own, left)| 1.0 - (left / own).powi(2).min(1.0));
        let shares = shares.collect();
        let weights = evidence.prior_weights.iter().zip(own);
        Some(Self {
            weights: weights.map(|(value, error)| Share { value: *value, error }).collect(),
            errors: left,
            shares,
            n_of_data,
            restitution: [
                Share { value: mean(&evidence.of_prior), error: error(&before) },
                Share { value: mean(evidence.measured), error: all.sqrt().recip() },
                Share { value: mean(evidence.best), error: error(&after) },
            ],
            restitutions: evidence.of_prior,
        })
    }
}
