//! The minimum of a sum of squares inside bounds.
//!
//! It is found by the Levenberg–Marquardt method of MINPACK with bounds (Moré 1978; Markwardt 2009, crate
//! `rmpfit`, a port of CMPFIT), with central differences as derivatives.

use nalgebra::DMatrix;
use rmpfit::{MPError, MPFitter, MPPar, MPResult, MPSide};

use crate::estimate::error::FitError;

/// Step of the differences: parameters are logarithms or numbers of order 1.
const STEP: f64 = 1e-4;

/// Residuals as a function of the parameters; `None` if they cannot be computed.
pub type Residuals<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + 'a;

struct Fitter<'a> {
    residuals: &'a Residuals<'a>,
    n_residuals: usize,
    parameters: Vec<MPPar>,
}

impl MPFitter for Fitter<'_> {
    fn eval(&mut self, parameters: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        // Central differences reach beyond a bound, where the law may have no meaning.
        let inside = parameters.iter().zip(&self.parameters);
        let inside: Vec<f64> =
            inside.map(|(value, bounds)| value.clamp(bounds.limit_low, bounds.limit_up)).collect();
        let residuals = (self.residuals)(&inside).ok_or(MPError::Eval)?;
        deviates.copy_from_slice(&residuals);
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.n_residuals
    }

    fn parameters(&self) -> &[MPPar] {
        &self.parameters
    }
}

/// Returns the parameters of the minimum nearest to `start` within the `bounds` of each parameter, and the sum of
/// squares there. There may be fewer residuals than parameters.
pub fn minimise(
    residuals: &Residuals<'_>,
    start: &[f64],
    bounds: &[(f64, f64)],
) -> Result<(Vec<f64>, f64), FitError> {
    let failed = |reason: String| FitError::NotConverged { reason };
    let n_residuals = residuals(start)
        .ok_or_else(|| failed("the law cannot be computed at the start".into()))?
        .len();
    let parameter = |bounds: &(f64, f64)| MPPar {
        limited_low: bounds.0.is_finite(),
        limited_up: bounds.1.is_finite(),
        limit_low: bounds.0,
        limit_up: bounds.1,
        step: STEP,
        side: MPSide::Both,
        ..MPPar::new()
    };
    let parameters = bounds.iter().map(parameter).collect();
    let mut fitter = Fitter { residuals, n_residuals, parameters };
    let mut found = start.to_vec();
    for ((value, bounds), start) in found.iter_mut().zip(bounds).zip(start) {
        *value = start.clamp(bounds.0, bounds.1);
    }
    let status = fitter.mpfit(&mut found).map_err(|error| failed(error.to_string()))?;
    Ok((found, status.best_norm))
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
        columns.push(nalgebra::DVector::from_iterator(first.len(), difference));
    }
    Some(DMatrix::from_columns(&columns))
}
