//! Range of a combination of weights with all others free.
//!
//! At an end of the range of c·w the least Σ r² over all admissible weights with this c·w has risen by
//! (tσ)² (a profile: Bates & Watts, *Nonlinear Regression Analysis*, ch. 6), or the weights reach their limits
//! w ≥ 0, Σ w ≤ 1. The collision is linearised about the best weights first and then, by chords, about
//! the end that was found. The ridge is left out, because it is no information from the data.

use super::bounded::Linear;
use crate::estimate::error::FitError;

/// Number of corrections of an end by a collision that is computed there.
const CHORDS: usize = 4;
/// Number of bisections on the way to an end.
const HALVINGS: usize = 26;

/// The range of a combination of weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The value at the best weights.
    pub value: f64,
    /// The smallest value that the data allow.
    pub low: f64,
    /// The largest value that the data allow.
    pub high: f64,
}

/// Returns the coefficients of Σ w, Σ w/τ (1/s) and Σ w τ (s).
pub fn moments(times: &[f64]) -> [Vec<f64>; 3] {
    let of = |moment: fn(f64) -> f64| times.iter().map(|time| moment(*time)).collect();
    [of(|_| 1.0), of(f64::recip), of(|time| time)]
}

impl Range {
    /// Returns this range with an error by other causes than the data added as squares, inside the limits of the value.
    pub fn widened(&self, error: f64, (least, most): (f64, f64)) -> Self {
        let reach = |end: f64| (end - self.value).hypot(error);
        let low = (self.value - reach(self.low)).max(least.min(self.low));
        let high = (self.value + reach(self.high)).min(most.max(self.high));
        Self { low, high, ..*self }
    }
}

type Evaluate<'a> = dyn Fn(&[f64]) -> Result<Vec<f64>, FitError> + 'a;
type Linearise<'a> = dyn Fn(&[f64], &[f64]) -> Linear + 'a;

/// Searches the ends of ranges.
pub(super) struct RangeSearch<'a> {
    /// A function from weights to restitutions.
    pub restitutions: &'a Evaluate<'a>,
    /// A function from weights and restitutions to the problem that is linearised about them.
    pub linear: &'a Linearise<'a>,
    /// The best weights.
    pub best: &'a [f64],
    /// Σ r² at the best weights.
    pub best_misfit: f64,
    /// Allowed rise of Σ r².
    pub rise: f64,
}

impl RangeSearch<'_> {
    /// Returns the ranges of all weights and of their moments, for these relaxation times, s.
    pub fn all(&self, times: &[f64]) -> Result<(Vec<Range>, [Range; 3]), FitError> {
        let n = times.len();
        let single = |k: usize| (0..n).map(|j| f64::from(u8::from(j == k))).collect::<Vec<f64>>();
        let weights = (0..n).map(|k| self.range(&single(k))).collect::<Result<_, _>>()?;
        let [total, rate, time] = moments(times);
        Ok((weights, [self.range(&total)?, self.range(&rate)?, self.range(&time)?]))
    }

    /// Returns the range of c·w.
    pub fn range(&self, combination: &[f64]) -> Result<Range, FitError> {
        let value = dot(combination, self.best);
        let least = combination.iter().copied().fold(0.0, f64::min);
        let most = combination.iter().copied().fold(0.0, f64::max);
        let low = self.end(combination, value, least)?;
        let high = self.end(combination, value, most)?;
        Ok(Range { value, low: low.min(value), high: high.max(value) })
    }

    /// Returns the end on the way from the best value to `limit`.
    fn end(&self, combination: &[f64], value: f64, limit: f64) -> Result<f64, FitError> {
        let mut at = self.best.to_vec();
        let mut end = value;
        for _ in 0..=CHORDS {
            let linear = (self.linear)(&at, &(self.restitutions)(&at)?);
            let small = linear.compressed();
            let reachable = linear.misfit(&linear.solve(0.0, None));
            // Because of the ridge the best weights may not have the least misfit; they are admissible.
            let level = self.best_misfit.max(reachable + self.rise);
            let offset = reachable - small.misfit(&small.solve(0.0, None));
            let weights = |share: f64| {
                let held = value + share * (limit - value);
                small.solve(0.0, Some((combination, held)))
            };
            let allows = |share: f64| small.misfit(&weights(share)) + offset <= level;
            let (mut inside, mut outside) = (0.0, 1.0);
            if allows(outside) {
                inside = outside;
            } else {
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (inside + outside);
                    *(if allows(middle) { &mut inside } else { &mut outside }) = middle;
                }
            }
            at = weights(inside);
            let found = value + inside * (limit - value);
            if (found - end).abs() <= 1e-3 * (found - value).abs() {
                return Ok(found);
            }
            end = found;
        }
        Ok(end)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
