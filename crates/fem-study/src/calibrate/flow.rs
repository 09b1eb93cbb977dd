//! Plastic flow as another cause of measured restitutions: the yield strength that explains them without a relaxation.

use fem_case::Case;
use fem_laws::{HertzImpact, LawFamily};

use super::fault::CalibrationFault;
use crate::laws::ChosenLaw;
use fem_data::estimate::FitError;
use fem_data::estimate::minimise;
use fem_data::estimate::spectrum::MODEL_ERROR;
use fem_data::estimate::{Fitted, reweight};
use fem_data::estimate::{Model, Point};
use fem_data::table::MeasuredPairs;

/// Yield strengths that are tried first, over the largest pressure of Hertz' contacts: half decades.
const FIRST_TRIED: std::ops::RangeInclusive<i32> = -8..=0;
/// Fewest data that show how the restitution depends on speed.
const FEWEST: usize = 3;

/// The mean-pressure law with one yield strength for all pairs, fitted to the restitutions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowFit {
    /// Yield strength of the bodies, Pa.
    pub yield_strength: f64,
    /// √(Σ (e − e_i)²/N).
    pub rms: f64,
    /// √(Σ (e − e_i)²/u_i²/(N − 1)) with the uncertainties u_i, if all have one.
    pub misfit: Option<f64>,
}

/// A pair under the law, with the values of its parameters.
struct FlowingPair {
    model: Model,
    values: Vec<f64>,
    points: Vec<Point>,
}

impl FlowFit {
    /// Fits the strength; `None` if there are fewer than three data, or no strength changes them.
    ///
    /// # Errors
    /// The case with the sizes of the data is invalid, or a fit does not converge.
    pub fn of(
        case: &Case,
        measured: &MeasuredPairs,
        is_robust: bool,
    ) -> Result<Option<Self>, CalibrationFault> {
        if measured.data.points.len() < FEWEST {
            return Ok(None);
        }
        let family = LawFamily::MeanPressure;
        let Some(strength) = family.loss_parameter() else { return Ok(None) };
        let (mut pairs, mut largest) = (Vec::new(), 0.0f64);
        for pair in &measured.pairs {
            let case = case.edited(|file| pair.resize(file))?;
            // A law that cannot be made of a pair explains nothing.
            let Ok(law) = ChosenLaw::of(&case, family, &[], None) else { return Ok(None) };
            let points: Vec<Point> =
                pair.points.iter().map(|point| measured.data.points[*point]).collect();
            let fastest = points.iter().map(|point| point.speed).fold(0.0, f64::max);
            let hertz = HertzImpact::new(law.model().pair(), fastest)?;
            largest = largest.max(hertz.peak_pressure());
            let guesses: Vec<f64> =
                family.parameters().iter().map(|one| one.guess(fastest)).collect();
            let values = law.values(&guesses);
            pairs.push(FlowingPair { model: law.model().clone(), values, points });
        }
        let errors = |theta: &[f64]| {
            let mut errors = Vec::new();
            for FlowingPair { model, values, points } in &pairs {
                let mut values = values.clone();
                values[strength] = theta[0].exp();
                for point in points {
                    let found = model.outcome(&values, point.speed).ok()?;
                    errors.push((found.restitution - point.restitution, point));
                }
            }
            Some(errors)
        };
        let is_weighted =
            measured.data.points.iter().all(|point| point.restitution_uncertainty.is_some());
        let scale = |point: &Point| point.restitution_uncertainty.filter(|_| is_weighted);
        let residuals = |theta: &[f64]| -> Option<Vec<f64>> {
            let residual = |(error, point): &(f64, &Point)| error / scale(point).unwrap_or(1.0);
            Some(errors(theta)?.iter().map(residual).collect())
        };
        let sum = |theta: &[f64]| -> f64 {
            residuals(theta).map_or(f64::INFINITY, |all| all.iter().map(|one| one * one).sum())
        };
        let tried = FIRST_TRIED.map(|k| (largest * 10f64.powf(0.5 * f64::from(k))).ln());
        let Some(start) = tried.min_by(|a, b| sum(&[*a]).total_cmp(&sum(&[*b]))) else {
            return Ok(None);
        };
        let bounds = (start - 7.0, start + 7.0);
        let fitted = |start: f64, weights: &[f64]| {
            let weighted = |theta: &[f64]| {
                let both = residuals(theta)?.into_iter().zip(weights);
                Some(both.map(|(residual, weight)| residual * weight.sqrt()).collect())
            };
            let (theta, _) = minimise(&weighted, &[start], &[bounds])?;
            let residuals = residuals(&theta).unwrap_or_default();
            Ok(Fitted { found: theta[0], residuals, n_free: 1 })
        };
        let ones = vec![1.0; measured.data.points.len()];
        let least_scale = if is_weighted { 1.0 } else { MODEL_ERROR };
        let found = fitted(start, &ones).and_then(|first| match is_robust {
            true => reweight(first, least_scale, |theta, weights| fitted(*theta, weights))
                .map(|(theta, robustness)| (theta, robustness.weights)),
            false => Ok((first.found, ones)),
        });
        let (theta, weights) = match found {
            Ok(found) => found,
            Err(FitError::NotConverged { .. }) => return Ok(None),
            Err(error) => return Err(error.into()),
        };
        let Some(all) = errors(&[theta]) else { return Ok(None) };
        let sum = |of: &dyn Fn(&(f64, &Point)) -> f64| -> f64 {
            all.iter().zip(&weights).map(|(one, weight)| weight * of(one)).sum()
        };
        let n: f64 = weights.iter().sum();
        let rms = (sum(&|(error, _)| error * error) / n).sqrt();
        let squares = sum(&|(error, point)| (error / scale(point).unwrap_or(1.0)).powi(2));
        let misfit = is_weighted.then(|| (squares / (n - 1.0).max(1.0)).sqrt());
        Ok(Some(Self { yield_strength: theta.exp(), rms, misfit }))
    }

    /// Whether flow explains data within their uncertainties, or else within an rms error.
    pub(super) fn explains(&self, largest_misfit: f64, largest_rms: f64) -> bool {
        self.misfit.map_or(self.rms <= largest_rms, |misfit| misfit <= largest_misfit)
    }
}
