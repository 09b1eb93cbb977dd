//! The least error at each value of one parameter with the others refitted, which shows how flat an optimum is.
//!
//! The interval of a profile is where Σ r² stays below Σ r²_min + s² t², the level at which the first-order
//! interval of a linear model ends (Bates & Watts, *Nonlinear Regression Analysis*, ch. 6). It assumes
//! independent residuals, but no linearity.

use fem_laws::bisection::falling_zero;

use crate::estimate::Fit;
use crate::estimate::Robustness;
use crate::estimate::error::FitError;
use crate::estimate::problem::{Free, Problem};

/// A profile over one parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Index of the parameter.
    pub index: usize,
    /// The fits in the order of the grid.
    pub points: Vec<ProfilePoint>,
    /// Interval of the fit's confidence level; an end is `None` if it lies beyond the bound of the parameter. `None` as a
    /// whole without degrees of freedom.
    pub interval: Option<(Option<f64>, Option<f64>)>,
}

/// The best fit with one parameter held.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfilePoint {
    /// Value of the parameter that is held, SI.
    pub value: f64,
    /// Root mean square of the residuals, √(Σ r²/N).
    pub rms: f64,
    /// Values of all parameters, SI.
    pub values: Vec<f64>,
}

impl Problem<'_> {
    /// Returns the profile of a free parameter over a grid, and its interval at the level of `fit`.
    ///
    /// # Errors
    /// At some value the others cannot be fitted.
    pub fn profile(&self, fit: &Fit, free: &Free, grid: &[f64]) -> Result<Profile, FitError> {
        let n_values = fit.robustness.as_ref().map_or(1.0, Robustness::mean_weight)
            * fit.residuals.len() as f64;
        let mut weighted = self.clone();
        weighted.weights = fit.robustness.as_ref().map(|robustness| robustness.weights.clone());
        let mut points = Vec::with_capacity(grid.len());
        let mut start = fit.values.clone();
        for &value in grid {
            let (values, sum) = weighted.holding(free.index, value, &start).solve()?;
            start.clone_from(&values);
            points.push(ProfilePoint { value, rms: (sum / n_values).sqrt(), values });
        }
        let interval = fit.allowed_rise.map(|rise| {
            let level = fit.sum_of_squares + rise;
            let below = |value: f64| {
                let solved = weighted.holding(free.index, value, &fit.values).solve();
                level - solved.map_or(f64::INFINITY, |(_, sum)| sum)
            };
            let error = fit.estimates.iter().find(|estimate| estimate.index == free.index);
            let error = error.and_then(|estimate| estimate.standard_error).unwrap_or(0.0);
            let best = fit.values[free.index];
            let end = |bound: f64| find_end(best, bound, error, below);
            (end(free.bounds.0), end(free.bounds.1))
        });
        Ok(Profile { index: free.index, points, interval })
    }
}

/// Returns the value at which `below` becomes negative on the way from `best` to `bound`, if it does.
fn find_end(best: f64, bound: f64, error: f64, below: impl Fn(f64) -> f64) -> Option<f64> {
    let whole = bound - best;
    if whole == 0.0 || !whole.is_finite() {
        return None;
    }
    let mut inside = 0.0;
    let mut share = (error / whole.abs()).clamp(1e-6, 1.0);
    loop {
        if below(best + share * whole) <= 0.0 {
            let value = |share: f64| below(best + share * whole).max(-1e30);
            // A tenth of a per cent of the way is accurate enough for an interval.
            return Some(best + whole * coarse_zero(inside, share, value));
        }
        if share >= 1.0 {
            return None;
        }
        inside = share;
        share = (1.6 * share).min(1.0);
    }
}

fn coarse_zero(low: f64, high: f64, value: impl Fn(f64) -> f64) -> f64 {
    // The noise of the refits ends the search long before rounding would.
    let steps = std::cell::Cell::new(0);
    falling_zero(low, high, |share| {
        steps.set(steps.get() + 1);
        if steps.get() > 14 { 0.0 } else { value(share) }
    })
}
