//! The minimum of a sum of squares inside bounds, and what its derivatives say of the parameters there.
//!
//! The minimum is found by steps of Gauss and Newton, damped as by Levenberg and Marquardt in proportion to the diagonal of the normal
//! matrix (Marquardt, *J. Soc. Ind. Appl. Math.* 11 (1963) 431),
//!
//! ```math
//! (J^TJ + \lambda\,\mathrm{diag}\,J^TJ)\,\delta = -J^Tr .
//! ```
//!
//! A parameter at a bound is held there as long as the sum of squares falls towards the outside.

use nalgebra::{Cholesky, DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::estimate::error::FitError;

/// Step of the differences: parameters are logarithms or numbers of order 1.
const STEP: f64 = 1e-4;
/// Damping of the first step.
const FIRST_DAMPING: f64 = 1e-3;
/// Damping above which no step lowers the sum.
const MAX_DAMPING: f64 = 1e6;

/// When a search ends, and how far it steps.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// The longest change of a parameter in a step that is the last one.
    pub of_parameters: f64,
    /// The gain of a step that is the last one, over the sum of squares per residual.
    pub of_sum: f64,
    /// The largest number of steps.
    pub n_steps: usize,
    /// The longest step of a parameter.
    pub longest_step: f64,
}

impl Accuracy {
    /// The accuracy for sums without noise whose derivatives are differences.
    const FULL: Self =
        Self { of_parameters: 1e-9, of_sum: 1e-11, n_steps: 200, longest_step: f64::INFINITY };
}

/// Residuals that depend on parameters.
pub trait SumOfSquares {
    /// The residuals at a point, and what their derivatives are made of.
    type At;

    /// Computes the residuals at a point; `None` if there are none.
    fn at(&self, parameters: &[f64]) -> Option<Self::At>;

    /// Returns the residuals.
    fn residuals<'p>(&self, at: &'p Self::At) -> &'p DVector<f64>;

    /// Returns the derivatives ∂r_i/∂θ_j of the residuals.
    fn slopes(&self, parameters: &[f64], at: &Self::At) -> Option<DMatrix<f64>>;

    /// Returns the parameters with the least sum of squares within the bounds of each parameter, and the residuals there. There may be
    /// fewer residuals than parameters. `None` if the residuals or the derivatives cannot be computed on the way.
    fn minimise(
        &self,
        start: &[f64],
        bounds: &[(f64, f64)],
        accuracy: Accuracy,
    ) -> Option<(Vec<f64>, Self::At)> {
        let n = start.len();
        let inside = |k: usize, value: f64| value.clamp(bounds[k].0, bounds[k].1);
        let misfit = |at: &Self::At| self.residuals(at).norm_squared();
        let mut found: Vec<f64> = (0..n).map(|k| inside(k, start[k])).collect();
        let mut at = self.at(&found)?;
        let mut damping = FIRST_DAMPING;
        for _ in 0..accuracy.n_steps {
            let slopes = self.slopes(&found, &at)?;
            let mut normal = slopes.transpose() * &slopes;
            let mut gradient = slopes.tr_mul(self.residuals(&at));
            for k in 0..n {
                if inside(k, found[k] - 1e-6 * gradient[k].signum()) == found[k] {
                    normal.row_mut(k).fill(0.0);
                    normal.column_mut(k).fill(0.0);
                    gradient[k] = 0.0;
                }
            }
            let floor = 1e-12 * normal.diagonal().max().max(f64::MIN_POSITIVE);
            let (mut size, before) = (0.0, misfit(&at));
            while damping < MAX_DAMPING {
                let mut damped = normal.clone();
                for k in 0..n {
                    damped[(k, k)] += damping * damped[(k, k)].max(floor);
                }
                let step = Cholesky::new(damped).map(|factor| factor.solve(&gradient));
                let step = step.unwrap_or_else(|| DVector::zeros(n));
                let longest = accuracy.longest_step;
                let step = step.map(|it| it.clamp(-longest, longest));
                let trial: Vec<f64> = (0..n).map(|k| inside(k, found[k] - step[k])).collect();
                if let Some(tried) = self.at(&trial).filter(|tried| misfit(tried) <= before) {
                    (found, at, size) = (trial, tried, step.amax());
                    damping *= 0.1;
                    break;
                }
                damping *= 10.0;
            }
            let gain = (before - misfit(&at)) * self.residuals(&at).len() as f64;
            if size < accuracy.of_parameters || gain < accuracy.of_sum * misfit(&at) {
                break;
            }
        }
        Some((found, at))
    }
}

/// Residuals as a function of the parameters; `None` if they cannot be computed.
pub type Residuals<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + 'a;

/// Residuals with their derivatives by differences within bounds.
struct ByDifferences<'a>(&'a Residuals<'a>, &'a [(f64, f64)]);

impl SumOfSquares for ByDifferences<'_> {
    type At = DVector<f64>;

    fn at(&self, parameters: &[f64]) -> Option<DVector<f64>> {
        (self.0)(parameters).map(DVector::from_vec)
    }

    fn residuals<'p>(&self, at: &'p DVector<f64>) -> &'p DVector<f64> {
        at
    }

    fn slopes(&self, parameters: &[f64], _: &DVector<f64>) -> Option<DMatrix<f64>> {
        jacobian(self.0, parameters, self.1)
    }
}

/// Returns the parameters of the minimum nearest to `start` within the `bounds` of each parameter, and the sum of squares there.
///
/// # Errors
/// The residuals cannot be computed at the start or next to a point of the search.
pub fn minimise(
    residuals: &Residuals<'_>,
    start: &[f64],
    bounds: &[(f64, f64)],
) -> Result<(Vec<f64>, f64), FitError> {
    let found = ByDifferences(residuals, bounds).minimise(start, bounds, Accuracy::FULL);
    let (found, at) = found.ok_or_else(|| FitError::NotConverged {
        reason: "the law cannot be computed on the way to the minimum".into(),
    })?;
    Ok((found, at.norm_squared()))
}

/// Returns ∂r_i/∂θ_j by differences, one-sided next to a bound.
pub fn jacobian(
    residuals: &Residuals<'_>,
    at: &[f64],
    bounds: &[(f64, f64)],
) -> Option<DMatrix<f64>> {
    let mut columns = Vec::new();
    for (j, (low, high)) in bounds.iter().enumerate() {
        let side = |step: f64| {
            let mut parameters = at.to_vec();
            parameters[j] = (at[j] + step).clamp(*low, *high);
            Some((parameters[j], residuals(&parameters)?))
        };
        let ((below, first), (above, second)) = (side(-STEP)?, side(STEP)?);
        let difference = first.iter().zip(&second).map(|(a, b)| (b - a) / (above - below));
        columns.push(DVector::from_iterator(first.len(), difference));
    }
    Some(DMatrix::from_columns(&columns))
}

/// Returns σ² (JᵀJ)⁻¹, the covariance of the parameters to first order for residuals of the variance σ².
///
/// Columns are scaled to the same length, so that parameters of different sizes do not make the matrix singular; what the residuals do not
/// determine has no part in it.
pub fn covariance(slopes: &DMatrix<f64>, variance: f64) -> Option<DMatrix<f64>> {
    let norms: Vec<f64> = slopes.column_iter().map(|column| column.norm()).collect();
    let (m, n) = slopes.shape();
    let scaled = DMatrix::from_fn(m, n, |i, j| slopes[(i, j)] / norms[j].max(f64::MIN_POSITIVE));
    let inverse = (scaled.transpose() * scaled).pseudo_inverse(1e-14).ok()?;
    Some(DMatrix::from_fn(n, n, |i, j| inverse[(i, j)] * variance / norms[i] / norms[j]))
}

/// Confidence level of intervals that nobody asks for at another one: that of two standard uncertainties.
pub const CONFIDENCE: f64 = 0.95;

/// Returns the quantile of the two-sided interval of a confidence level, such as 0.95: that of Student's distribution if the error is
/// the scatter of a fit with these degrees of freedom, else that of the normal distribution.
pub fn quantile(confidence: f64, freedom: Option<f64>) -> f64 {
    let upper = 0.5 * (1.0 + confidence);
    match freedom.and_then(|freedom| StudentsT::new(0.0, 1.0, freedom).ok()) {
        Some(student) => student.inverse_cdf(upper),
        None => Normal::standard().inverse_cdf(upper),
    }
}
