//! `fit.json`: a fitted law in SI units.

use fem_case::schema::End;
use fem_laws::LawParameter;
use serde_json::{Value, json};

use super::law_fit::LawFit;
use crate::fit::{Fit, Model, Profile, ProfilePoint};

impl LawFit<'_> {
    /// Returns the stored form of the fit in SI units; `case` is the case's name.
    pub fn numbers(&self, case: &str) -> Value {
        let (fit, problem) = (&self.fit, &self.problem);
        let family = problem.model.family();
        let compared = |(model, fit): &(Model, Fit)| json!({ "law": model.family().name(), "values": fit.values, "rms": fit.rms });
        let parameters = family.parameters().iter().enumerate();
        json!({
            "case": case,
            "data": self.data.name,
            "law": family.name(),
            "end": End::from(problem.model.end_rule()),
            "points": problem.points.len(),
            "weighted": problem.has_uncertainties(),
            "confidence": self.confidence,
            "parameters": parameters.map(|(k, one)| self.parameter(k, one)).collect::<Value>(),
            "correlation": fit.correlation,
            "rms": fit.rms,
            "sum_of_squares": fit.sum_of_squares,
            "degrees_of_freedom": fit.degrees_of_freedom,
            "condition_number": fit.condition,
            "profile": self.profile.as_ref().map(|profile| self.profile_numbers(profile)),
            "compared": self.compared.iter().map(compared).collect::<Value>(),
            "warnings": self.warnings(),
        })
    }

    fn parameter(&self, index: usize, parameter: &LawParameter) -> Value {
        let estimate = self.fit.estimates.iter().find(|estimate| estimate.index == index);
        let profile = self.profile.as_ref().filter(|profile| profile.index == index);
        json!({
            "key": parameter.key,
            "unit": parameter.unit,
            "value": self.fit.values[index],
            "free": estimate.is_some(),
            "standard_error": estimate.and_then(|estimate| estimate.standard_error),
            "interval": estimate.and_then(|estimate| estimate.interval),
            "at_bound": estimate.is_some_and(|estimate| estimate.is_at_bound),
            "profile_interval": profile.and_then(|profile| profile.interval),
        })
    }

    fn profile_numbers(&self, profile: &Profile) -> Value {
        let point = |point: &ProfilePoint| json!({ "value": point.value, "rms": point.rms, "values": point.values });
        json!({
            "key": self.problem.parameter(profile.index).key,
            "points": profile.points.iter().map(point).collect::<Value>(),
        })
    }
}
