//! Changes of the results of a fit by the uncertain inputs of its case: sizes, thickness and moduli, `"5.0 ± 0.1 mm"`.
//!
//! The data are fitted again with each input at the ends of its uncertainty, one at a time ([`Case::change_by`]). Changes of independent
//! inputs, and the error that the data leave, are added as squares. An input that the data replace, such as the
//! approach speed, has no part.

use fem_case::{Case, UncertainInput};
use serde_json::{Value, json};

/// Key of the speed, which data replace.
pub const SPEED: &str = ".approach_speed";
/// Keys that closed forms of a single contact do not use.
const UNUSED: [&str; 2] = ["start.", "gravity."];

/// The part of one uncertain input in the errors of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct InputPart {
    /// The input with its uncertainty.
    pub input: UncertainInput,
    /// Changes of the results by that uncertainty, in their order; NaN if there is no fit with it.
    pub changes: Vec<f64>,
}

impl InputPart {
    /// Returns the parts of the uncertain inputs of a case that change a result. `refit` returns the changes of n results from those
    /// of the case to those of another one. Inputs whose keys contain one of `replaced` have no part, nor has an input that is found
    /// itself, since its value in the case changes nothing.
    pub fn of(
        case: &Case,
        n: usize,
        replaced: &[&str],
        refit: impl Fn(&Case) -> Option<Vec<f64>>,
    ) -> Vec<Self> {
        let is_replaced = |key: &str| replaced.iter().chain(&UNUSED).any(|part| key.contains(part));
        let inputs = case.scene().uncertain_inputs().iter();
        let part = |input: &UncertainInput| {
            let changes = case.change_by(input, &refit).unwrap_or_else(|| vec![f64::NAN; n]);
            Self { input: input.clone(), changes }
        };
        let parts = inputs.filter(|input| !is_replaced(&input.key)).map(part);
        parts.filter(|part: &Self| part.changes.iter().any(|change| *change != 0.0)).collect()
    }

    /// Returns the standard error of a result by all inputs.
    pub fn sum(parts: &[Self], result: usize) -> f64 {
        parts.iter().map(|part| part.changes[result].powi(2)).sum::<f64>().sqrt()
    }

    /// Returns the stored form, with names of the results and factors to SI.
    pub fn numbers(&self, results: &[(&str, f64)]) -> Value {
        let change = |((name, scale), change): (&(&str, f64), &f64)| {
            (name.to_string(), json!(scale * change))
        };
        let UncertainInput { key, value, uncertainty } = &self.input;
        let changes: serde_json::Map<_, _> =
            results.iter().zip(&self.changes).map(change).collect();
        json!({ "key": key, "value": value, "uncertainty": uncertainty, "changes": changes })
    }
}
