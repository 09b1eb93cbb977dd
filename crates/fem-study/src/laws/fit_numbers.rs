//! `fit.json`: a fitted law as numbers.

use crate::fit::{Fit, Model, Profile};
use fem_case::schema::End;
use fem_laws::LawParameter;
use serde::Serialize;

use super::law_fit::LawFit;

/// A fit as it is kept, SI.
#[derive(Clone, Debug, Serialize)]
pub struct FitNumbers {
    /// The case, as the caller calls it.
    pub case: String,
    /// Name of the data.
    pub data: String,
    /// Name of the law.
    pub law: &'static str,
    /// When a contact is over.
    pub end: End,
    /// Number of measured points.
    pub points: usize,
    /// Whether the data have uncertainties.
    pub weighted: bool,
    /// Level of the intervals.
    pub confidence: f64,
    /// Parameters, in the order of the law.
    pub parameters: Vec<ParameterNumbers>,
    /// Correlation of the free parameters.
    pub correlation: Vec<Vec<f64>>,
    /// Root mean square of the residuals, √(Σ r²/N).
    pub rms: f64,
    /// Sum of the squared residuals, Σ r².
    pub sum_of_squares: f64,
    /// Data less free parameters.
    pub degrees_of_freedom: usize,
    /// Condition number of the scaled Jacobian.
    pub condition_number: f64,
    /// The error over one parameter.
    pub profile: Option<ProfileNumbers>,
    /// Other laws on the same data.
    pub compared: Vec<ComparedNumbers>,
    /// Warnings for the reader.
    pub warnings: Vec<String>,
}

/// One parameter of a fitted law.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterNumbers {
    /// As a case file has it.
    pub key: &'static str,
    /// SI; empty for a plain number.
    pub unit: &'static str,
    /// The best one, or what it was held at.
    pub value: f64,
    /// Whether it was searched for.
    pub free: bool,
    /// Standard error, first order.
    pub standard_error: Option<f64>,
    /// Interval of the confidence, first order.
    pub interval: Option<(f64, f64)>,
    /// Whether the best value lies beyond the search.
    pub at_bound: bool,
    /// By the profile; an open end is none.
    pub profile_interval: Option<(Option<f64>, Option<f64>)>,
}

/// The least error at each value of one parameter.
#[derive(Clone, Debug, Serialize)]
pub struct ProfileNumbers {
    /// Key of the parameter.
    pub key: &'static str,
    /// In the order of the grid.
    pub points: Vec<ProfilePointNumbers>,
}

/// The best fit with one parameter held.
#[derive(Clone, Debug, Serialize)]
pub struct ProfilePointNumbers {
    /// At which it is held.
    pub value: f64,
    /// Root mean square of the residuals, √(Σ r²/N).
    pub rms: f64,
    /// Values of all parameters.
    pub values: Vec<f64>,
}

/// Another law on the same data.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedNumbers {
    /// The name of the law.
    pub law: &'static str,
    /// Values of its parameters, in the order of the law.
    pub values: Vec<f64>,
    /// Root mean square of the residuals, √(Σ r²/N).
    pub rms: f64,
}

impl LawFit<'_> {
    /// Returns the stored form of it; `case` is what the case is called.
    pub fn numbers(&self, case: &str) -> FitNumbers {
        let (fit, problem) = (&self.fit, &self.problem);
        let family = problem.model.family();
        let parameters = family.parameters().iter().enumerate();
        FitNumbers {
            case: case.to_string(),
            data: self.data.name.clone(),
            law: family.name(),
            end: problem.model.end_rule().into(),
            points: problem.points.len(),
            weighted: problem.has_uncertainties(),
            confidence: self.confidence,
            parameters: parameters.map(|(index, one)| self.parameter(index, one)).collect(),
            correlation: fit.correlation.clone(),
            rms: fit.rms,
            sum_of_squares: fit.sum_of_squares,
            degrees_of_freedom: fit.degrees_of_freedom,
            condition_number: fit.condition,
            profile: self.profile.as_ref().map(|profile| self.profile_numbers(profile)),
            compared: self.compared.iter().map(compared).collect(),
            warnings: self.warnings(),
        }
    }

    fn parameter(&self, index: usize, parameter: &LawParameter) -> ParameterNumbers {
        let estimate = self.fit.estimates.iter().find(|estimate| estimate.index == index);
        let profile = self.profile.as_ref().filter(|profile| profile.index == index);
        ParameterNumbers {
            key: parameter.key,
            unit: parameter.unit,
            value: self.fit.values[index],
            free: estimate.is_some(),
            standard_error: estimate.and_then(|estimate| estimate.standard_error),
            interval: estimate.and_then(|estimate| estimate.interval),
            at_bound: estimate.is_some_and(|estimate| estimate.is_at_bound),
            profile_interval: profile.and_then(|profile| profile.interval),
        }
    }

    fn profile_numbers(&self, profile: &Profile) -> ProfileNumbers {
        let points = profile.points.iter().map(|point| ProfilePointNumbers {
            value: point.value,
            rms: point.rms,
            values: point.values.clone(),
        });
        ProfileNumbers { key: self.problem.parameter(profile.index).key, points: points.collect() }
    }
}

fn compared((model, fit): &(Model, Fit)) -> ComparedNumbers {
    ComparedNumbers { law: model.family().name(), values: fit.values.clone(), rms: fit.rms }
}
