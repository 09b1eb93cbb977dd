//! Gauss–Newton with line search over the weights, and the statistics at the minimum.

use std::cell::Cell;

use nalgebra::{DMatrix, DVector};

use super::bounded::Linear;
use super::parts::{Evidence, Parts};
use super::ranges::RangeSearch;
use super::resolution::Resolution;
use super::{MODEL_ERROR, PureError, SpectrumFit, SpectrumProblem, n_distinct};
use crate::estimate::error::FitError;
use crate::estimate::least_squares::quantile;
use crate::estimate::robust::{Fitted, Robustness, reweight};

/// Step of the differences: weights are of order 1, and collisions are smooth to 1e-7.
const STEP: f64 = 1e-3;
/// The search ends when weights change by less.
const STANDS: f64 = 1e-6;
const MAX_STEPS: usize = 40;
const MAX_HALVINGS: usize = 8;

impl SpectrumProblem<'_> {
    /// Returns the best weights and their intervals at this level of confidence (such as 0.95).
    ///
    /// # Errors
    /// There are fewer data than weights without regularisation, the level is outside (0, 1), λ is negative or not
    /// finite, or a collision cannot be computed.
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
        if n_values < n_free && self.regularisation == 0.0 && self.prior.is_none() {
            let free = "the weights of the series".to_string();
            return Err(FitError::TooFewData { n_values, n_free, free });
        }
        Solver::new(self).fit(confidence)
    }

    /// Returns the best weights near those of a fit, with its weights of the data.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn refit(&self, fit: &SpectrumFit) -> Result<Vec<f64>, FitError> {
        let mut solver = Solver::new(self);
        if let Some(robustness) = &fit.robustness {
            solver.data_weights.clone_from(&robustness.weights);
        }
        let weights = fit.weights.clone();
        let start = State { restitutions: solver.evaluate(&weights)?, weights };
        Ok(solver.minimise(start)?.0.weights)
    }
}

struct Solver<'a> {
    problem: &'a SpectrumProblem<'a>,
    /// Weights of the data.
    data_weights: Vec<f64>,
    n_evaluations: Cell<usize>,
}

/// Weights and their restitutions.
#[derive(Clone)]
struct State {
    weights: Vec<f64>,
    restitutions: Vec<f64>,
}

impl<'a> Solver<'a> {
    fn new(problem: &'a SpectrumProblem<'a>) -> Self {
        Self {
            problem,
            data_weights: vec![1.0; problem.measured.len()],
            n_evaluations: Cell::new(0),
        }
    }

    fn fit(mut self, confidence: f64) -> Result<SpectrumFit, FitError> {
        let problem = self.problem;
        let start = || vec![0.0; problem.times.len()];
        let start = problem.prior.map_or_else(start, |prior| prior.weights.clone());
        let start = State { restitutions: self.evaluate(&start)?, weights: start };
        let (mut state, mut jacobian) = self.minimise(start)?;
        let least_scale =
            if problem.uncertainties.is_some() { problem.unit() } else { MODEL_ERROR };
        let mut robustness = None;
        if problem.is_robust {
            let (found, counted) = self.reweighted((state, jacobian), least_scale)?;
            ((state, jacobian), robustness) = (found, Some(counted));
        }
        let linear = self.of_data(&state, &jacobian);
        let parts = self.parts(&state, &jacobian)?;
        let sum = self.misfit(&state.restitutions);
        let (n_values, n_collisions) = (problem.measured.len(), n_distinct(problem.collisions));
        let n_free = match &parts {
            Some(parts) => (parts.n_of_data.round() as usize).min(n_collisions),
            None => self.n_free(&state),
        };
        let freedom = n_values - n_free;
        let pure_error = PureError::of(problem.measured, problem.collisions);
        let unit = problem.unit();
        let scatter = (sum / freedom.max(1) as f64).sqrt();
        let is_weighted = problem.uncertainties.is_some();
        let error = match &robustness {
            Some(robustness) => robustness.variance(n_free, least_scale).sqrt(),
            None if is_weighted => unit,
            None => scatter.max(MODEL_ERROR),
        };
        let is_scatter = robustness.is_some() || !is_weighted;
        let quantile = quantile(confidence, is_scatter.then_some(freedom.max(1) as f64));
        let search = RangeSearch {
            restitutions: &|weights| self.evaluate(weights),
            linear: &|weights, restitutions| {
                let at = State { weights: weights.to_vec(), restitutions: restitutions.to_vec() };
                self.linear(&at, &jacobian)
            },
            best: &state.weights,
            best_misfit: sum + self.of_prior(&state.weights),
            rise: (error * quantile).powi(2),
        };
        let (weight_ranges, moments) = search.all(problem.times)?;
        let squares = state.restitutions.iter().zip(problem.measured).map(|(e, m)| (e - m).powi(2));
        let mut resolution =
            Resolution::of(&linear.a, error, problem.regularisation, &state.weights);
        if let Some(parts) = &parts {
            resolution.shares.clone_from(&parts.shares);
        }
        let squares: f64 = squares.zip(&self.data_weights).map(|(square, w)| square * w).sum();
        Ok(SpectrumFit {
            rms: (squares / self.data_weights.iter().sum::<f64>()).sqrt(),
            resolution,
            parts,
            misfit: match (is_weighted, &robustness) {
                (true, Some(robustness)) => Some(robustness.scale / unit),
                (true, None) => Some(scatter / unit),
                (false, Some(_)) => None,
                (false, None) => {
                    pure_error.and_then(|pure| pure.misfit(sum, n_collisions - n_free))
                }
            },
            pure_error,
            weights: state.weights,
            restitutions: state.restitutions,
            error,
            degrees_of_freedom: freedom,
            quantile,
            weight_ranges,
            moments,
            n_evaluations: self.n_evaluations.get(),
            robustness,
        })
    }

    /// Returns the number of weights that the data determine. Repeats determine no more than one measurement does: the rest
    /// is scatter.
    fn n_free(&self, state: &State) -> usize {
        let n_free = state.weights.iter().filter(|weight| **weight > STANDS).count();
        n_free.min(n_distinct(self.problem.collisions))
    }

    /// Returns a minimum with data that are weighted by their residuals, and what weighs them.
    fn reweighted(
        &mut self,
        found: (State, DMatrix<f64>),
        least_scale: f64,
    ) -> Result<((State, DMatrix<f64>), Robustness), FitError> {
        let first = self.fitted(found);
        let next = |(last, _): &(State, _), weights: &[f64]| {
            self.data_weights = weights.to_vec();
            Ok(self.fitted(self.minimise(last.clone())?))
        };
        reweight(first, least_scale, next)
    }

    /// Returns a minimum with its residuals, without the weights of the data.
    fn fitted(&self, found: (State, DMatrix<f64>)) -> Fitted<(State, DMatrix<f64>)> {
        let both = found.0.restitutions.iter().zip(self.problem.measured).enumerate();
        let residuals = both.map(|(i, (e, m))| (e - m) / self.problem.ratio(i)).collect();
        Fitted { residuals, n_free: self.n_free(&found.0), found }
    }

    /// Returns the ratio ρ_i over the root of the weight of a datum.
    fn ratio(&self, i: usize) -> f64 {
        self.problem.ratio(i) / self.data_weights[i].sqrt()
    }

    fn evaluate(&self, weights: &[f64]) -> Result<Vec<f64>, FitError> {
        self.n_evaluations.set(self.n_evaluations.get() + 1);
        (self.problem.restitutions)(weights)
    }

    /// Returns Σ ((e − ê)/ρ)².
    fn misfit(&self, restitutions: &[f64]) -> f64 {
        let measured = self.problem.measured.iter().zip(restitutions).enumerate();
        measured.map(|(i, (m, e))| ((e - m) / self.ratio(i)).powi(2)).sum()
    }

    /// Searches the minimum from a start; returns its state and ∂e_i/∂w_k there.
    fn minimise(&self, start: State) -> Result<(State, DMatrix<f64>), FitError> {
        let ridge = self.problem.regularisation;
        let cost = |state: &State| {
            let size: f64 = state.weights.iter().map(|weight| weight * weight).sum();
            let of_prior = self.of_prior(&state.weights);
            self.misfit(&state.restitutions) + of_prior + ridge * ridge * size
        };
        let mut state = start;
        for _ in 0..MAX_STEPS {
            let jacobian = self.jacobian(&state)?;
            let target = self.linear(&state, &jacobian).solve(ridge, None);
            let mut share = 1.0;
            let mut better = None;
            for _ in 0..MAX_HALVINGS {
                let toward = |(from, to): (&f64, &f64)| from + share * (to - from);
                let weights: Vec<f64> = state.weights.iter().zip(&target).map(toward).collect();
                let tried = State { restitutions: self.evaluate(&weights)?, weights };
                if cost(&tried) < cost(&state) {
                    better = Some(tried);
                    break;
                }
                share *= 0.5;
            }
            let Some(better) = better else { return Ok((state, jacobian)) };
            let moves = better.weights.iter().zip(&state.weights).map(|(a, b)| (a - b).abs());
            let moves = moves.fold(0.0, f64::max);
            let gain = cost(&state) - cost(&better);
            state = better;
            if moves < STANDS || gain < 1e-10 * cost(&state) + 1e-16 {
                let jacobian = self.jacobian(&state)?;
                return Ok((state, jacobian));
            }
        }
        let reason = format!("the weights still move after {MAX_STEPS} steps");
        Err(FitError::NotConverged { reason })
    }

    /// Returns ∂e_i/∂w_k by differences that keep Σ w ≤ 1: if the sum leaves no room, a weight grows at
    /// the cost of the largest.
    fn jacobian(&self, state: &State) -> Result<DMatrix<f64>, FitError> {
        let weights = &state.weights;
        let difference = |other: Vec<f64>, step: f64| {
            let difference = other.iter().zip(&state.restitutions).map(|(b, a)| (b - a) / step);
            DVector::from_iterator(state.restitutions.len(), difference)
        };
        let moved = |k: usize, step: f64, from: Option<usize>| {
            let mut moved = weights.clone();
            moved[k] += step;
            if let Some(from) = from {
                moved[from] -= step;
            }
            self.evaluate(&moved)
        };
        let is_full = weights.iter().sum::<f64>() + STEP > 1.0;
        let largest = (0..weights.len()).max_by(|i, j| weights[*i].total_cmp(&weights[*j]));
        let giver = largest.filter(|_| is_full);
        let less = giver.map(|k| Ok::<_, FitError>(difference(moved(k, -STEP, None)?, -STEP)));
        let less = less.transpose()?;
        let mut columns = Vec::new();
        for k in 0..weights.len() {
            columns.push(match (&less, giver) {
                (Some(less), Some(giver)) if giver == k => less.clone(),
                (Some(less), Some(giver)) => difference(moved(k, STEP, Some(giver))?, STEP) + less,
                _ => difference(moved(k, STEP, None)?, STEP),
            });
        }
        Ok(DMatrix::from_columns(&columns))
    }

    /// Returns Σ r² of the prior, with residuals in the unit of the data's.
    fn of_prior(&self, weights: &[f64]) -> f64 {
        let unit = self.problem.unit();
        self.problem.prior.map_or(0.0, |prior| unit * unit * prior.rows.misfit(weights))
    }

    /// Returns what the prior and the data contribute.
    fn parts(&self, at: &State, jacobian: &DMatrix<f64>) -> Result<Option<Parts>, FitError> {
        let both = self.problem.prior.zip(self.problem.uncertainties);
        let Some((prior, uncertainties)) = both else { return Ok(None) };
        Ok(Parts::of(Evidence {
            jacobian,
            prior: &prior.rows.a,
            prior_weights: &prior.weights,
            uncertainties,
            measured: self.problem.measured,
            best: &at.restitutions,
            of_prior: self.evaluate(&prior.weights)?,
        }))
    }

    /// Returns e(w) + J (w' − w) and the prior as residuals in w'.
    fn linear(&self, at: &State, jacobian: &DMatrix<f64>) -> Linear {
        let of_data = self.of_data(at, jacobian);
        let Some(prior) = self.problem.prior else { return of_data };
        let unit = self.problem.unit();
        let (n_values, n_rows) = (of_data.a.nrows(), prior.rows.a.nrows());
        let mut all = Linear {
            a: of_data.a.resize_vertically(n_values + n_rows, 0.0),
            b: of_data.b.resize_vertically(n_values + n_rows, 0.0),
        };
        all.a.rows_mut(n_values, n_rows).copy_from(&(&prior.rows.a * unit));
        all.b.rows_mut(n_values, n_rows).copy_from(&(&prior.rows.b * unit));
        all
    }

    /// Returns e(w) + J (w' − w) as residuals in w'.
    fn of_data(&self, at: &State, jacobian: &DMatrix<f64>) -> Linear {
        let own = jacobian * DVector::from_row_slice(&at.weights);
        let n_values = self.problem.measured.len();
        let ratio = |i: usize| self.ratio(i);
        let wanted = |i: usize| (self.problem.measured[i] - at.restitutions[i] + own[i]) / ratio(i);
        Linear {
            a: DMatrix::from_fn(n_values, jacobian.ncols(), |i, k| jacobian[(i, k)] / ratio(i)),
            b: DVector::from_fn(n_values, |i, _| wanted(i)),
        }
    }
}
