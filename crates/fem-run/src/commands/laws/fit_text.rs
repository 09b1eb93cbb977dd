//! The texts of a fit and of a ranking of laws.

use std::collections::BTreeSet;
use std::path::Path;

use fem::fit::cradle::Measured;
use fem::fit::{Estimate, Fit, InputPart, Model, Profile, Robustness};
use fem::laws::{ChosenLaw, LawFit, LawRanking, StandIn};
use fem::measured::Restitutions;
use fem_case::UncertainInput;
use fem_case::engineering::{Unit, number, show, takes_prefix};
use fem_case::schema::End;
use fem_laws::{LawFamily, LawParameter};

use fem_report::law_figures::{MAX_RANKED, evidence};

use crate::text::run_report::Detail;
use crate::text::{hanging, headed, one_line, show_measured, show_value, shown};

/// Largest number of points that a text lists.
const MOST_LISTED: usize = 6;

/// Returns the first line of the text: the fitted parameters with their standard errors.
pub fn answer(fitted: &LawFit<'_>, ranking: Option<&LawRanking>) -> String {
    let family = fitted.problem.model.family();
    let fitted = fitted.fit.estimates.iter().map(|estimate| {
        let unit = family.parameters()[estimate.index].unit;
        let shown = with_error(estimate.value, estimate.standard_error, unit);
        format!("{} = {shown}", estimate.key)
    });
    let fitted: Vec<String> = fitted.collect();
    let best = match ranking {
        Some(ranking) if ranking.laws.iter().any(|law| law.weight.is_some()) => {
            let n = ranking.laws.len();
            format!(" fits best of {n} law{}", if n == 1 { "" } else { "s" })
        }
        _ => String::new(),
    };
    format!("{} ({}{best})\n\n", fitted.join(", "), family.name())
}

/// Returns a value with its standard error in one unit, `569 ± 197 µs`.
pub fn with_error(value: f64, error: Option<f64>, unit: &str) -> String {
    if takes_prefix(unit)
        && let Some(error) = error
    {
        let fitting = Unit::fitting(value, unit);
        let [value, uncertainty] = [value, error].map(|it| fitting.scaled(it));
        return show_measured(Measured { value, uncertainty }, fitting.symbol());
    }
    let error = error.map_or(String::new(), |error| format!(" ± {}", number(error, 2)));
    match takes_prefix(unit) {
        true => show(value, unit),
        false => format!("{}{error} {unit}", number(value, 3)).trim_end().to_string(),
    }
}

/// Returns parameters and errors of the fitted law, and a line for each compared law that `ranked` does not list.
pub fn fit_text(fitted: &LawFit<'_>, law: &ChosenLaw, ranked: Option<&LawRanking>) -> String {
    let LawFit { problem, fit, .. } = fitted;
    let (model, points) = (problem.model, problem.points);
    let (slowest, fastest) = fitted.data.speeds();
    let mut text = hanging(&format!(
        "{}, contact ends at {}\n{} of {}, {} to {}\n",
        model.family().name(),
        End::from(model.end_rule()).word().replace('_', " "),
        if points.len() == 1 { "1 point".to_string() } else { format!("{} points", points.len()) },
        fitted.data.name,
        show(slowest, "m/s"),
        show(fastest, "m/s"),
    ));
    text += &parameters(fitted, law);
    text += "\n";
    text += &errors_by_inputs(fitted);
    for i in 0..fit.estimates.len() {
        for j in 0..i {
            let (first, second) = (fit.estimates[j].key, fit.estimates[i].key);
            text += &format!("correlation of {first} and {second}: {:.4}\n", fit.correlation[i][j]);
        }
    }
    let unit = if problem.has_uncertainties() { " of the uncertainties" } else { "" };
    let freedom = fit.degrees_of_freedom;
    let plural = if freedom == 1 { "degree" } else { "degrees" };
    text += &format!("rms error: {:.4}{unit}, {freedom} {plural} of freedom\n", fit.rms);
    if let Some(robustness) = &fit.robustness {
        text += &weighted_down(fitted.data, robustness, &fitted.weights());
    }
    let rates = model.decay_rates(fit.values[0]);
    let others = rates.iter().flatten().filter(|rate| (*rate / fit.values[0] - 1.0).abs() > 1e-9);
    if model.family() == LawFamily::Ting && others.count() > 0 {
        text += "decay_rate is the largest one; the others keep their ratio to it\n";
    }
    text + &compared(fitted, unit, ranked.map_or(0, |ranking| ranking.laws.len().saturating_sub(1)))
}

/// Returns the table of the law's parameters: the fitted ones with their errors, and the held ones.
fn parameters(fitted: &LawFit<'_>, law: &ChosenLaw) -> String {
    let LawFit { problem, fit, .. } = fitted;
    let level = 100.0 * fitted.confidence;
    let by_profile = if fitted.profile.is_some() { "|by profile" } else { "" };
    let header = format!("|>best value|>standard error|{level} % interval{by_profile}");
    let rows = problem.model.family().parameters().iter().enumerate().map(|(index, parameter)| {
        let shown = |value: f64| show_value(value, parameter.unit);
        let estimate = fit.estimates.iter().find(|estimate| estimate.index == index);
        let [error, interval, profile] = match estimate {
            None => {
                let of = law.stand_in(index).map(StandIn::words);
                let held = of.map_or("held".to_string(), |of| format!("held: {of}"));
                [held, String::new(), String::new()]
            }
            Some(Estimate { standard_error, interval, .. }) => [
                standard_error.map_or("-".to_string(), shown),
                interval.map_or("-".to_string(), |(a, b)| format!("{} to {}", shown(a), shown(b))),
                profile_words(
                    fitted.profile.as_ref().filter(|profile| profile.index == index),
                    shown,
                ),
            ],
        };
        let mut cells = vec![parameter.key.to_string(), shown(fit.values[index]), error, interval];
        cells.extend(fitted.profile.as_ref().map(|_| profile));
        cells
    });
    headed(&header, rows)
}

/// Returns the standard error of each parameter by the data and by each uncertain input.
fn errors_by_inputs(fitted: &LawFit<'_>) -> String {
    let family = fitted.problem.model.family();
    let row = |(j, estimate): (usize, &Estimate)| {
        let unit = family.parameters()[estimate.index].unit;
        let shown = |value: f64| show_value(fitted.scale_of(estimate) * value, unit);
        let data = estimate.error_of_data.map_or("?".to_string(), |it| show_value(it, unit));
        let part = |part: &InputPart| match part.changes[j].abs() {
            change if change.is_finite() => {
                format!(", {} by {}", shown(change), relative(&part.input))
            }
            _ => format!(", no fit with {}", relative(&part.input)),
        };
        let parts: String = fitted.inputs.iter().map(part).collect();
        let law = match fitted.error_by_law(estimate) {
            0.0 => String::new(),
            error if error.is_finite() => {
                format!(", {} by the law itself", show_value(error, unit))
            }
            _ => match fitted.at_least {
                Some(least) => format!(
                    ", at least {} by the law itself: any stronger body does not flow",
                    show_value(least, unit)
                ),
                None => ", no fit within the error of the law itself".to_string(),
            },
        };
        hanging(&format!("standard error of {}: {data} by the data{parts}{law}\n", estimate.key))
    };
    let has_parts = !fitted.inputs.is_empty() || fitted.by_law.iter().any(|part| *part != 0.0);
    fitted.fit.estimates.iter().enumerate().filter(|_| has_parts).map(row).collect()
}

/// Returns a line for each law that is compared, after the first `n_skipped`.
fn compared(fitted: &LawFit<'_>, unit: &str, n_skipped: usize) -> String {
    let parameter = |fit: &Fit, parameter: &LawParameter, value: f64| {
        let estimate = fit.estimates.iter().find(|own| own.key == parameter.key);
        let is_at_bound = estimate.is_some_and(|own| own.is_at_bound);
        let bound = if is_at_bound { " (at its bound)" } else { "" };
        format!("{} {}{bound}", parameter.key, show_value(value, parameter.unit))
    };
    let line = |(model, fit): &(Model, Fit)| {
        let parameters = model.family().parameters().iter().zip(&fit.values);
        let values: Vec<_> = parameters.map(|(it, value)| parameter(fit, it, *value)).collect();
        let name = model.family().name();
        hanging(&format!("{name}: rms error {:.4}{unit} with {}\n", fit.rms, values.join(", ")))
    };
    fitted.compared.iter().skip(n_skipped).map(line).collect()
}

/// Returns an input with its relative uncertainty, `body.1.plate.thickness ± 2 %`.
pub fn relative(input: &UncertainInput) -> String {
    let UncertainInput { key, value, uncertainty } = input;
    format!("{key} ± {} %", number(100.0 * uncertainty / value.abs(), 2))
}

/// Returns the points that a robust fit weights down.
pub fn weighted_down(data: &Restitutions, robustness: &Robustness, weights: &[f64]) -> String {
    let far = |k: &usize| weights[*k] < Robustness::FEW;
    let far: Vec<usize> = (0..weights.len()).filter(far).collect();
    let scale = number(robustness.scale, 3);
    let unit = if data.has_uncertainties() { " times the uncertainties" } else { "" };
    let mut text = format!(
        "robust: the scatter has a scale of {scale}{unit}; {} of {} points count less than a quarter\n",
        far.len(),
        weights.len()
    );
    for k in far.iter().take(MOST_LISTED) {
        let point = &data.points[*k];
        let line = data.lines.get(*k).map_or(format!("point {k}"), |line| format!("line {line}"));
        text += &format!(
            "  {line}: e = {} at {}, weight {}\n",
            number(point.restitution, 4),
            show(point.speed, "m/s"),
            number(weights[*k], 2)
        );
    }
    match far.len().saturating_sub(MOST_LISTED) {
        0 => text,
        n => text + &format!("  and {n} more: see the column weight of residuals.csv\n"),
    }
}

/// Returns the law as a case has it, and the command that writes it for other codes.
pub fn next_steps(fitted: &LawFit<'_>, case: &str, kept: Option<&Path>) -> String {
    let model = fitted.model_toml().map_or(String::new(), |toml| {
        format!("\nThe law in a case of the same bodies; its e has all losses of the data:\n{toml}")
    });
    let case = one_line(case);
    let export = kept.map_or(String::new(), |folder| {
        format!("Input for DEM codes:\n    fem-run export {case} --fit {}\n", shown(folder))
    });
    model + &export
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

/// Returns the text on stdout, the best law first; a short one has the best laws only.
pub fn ranking_text(ranking: &LawRanking, detail: Detail) -> String {
    let n_shown = match detail {
        Detail::Short => MAX_RANKED.min(ranking.laws.len()),
        Detail::All => ranking.laws.len(),
    };
    let rows = ranking.laws[..n_shown].iter().map(|law| {
        let shown = |value: Option<f64>, digits: usize| {
            value.map_or("too few data".to_string(), |value| format!("{value:.digits$}"))
        };
        [
            law.family().name().to_string(),
            law.free.join(", "),
            format!("{:.4}", law.fit.rms),
            shown(law.difference, 1),
            law.weight.map_or(String::new(), evidence),
        ]
    });
    let mut text = headed("law|free|>rms error|>ΔAICc|>evidence", rows);
    if n_shown < ranking.laws.len() {
        text += &format!("and {} more; -v prints them\n", ranking.laws.len() - n_shown);
    }
    text += match ranking.laws.iter().any(|law| law.weight.is_some()) {
        true => "evidence: share of each law among these; all of them may be wrong\n",
        false => {
            "there are too few data to rank the laws: the first merely has the fewest\n\
             parameters. Measure at more speeds, or give uncertainties\n"
        }
    };
    if detail == Detail::Short {
        return text + "\n";
    }
    let of: BTreeSet<&str> = ranking.twins.iter().map(|(_, of)| *of).collect();
    for of in of {
        let twins = ranking.twins.iter().filter(|twin| twin.1 == of).map(|twin| twin.0.as_str());
        let twins: Vec<&str> = twins.collect();
        text += &hanging(&format!("the same curve as {of}: {}\n", twins.join(", ")));
    }
    for (law, why) in &ranking.others {
        text += &hanging(&format!("not ranked: {law}: {}\n", one_line(why)));
    }
    text + "\n"
}

/// Returns the text of `ranking.csv`.
pub fn ranking_csv(ranking: &LawRanking) -> String {
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let mut text = "law,free,rms_error,aicc_difference,evidence\n".to_string();
    for law in &ranking.laws {
        let (name, free) = (law.family().name(), law.free.join(" "));
        let (difference, weight) = (cell(law.difference), cell(law.weight));
        text += &format!("{name},{free},{},{difference},{weight}\n", law.fit.rms);
    }
    text
}
