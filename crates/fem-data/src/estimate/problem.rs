//! A least-squares problem: data, the free parameters of a law, and the residuals between them.

use fem_laws::{LawParameter, ParameterRole};

use crate::estimate::Fit;
use crate::estimate::error::FitError;
use crate::estimate::least_squares::minimise;
use crate::estimate::model::Model;
use crate::table::Point;

/// A free parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// Its index among the law's parameters.
    pub index: usize,
    /// Starting value; searched for if it is `None`.
    pub start: Option<f64>,
    /// Smallest and largest value allowed.
    pub bounds: (f64, f64),
}

/// Data, a law and its free parameters.
///
/// A residual is e(v) − e_i, over its uncertainty if the data have any; a contact time's is
/// T(v)/T_i − 1, which weighs as much as an equal difference of e.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// The bodies and the law.
    pub model: &'a Model,
    /// The measured points.
    pub points: &'a [Point],
    /// Values of all parameters; those of the free ones are only guesses.
    pub values: Vec<f64>,
    /// The free parameters.
    pub free: Vec<Free>,
    /// Whether data far from the curve count little ([`crate::estimate::Robustness`]).
    pub is_robust: bool,
    /// Weights of the residuals.
    pub(crate) weights: Option<Vec<f64>>,
}

/// Factor by which a logarithmic parameter may differ from its natural size.
const MAX_FACTOR_FROM_NATURAL_SIZE: f64 = 1e8;
/// Relative difference below which neighbouring sums of squares are those of a plateau.
const PLATEAU: f64 = 1e-6;

impl<'a> Problem<'a> {
    /// Creates the problem with these parameters free and all others at their defaults.
    ///
    /// # Errors
    /// The law does not have a key, or a speed has no Hertz impact.
    pub fn new(model: &'a Model, points: &'a [Point], free: &[&str]) -> Result<Self, FitError> {
        let parameters = model.family().parameters();
        let mut problem = Self {
            model,
            points,
            values: Vec::new(),
            free: Vec::new(),
            is_robust: false,
            weights: None,
        };
        let speed = problem.middle_speed();
        problem.values = parameters.iter().map(|parameter| parameter.guess(speed)).collect();
        for (index, parameter) in parameters.iter().enumerate() {
            let size = model.natural_size(parameter, &problem.values, speed)?;
            problem.values[index] = size;
            if free.contains(&parameter.key) {
                let bounds = problem.default_bounds(parameter, size);
                problem.free.push(Free { index, start: None, bounds });
            }
        }
        Ok(problem)
    }

    /// Returns this problem, in which data far from the curve count little if it is robust.
    pub fn robust(self, is_robust: bool) -> Self {
        Self { is_robust, ..self }
    }

    /// Returns the geometric mean of the speeds, m/s.
    pub fn middle_speed(&self) -> f64 {
        let sum: f64 = self.points.iter().map(|point| point.speed.ln()).sum();
        (sum / self.points.len().max(1) as f64).exp()
    }

    /// Returns the parameter of an index.
    pub fn parameter(&self, index: usize) -> &'static LawParameter {
        &self.model.family().parameters()[index]
    }

    /// Whether each restitution has an uncertainty, so that residuals are of order 1.
    pub fn has_uncertainties(&self) -> bool {
        self.points.iter().all(|point| point.restitution_uncertainty.is_some())
    }

    /// Returns the differences of the law from the data; `None` if the law cannot be computed.
    pub fn residuals(&self, values: &[f64]) -> Option<Vec<f64>> {
        let weighted = self.has_uncertainties();
        let mut residuals = Vec::with_capacity(self.points.len());
        for point in self.points {
            let outcome = self.model.outcome(values, point.speed).ok()?;
            let scale = point.restitution_uncertainty.filter(|_| weighted).unwrap_or(1.0);
            residuals.push((outcome.restitution - point.restitution) / scale);
            if let Some(measured) = point.contact_time {
                // A contact without an end has the largest difference.
                let time = outcome.contact_time.map_or(1.0, |time| time / measured - 1.0);
                residuals.push(time / scale);
            }
        }
        residuals.iter().all(|residual| residual.is_finite()).then_some(residuals)
    }

    /// Returns the residuals times the roots of their weights.
    pub(crate) fn weighted_residuals(&self, values: &[f64]) -> Option<Vec<f64>> {
        let mut residuals = self.residuals(values)?;
        for (residual, weight) in residuals.iter_mut().zip(self.weights.iter().flatten()) {
            *residual *= weight.sqrt();
        }
        Some(residuals)
    }

    /// Returns the problem with these weights of the residuals and a start for all parameters.
    pub(crate) fn reweighted(&self, weights: &[f64], start: &[f64]) -> Self {
        let mut reweighted = self.clone();
        reweighted.weights = Some(weights.to_vec());
        for free in &mut reweighted.free {
            free.start = Some(start[free.index]);
        }
        reweighted
    }

    /// Returns this problem with bounds, starts and weights of a fit of the same data, for bodies that differ a little.
    pub fn near(&self, other: &Problem<'_>, fit: &Fit) -> Self {
        let mut near = self.clone();
        near.weights = fit.robustness.as_ref().map(|robustness| robustness.weights.clone());
        for (free, other) in near.free.iter_mut().zip(&other.free) {
            (free.bounds, free.start) = (other.bounds, Some(fit.values[other.index]));
        }
        near
    }

    /// Returns the problem with one free parameter held at a value; the others begin at `start`.
    pub(crate) fn holding(&self, index: usize, value: f64, start: &[f64]) -> Self {
        let mut held = self.clone();
        held.values[index] = value;
        held.free.retain(|free| free.index != index);
        for free in &mut held.free {
            free.start = Some(start[free.index]);
        }
        held
    }

    /// Returns the values of all parameters at a point θ of the free ones.
    pub(crate) fn values_at(&self, theta: &[f64]) -> Vec<f64> {
        let mut values = self.values.clone();
        for (free, theta) in self.free.iter().zip(theta) {
            values[free.index] = if self.is_logarithmic(free) { theta.exp() } else { *theta };
        }
        values
    }

    /// Returns the free parameters, scaled as θ, of values of all parameters.
    pub fn theta_of(&self, values: &[f64]) -> Vec<f64> {
        let theta = |free: &Free| self.theta(free, values[free.index]);
        self.free.iter().map(theta).collect()
    }

    pub(crate) fn bounds(&self) -> Vec<(f64, f64)> {
        let both = |free: &Free| (self.theta(free, free.bounds.0), self.theta(free, free.bounds.1));
        self.free.iter().map(both).collect()
    }

    /// Whether a free parameter is sought by its logarithm.
    pub fn is_logarithmic(&self, free: &Free) -> bool {
        self.parameter(free.index).role != ParameterRole::Number
    }

    /// Returns the values of all parameters at the least sum of squares, and that sum.
    ///
    /// # Errors
    /// The law cannot be computed, or no minimum is found.
    pub fn solve(&self) -> Result<(Vec<f64>, f64), FitError> {
        let residuals = |theta: &[f64]| self.weighted_residuals(&self.values_at(theta));
        if self.free.is_empty() {
            let sum = self.sum_of_squares(&self.values).ok_or_else(|| FitError::NotConverged {
                reason: "the law cannot be computed".into(),
            })?;
            return Ok((self.values.clone(), sum));
        }
        let mut best: Option<(Vec<f64>, f64)> = None;
        let mut last = Ok(());
        for start in self.starts() {
            match minimise(&residuals, &self.theta_of(&start), &self.bounds()) {
                Ok((theta, sum)) if best.as_ref().is_none_or(|best| sum < best.1) => {
                    best = Some((self.values_at(&theta), sum));
                }
                Ok(_) => {}
                Err(error) => last = Err(error),
            }
        }
        match (best, last) {
            (Some(best), _) => Ok(best),
            (None, Err(error)) => Err(error),
            (None, Ok(())) => Err(FitError::NothingFree),
        }
    }

    /// Returns Σ w r²; `None` if the law cannot be computed.
    pub(crate) fn sum_of_squares(&self, values: &[f64]) -> Option<f64> {
        Some(self.weighted_residuals(values)?.iter().map(|residual| residual * residual).sum())
    }

    /// Returns the starting points: the given one, or one for each of some values of the first free plain
    /// number, with the first logarithmic parameter at its best fit.
    fn starts(&self) -> Vec<Vec<f64>> {
        let mut values = self.values.clone();
        for free in &self.free {
            let value = free.start.unwrap_or(values[free.index]);
            values[free.index] = value.clamp(free.bounds.0, free.bounds.1);
        }
        let open = |free: &&Free| free.start.is_none();
        let number = self.free.iter().filter(open).find(|free| !self.is_logarithmic(free));
        let numbers = match number {
            Some(Free { index, bounds: (low, high), .. }) => {
                let spread = [0.2, 0.4].map(|part| low + part * (high - low));
                vec![(*index, values[*index]), (*index, spread[0]), (*index, spread[1])]
            }
            None => vec![(0, values[0])],
        };
        let scanned = self.free.iter().filter(open).find(|free| self.is_logarithmic(free));
        let mut starts = Vec::new();
        for (index, value) in numbers {
            let mut start = values.clone();
            start[index] = value;
            starts.push(match scanned {
                Some(free) => self.scan(free, start),
                None => start,
            });
        }
        starts
    }

    /// Returns the best of some decades of one parameter around its natural size, of those where a neighbour is different:
    /// from a plateau, such as that of strengths that never flow, no fit finds away.
    fn scan(&self, free: &Free, mut values: Vec<f64>) -> Vec<f64> {
        let (parameter, speed) = (self.parameter(free.index), self.middle_speed());
        let size = self.model.natural_size(parameter, &values, speed);
        let size = size.unwrap_or(values[free.index]);
        let mut tried: Vec<(f64, f64)> = Vec::new();
        for half_decades in -10..=2 {
            let value = size * 10f64.powf(0.5 * f64::from(half_decades));
            values[free.index] = value.clamp(free.bounds.0, free.bounds.1);
            let sum = self.sum_of_squares(&values).unwrap_or(f64::INFINITY);
            tried.push((sum, values[free.index]));
        }
        let is_slope = |k: usize| {
            let same = |other: &(f64, f64)| (other.0 - tried[k].0).abs() <= PLATEAU * tried[k].0;
            !tried[k.saturating_sub(1)..(k + 2).min(tried.len())]
                .iter()
                .any(|other| other.1 != tried[k].1 && same(other))
        };
        let slopes = (0..tried.len()).filter(|k| is_slope(*k)).map(|k| tried[k]);
        let least = |best: (f64, f64), next: (f64, f64)| if next.0 < best.0 { next } else { best };
        let best = slopes.reduce(least).filter(|best| best.0.is_finite());
        let best = best.or_else(|| tried.iter().copied().reduce(least));
        values[free.index] = best.map_or(values[free.index], |(_, value)| value);
        values
    }

    fn theta(&self, free: &Free, value: f64) -> f64 {
        if self.is_logarithmic(free) { value.ln() } else { value }
    }

    fn default_bounds(&self, parameter: &LawParameter, size: f64) -> (f64, f64) {
        match parameter.role {
            ParameterRole::Number => parameter.limits,
            // C of ξⁿ spans many decades with n: its natural size at n = 0.5 is far from that at n = 3.
            ParameterRole::Damping => (
                size / MAX_FACTOR_FROM_NATURAL_SIZE.powi(2),
                size * MAX_FACTOR_FROM_NATURAL_SIZE.powi(2),
            ),
            _ => (size / MAX_FACTOR_FROM_NATURAL_SIZE, size * MAX_FACTOR_FROM_NATURAL_SIZE),
        }
    }
}
