//! The single Maxwell term of weight 1 that makes the mean of measured restitutions.

use std::cell::RefCell;

use fem_data::estimate::{FitError, Robustness};
use fem_laws::bisection::falling_zero;
use fem_material::PronyTerm;

/// Beginning and end of the search over the shortest and the longest contact time: from a nearly complete loss to one
/// that is too small to be measured.
const SEARCH: (f64, f64) = (0.2, 1e4);
/// Largest number of further steps to shorter relaxation times if the loss there is still too small; softer bodies have
/// deeper contacts, which the model may reject.
const STEP_DOWN: f64 = 4.0;
const MAX_STEPS_DOWN: usize = 4;
/// Means of e that differ by less are the same.
const SAME: f64 = 1e-6;

/// A single Maxwell term of weight 1 whose restitutions have the mean of the measured ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maxwell {
    /// The relaxation time of the term, s.
    pub time: f64,
    /// The side on which the time lies if it is only an end of the search.
    pub beyond: Option<Beyond>,
    /// Root mean square error of e.
    pub rms: f64,
}

/// The side of the searched range on which the relaxation time would lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The loss is larger than that of the fastest term that can be computed.
    Faster,
    /// The loss is too small to be measured.
    Slower,
}

impl Beyond {
    /// Returns its name in texts and files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Faster => "faster",
            Self::Slower => "slower",
        }
    }
}

/// A function from terms to the restitutions of all points.
type OfTerms<'a> = dyn Fn(&[PronyTerm]) -> Result<Vec<f64>, FitError> + 'a;

impl Maxwell {
    /// Searches from a fifth of the shortest contact time, and below as far as the model can be computed, to ten
    /// thousand times the longest, s. Means are those with the weights of a robust fit.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn of_mean(
        restitutions: &OfTerms<'_>,
        wanted: &[f64],
        robustness: Option<&Robustness>,
        contacts: (f64, f64),
    ) -> Result<Self, FitError> {
        let weights = robustness.map_or(vec![1.0; wanted.len()], |found| found.weights.clone());
        let mean = |values: &[f64]| {
            let sum: f64 = values.iter().zip(&weights).map(|(value, weight)| value * weight).sum();
            sum / weights.iter().sum::<f64>()
        };
        let differences = |time: f64| -> Result<Vec<f64>, FitError> {
            let found = restitutions(&[term(time)])?;
            Ok(wanted.iter().zip(found).map(|(wanted, e)| wanted - e).collect())
        };
        let lack = |time: f64| -> Result<f64, FitError> {
            let mean = mean(&differences(time)?);
            // A difference of exactly 0 ends the search.
            Ok(if mean.abs() < SAME { 0.0 } else { mean })
        };
        let (mut first, last) = (SEARCH.0 * contacts.0, SEARCH.1 * contacts.1);
        let mut of_first = lack(first)?;
        for _ in 0..MAX_STEPS_DOWN {
            if of_first > 0.0 {
                break;
            }
            let Ok(below) = lack(first / STEP_DOWN) else { break };
            (first, of_first) = (first / STEP_DOWN, below);
        }
        let failure = RefCell::new(None);
        let (time, beyond) = if of_first <= 0.0 {
            (first, Some(Beyond::Faster))
        } else if lack(last)? >= 0.0 {
            (last, Some(Beyond::Slower))
        } else {
            let of_logarithm = |time: f64| {
                lack(time.exp()).unwrap_or_else(|error| {
                    *failure.borrow_mut() = Some(error);
                    0.0
                })
            };
            (falling_zero(first.ln(), last.ln(), of_logarithm).exp(), None)
        };
        if let Some(error) = failure.into_inner() {
            return Err(error);
        }
        let squares = differences(time)?.iter().map(|one| one * one).collect::<Vec<f64>>();
        Ok(Self { time, beyond, rms: mean(&squares).sqrt() })
    }

    /// Returns the Prony term of weight 1.
    pub fn term(&self) -> PronyTerm {
        term(self.time)
    }
}

fn term(relaxation_time: f64) -> PronyTerm {
    PronyTerm { weight: 1.0, relaxation_time }
}
