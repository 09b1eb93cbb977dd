//! The best parameters, and how well the data determine them.
//!
//! With J the Jacobian of the residuals in the parameters θ (logarithms of scale factors, plain
//! numbers as they are), N data and p free parameters,
//!
//! ```math
//! \mathrm{cov}(\theta) = s^2 (J^TJ)^{-1}, \qquad s^2 = \frac{\sum r_i^2}{N-p},
//! \qquad \theta_j \pm t_{N-p}\,\sigma_j,
//! ```
//!
//! with t the quantile of Student's distribution (Seber & Wild, *Nonlinear Regression*, ch. 5). Data with
//! uncertainties have s = 1 and the normal quantile: their residuals are known to be of order 1. An
//! interval of a scale factor is symmetric in its logarithm. A robust fit has weights, and a variance of its own
//! ([`crate::estimate::Robustness`]) with Student's quantile.
//!
//! Limits: first order in the residuals'
//! curvature ([`crate::estimate::Profile`] is not); residuals independent of each other, which the misfit of
//! a wrong law is not.

use nalgebra::DMatrix;

use crate::estimate::error::FitError;
use crate::estimate::least_squares::{jacobian, quantile};
use crate::estimate::problem::{Free, Problem};
use crate::estimate::robust::{Fitted, Robustness, reweight};

/// A fitted law.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Values of all parameters, free or not, in the order of the law.
    pub values: Vec<f64>,
    /// Estimates of the free parameters.
    pub estimates: Vec<Estimate>,
    /// Correlation matrix of the free parameters' θ.
    pub correlation: Vec<Vec<f64>>,
    /// Covariance matrix of the free parameters' θ; `None` without degrees of freedom.
    pub covariance: Option<Vec<Vec<f64>>>,
    /// Weighted residuals in the order of the data, in a robust fit times the roots of its weights.
    pub residuals: Vec<f64>,
    /// Sum of the squared residuals, Σ r².
    pub sum_of_squares: f64,
    /// Root mean square √(Σ r²/N) of the residuals, √(Σ w r²/Σ w) in a robust fit; without uncertainties in units of e.
    pub rms: f64,
    /// Degrees of freedom, N − p.
    pub degrees_of_freedom: usize,
    /// Half-width of the interval in standard errors; `None` without degrees of freedom.
    pub quantile: Option<f64>,
    /// Σ r² by which a profile may rise inside its interval; `None` without degrees of
    /// freedom.
    pub allowed_rise: Option<f64>,
    /// Condition number of the Jacobian with columns scaled to 1.
    pub condition: f64,
    /// The weights of the residuals in a robust fit.
    pub robustness: Option<Robustness>,
}

/// The estimate of a free parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Its index among the law's parameters.
    pub index: usize,
    /// Key of the parameter.
    pub key: &'static str,
    /// Best value, SI.
    pub value: f64,
    /// Standard error to first order, SI; `None` without degrees of freedom.
    pub standard_error: Option<f64>,
    /// The part of the data in the standard error, SI; the other part is that of uncertain inputs of the case.
    pub error_of_data: Option<f64>,
    /// Confidence interval to first order, SI.
    pub interval: Option<(f64, f64)>,
    /// Whether the best value is a bound of the search, and not a minimum.
    pub is_at_bound: bool,
}

impl Estimate {
    /// Adds the standard error of θ by other causes than the data. θ is the logarithm of a scale factor or a plain number.
    pub fn widen(&mut self, error: f64, is_logarithmic: bool, confidence: f64) {
        let quantile = quantile(confidence, None);
        let value = self.value;
        let scale = if is_logarithmic { value } else { 1.0 };
        let whole = |part: f64, other: f64| Some(part.hypot(other)).filter(|sum| sum.is_finite());
        self.standard_error = self.standard_error.and_then(|own| whole(own, scale * error));
        self.interval = self.interval.and_then(|(_, high)| match is_logarithmic {
            true => {
                let reach = whole((high / value).ln(), quantile * error)?;
                Some((value * (-reach).exp(), value * reach.exp()))
            }
            false => {
                let reach = whole(high - value, quantile * error)?;
                Some((value - reach, value + reach))
            }
        });
    }
}

/// Largest condition number: above it the error of the differences, 1e-5 of a column, dominates.
const WORST_CONDITION: f64 = 1e4;

/// Smaller columns of the Jacobian are rounding.
const INSENSITIVE: f64 = 1e-7;

/// Smallest scale of the scatter of e in a robust fit: below it differences are those of the arithmetic.
const LEAST_SCALE: f64 = 1e-6;

impl Problem<'_> {
    /// Returns the best fit, with confidence intervals of this level (such as 0.95).
    ///
    /// # Errors
    /// The data do not determine the free parameters, or the level is outside (0, 1).
    pub fn fit(&self, confidence: f64) -> Result<Fit, FitError> {
        if !(confidence > 0.0 && confidence < 1.0) {
            let (quantity, allowed) = ("confidence", "between 0 and 1");
            return Err(FitError::OutOfRange { quantity, value: confidence, allowed });
        }
        self.check_count()?;
        let (values, _) = self.solve()?;
        if !self.is_robust {
            return self.at_minimum(values, None, confidence);
        }
        let fitted = |values: Vec<f64>| {
            let failed = || FitError::NotConverged { reason: "no residuals at the minimum".into() };
            let residuals = self.residuals(&values).ok_or_else(failed)?;
            Ok(Fitted { found: values, residuals, n_free: self.free.len() })
        };
        let next = |values: &Vec<f64>, weights: &[f64]| {
            fitted(self.reweighted(weights, values).solve()?.0)
        };
        let (values, robustness) = reweight(fitted(values)?, self.least_scale(), next)?;
        let weighted = self.reweighted(&robustness.weights, &values);
        weighted.at_minimum(values, Some(robustness), confidence)
    }

    /// Returns the smallest scale of the scatter in units of the residuals.
    fn least_scale(&self) -> f64 {
        if self.has_uncertainties() { 1.0 } else { LEAST_SCALE }
    }

    /// Returns the estimate of a free parameter with an error of its variable, which is a logarithm or the parameter itself.
    fn estimate(
        &self,
        free: &Free,
        values: &[f64],
        error: Option<f64>,
        quantile: Option<f64>,
    ) -> Estimate {
        let (value, is_logarithmic) = (values[free.index], self.is_logarithmic(free));
        let standard_error = error.map(|e| if is_logarithmic { e * value } else { e });
        let reach = error.zip(quantile).map(|(error, quantile)| error * quantile);
        Estimate {
            index: free.index,
            key: self.parameter(free.index).key,
            value,
            standard_error,
            error_of_data: standard_error,
            interval: reach.map(|reach| match is_logarithmic {
                true => (value * (-reach).exp(), value * reach.exp()),
                false => (value - reach, value + reach),
            }),
            is_at_bound: false,
        }
    }

    /// Returns the fit with the values of a minimum.
    fn at_minimum(
        &self,
        values: Vec<f64>,
        robustness: Option<Robustness>,
        confidence: f64,
    ) -> Result<Fit, FitError> {
        let theta = self.theta_of(&values);
        let bounds = self.bounds();
        let residuals_at = |theta: &[f64]| self.weighted_residuals(&self.values_at(theta));
        let failed = || FitError::NotConverged { reason: "no derivatives at the minimum".into() };
        let residuals = residuals_at(&theta).ok_or_else(failed)?;
        let jacobian = jacobian(&residuals_at, &theta, &bounds).ok_or_else(failed)?;
        let (inverse, condition) = self.inverse_of_normal(&jacobian)?;
        let n_values = residuals.len();
        let sum_of_weights =
            robustness.as_ref().map_or(1.0, Robustness::mean_weight) * n_values as f64;
        let sum_of_squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let degrees_of_freedom = n_values - self.free.len();
        let freedom = degrees_of_freedom as f64;
        // Residuals over their uncertainties have the variance 1.
        let is_known = robustness.is_none() && self.has_uncertainties();
        let variance = match &robustness {
            _ if is_known => Some(1.0),
            _ if degrees_of_freedom == 0 => None,
            None => Some(sum_of_squares / freedom),
            Some(robustness) => Some(robustness.variance(self.free.len(), self.least_scale())),
        };
        let quantile = variance.map(|_| quantile(confidence, (!is_known).then_some(freedom)));
        let error = |j: usize| variance.map(|variance| (variance * inverse[(j, j)]).sqrt());
        let estimates = self.free.iter().enumerate().map(|(j, free)| {
            let (low, high) = bounds[j];
            let is_at_bound = (theta[j] - low).min(high - theta[j]) < 1e-6;
            Estimate { is_at_bound, ..self.estimate(free, &values, error(j), quantile) }
        });
        let correlation = |i: usize, j: usize| {
            if i == j { 1.0 } else { inverse[(i, j)] / (inverse[(i, i)] * inverse[(j, j)]).sqrt() }
        };
        let n_free = self.free.len();
        let matrix = |element: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
            (0..n_free).map(|i| (0..n_free).map(|j| element(i, j)).collect()).collect()
        };
        Ok(Fit {
            estimates: estimates.collect(),
            correlation: matrix(&correlation),
            covariance: variance.map(|variance| matrix(&|i, j| variance * inverse[(i, j)])),
            rms: (sum_of_squares / sum_of_weights).sqrt(),
            allowed_rise: variance.zip(quantile).map(|(variance, q)| variance * q * q),
            values,
            residuals,
            sum_of_squares,
            degrees_of_freedom,
            quantile,
            condition,
            robustness,
        })
    }

    /// Returns half of the width of the confidence band of the restitution at a speed, m/s, to first order,
    ///
    /// ```math
    /// t_{N-p}\,\sqrt{g^T\,\mathrm{cov}(\theta)\,g}, \qquad g = \frac{\partial e(v)}{\partial\theta} ;
    /// ```
    ///
    /// `None` without degrees of freedom, or if the law cannot be computed there.
    pub fn band(&self, fit: &Fit, speed: f64) -> Option<f64> {
        self.band_of(&fit.values, (fit.covariance.as_ref()?, fit.quantile?), speed)
    }

    /// Returns the same for values of all parameters, a covariance of θ and a quantile.
    pub fn band_of(
        &self,
        values: &[f64],
        (covariance, quantile): (&[Vec<f64>], f64),
        speed: f64,
    ) -> Option<f64> {
        let at = |theta: &[f64]| {
            let outcome = self.model.outcome(&self.values_at(theta), speed).ok();
            Some(vec![outcome?.restitution])
        };
        let gradient = jacobian(&at, &self.theta_of(values), &self.bounds())?;
        let each = gradient.iter().zip(covariance).map(|(own, row)| {
            own * gradient.iter().zip(row).map(|(other, element)| other * element).sum::<f64>()
        });
        Some(quantile * each.sum::<f64>().max(0.0).sqrt())
    }

    fn check_count(&self) -> Result<(), FitError> {
        let times = self.points.iter().filter(|point| point.contact_time.is_some()).count();
        let (n_values, n_free) = (self.points.len() + times, self.free.len());
        if n_free == 0 {
            return Err(FitError::NothingFree);
        }
        if n_values < n_free {
            let keys: Vec<_> =
                self.free.iter().map(|free| self.parameter(free.index).key).collect();
            return Err(FitError::TooFewData { n_values, n_free, free: keys.join(", ") });
        }
        Ok(())
    }

    /// Returns (JᵀJ)⁻¹ and the condition number of J with columns of length 1.
    fn inverse_of_normal(&self, jacobian: &DMatrix<f64>) -> Result<(DMatrix<f64>, f64), FitError> {
        let key = |j: usize| self.parameter(self.free[j].index).key;
        let lengths: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
        if let Some(j) = lengths.iter().position(|length| *length <= INSENSITIVE) {
            return Err(FitError::Insensitive { key: key(j) });
        }
        let mut scaled = jacobian.clone();
        for (mut column, length) in scaled.column_iter_mut().zip(&lengths) {
            column /= *length;
        }
        let normal = (scaled.transpose() * &scaled).symmetric_eigen();
        let largest = normal.eigenvalues.max();
        let (weakest, least) = normal.eigenvalues.argmin();
        // Eigenvalues are squares of the singular values; rounding may make the smallest slightly negative.
        let condition = (largest / least.max(f64::EPSILON * f64::EPSILON)).sqrt();
        if condition > WORST_CONDITION {
            let direction = normal.eigenvectors.column(weakest);
            let takes_part = |j: &usize| direction[*j].abs() > 0.1;
            let keys: Vec<_> = (0..lengths.len()).filter(takes_part).map(key).collect();
            return Err(FitError::Degenerate { keys: keys.join(" and "), condition });
        }
        let vectors = &normal.eigenvectors;
        let inverse_values = normal.eigenvalues.map(f64::recip);
        let mut inverse = vectors * DMatrix::from_diagonal(&inverse_values) * vectors.transpose();
        for i in 0..lengths.len() {
            for j in 0..lengths.len() {
                inverse[(i, j)] /= lengths[i] * lengths[j];
            }
        }
        Ok((inverse, condition))
    }
}
