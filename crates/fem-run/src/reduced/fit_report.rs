//! A fit as text and as numbers.

use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::measured::Restitutions;
use fem_fit::{Estimate, Fit, Model, Problem, Profile};
use fem_laws::{EndRule, Family, Parameter};
use serde_json::{Value, json};

use crate::engineering::show;
use crate::tables::table;

/// All that was fitted.
pub struct Fitted<'a> {
    pub case: &'a Path,
    pub data: &'a Restitutions,
    pub problem: &'a Problem<'a>,
    pub fit: &'a Fit,
    pub profile: Option<&'a Profile>,
    pub compared: &'a [(&'a Model, Fit)],
    pub confidence: f64,
}

impl Fitted<'_> {
    /// What a reader should know before trusting the numbers.
    fn warnings(&self) -> Vec<String> {
        let (fit, problem) = (self.fit, self.problem);
        let mut warnings = self.data.warnings();
        for estimate in fit.estimates.iter().filter(|estimate| estimate.is_at_bound) {
            warnings.push(format!("{} is at its bound: the best value lies beyond", estimate.key));
        }
        if fit.degrees_of_freedom == 0 {
            let what = "as many data as parameters: the law passes through them, which says nothing \
                        on whether it is right";
            warnings.push(what.to_string());
        }
        let chi_square = fit.sum_of_squares / fit.degrees_of_freedom.max(1) as f64;
        if problem.has_uncertainties() && fit.degrees_of_freedom > 0 && chi_square > 2.0 {
            warnings.push(format!(
                "the misfit is {:.1} times the uncertainties: the law is wrong or they are too \
                 small, and so are the intervals",
                chi_square.sqrt()
            ));
        }
        if !problem.has_uncertainties() && has_trend(&fit.residuals) {
            let what = "the residuals have a trend: what is left is the law's misfit more than \
                        scatter, and the intervals tell the fit's flatness, no probability";
            warnings.push(what.to_string());
        }
        warnings
    }
}

/// Neighbouring residuals of scatter have opposite signs half of the time; of a misfit, rarely.
fn has_trend(residuals: &[f64]) -> bool {
    let changes = residuals.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
    residuals.len() >= 6 && 4 * changes < residuals.len()
}

pub fn end_words(end_rule: EndRule) -> &'static str {
    match end_rule {
        EndRule::ZeroForce => "zero_force",
        EndRule::ZeroOverlap => "zero_overlap",
    }
}

/// A parameter's value with its unit.
pub fn show_value(value: f64, unit: &str) -> String {
    let takes_prefix = ["s", "m/s"].contains(&unit);
    if takes_prefix {
        show(value, unit)
    } else if (0.01..1e5).contains(&value.abs()) || value == 0.0 {
        let digits = (3 - value.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$} {unit}").trim_end().to_string()
    } else {
        format!("{value:.4e} {unit}").trim_end().to_string()
    }
}

/// For stdout.
pub fn fit_text(fitted: &Fitted<'_>) -> String {
    let Fitted { problem, fit, .. } = fitted;
    let (model, points) = (problem.model, problem.points);
    let speeds = || points.iter().map(|point| point.speed);
    let mut text = format!(
        "{}, contact ends at {}; {} of {}, {} to {}\n\n",
        model.family().name(),
        end_words(model.end_rule()).replace('_', " "),
        if points.len() == 1 { "1 point".to_string() } else { format!("{} points", points.len()) },
        fitted.data.name,
        show(speeds().fold(f64::INFINITY, f64::min), "m/s"),
        show(speeds().fold(0.0, f64::max), "m/s"),
    );
    let level = format!("{} % interval", 100.0 * fitted.confidence);
    let header = ["", "best value", "standard error", level.as_str(), "by profile"];
    let rows = model.family().parameters().iter().enumerate().map(|(index, parameter)| {
        let shown = |value: f64| show_value(value, parameter.unit);
        let estimate = fit.estimates.iter().find(|estimate| estimate.index == index);
        let [error, interval, profile] = match estimate {
            None => ["held".to_string(), String::new(), String::new()],
            Some(Estimate { standard_error, interval, .. }) => [
                standard_error.map_or("-".to_string(), shown),
                interval.map_or("-".to_string(), |(a, b)| format!("{} to {}", shown(a), shown(b))),
                profile_words(fitted.profile.filter(|profile| profile.index == index), shown),
            ],
        };
        [parameter.key.to_string(), shown(fit.values[index]), error, interval, profile]
    });
    let rows: Vec<_> = std::iter::once(header.map(String::from)).chain(rows).collect();
    text += &table(&[Left, Right, Right, Left, Left], rows);
    text += "\n";
    for i in 0..fit.estimates.len() {
        for j in 0..i {
            let (first, second) = (fit.estimates[j].key, fit.estimates[i].key);
            text += &format!("correlation of {first} and {second}: {:.4}\n", fit.correlation[i][j]);
        }
    }
    let unit = if problem.has_uncertainties() { " uncertainties" } else { "" };
    let freedom = fit.degrees_of_freedom;
    let plural = if freedom == 1 { "degree" } else { "degrees" };
    text += &format!("rms error: {:.4}{unit}, {freedom} {plural} of freedom\n", fit.rms);
    let rates = model.decay_rates(fit.values[0]);
    let others = rates.iter().flatten().filter(|rate| (*rate / fit.values[0] - 1.0).abs() > 1e-9);
    if model.family() == Family::Ting && others.count() > 0 {
        text += "decay_rate is the largest; all others keep their ratio to it\n";
    }
    for (model, fit) in fitted.compared {
        let parameters = model.family().parameters().iter().zip(&fit.values);
        let values: Vec<_> = parameters
            .map(|(parameter, value)| {
                format!("{} {}", parameter.key, show_value(*value, parameter.unit))
            })
            .collect();
        let name = model.family().name();
        text += &format!("{name}: rms error {:.4} with {}\n", fit.rms, values.join(", "));
    }
    for warning in fitted.warnings() {
        text += &format!("warning: {warning}\n");
    }
    text
}

fn profile_words(profile: Option<&Profile>, shown: impl Fn(f64) -> String) -> String {
    match profile.and_then(|profile| profile.interval) {
        None => String::new(),
        Some((low, high)) => {
            let end = |end: Option<f64>| end.map_or("open".to_string(), &shown);
            format!("{} to {}", end(low), end(high))
        }
    }
}

/// `fit.json`.
pub fn fit_numbers(fitted: &Fitted<'_>) -> Value {
    let Fitted { problem, fit, .. } = fitted;
    let model = problem.model;
    let parameters = model.family().parameters();
    let parameter = |(index, parameter): (usize, &Parameter)| {
        let estimate = fit.estimates.iter().find(|estimate| estimate.index == index);
        let profile = fitted.profile.filter(|profile| profile.index == index);
        json!({
            "key": parameter.key,
            "unit": parameter.unit,
            "value": fit.values[index],
            "free": estimate.is_some(),
            "standard_error": estimate.and_then(|estimate| estimate.standard_error),
            "interval": estimate.and_then(|estimate| estimate.interval),
            "at_bound": estimate.is_some_and(|estimate| estimate.is_at_bound),
            "profile_interval": profile.and_then(|profile| profile.interval),
        })
    };
    let profile = fitted.profile.map(|profile| {
        let points = profile.points.iter();
        let points = points.map(|point| {
            json!({ "value": point.value, "rms": point.rms,
            "values": point.values })
        });
        json!({ "key": parameters[profile.index].key, "points": points.collect::<Vec<_>>() })
    });
    let compared = fitted.compared.iter().map(|(model, fit)| {
        json!({ "law": model.family().name(), "values": fit.values, "rms": fit.rms })
    });
    json!({
        "case": fitted.case.display().to_string(),
        "data": fitted.data.name,
        "law": model.family().name(),
        "end": end_words(model.end_rule()),
        "points": problem.points.len(),
        "weighted": problem.has_uncertainties(),
        "confidence": fitted.confidence,
        "parameters": parameters.iter().enumerate().map(parameter).collect::<Vec<_>>(),
        "correlation": fit.correlation,
        "rms": fit.rms,
        "sum_of_squares": fit.sum_of_squares,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "condition_number": fit.condition,
        "profile": profile,
        "compared": compared.collect::<Vec<_>>(),
        "warnings": fitted.warnings(),
    })
}
