//! `fem-run fit CASE --data E.csv --law NAME`: parameters of a law from measured restitutions.

use std::path::PathBuf;

use fem::measured::Restitutions;
use fem_case::Case;
use fem_fit::{Fit, Free, Model, Problem};
use fem_laws::{Family, Role};

use crate::case_arguments::{CaseArguments, stem_of};
use crate::data_file::read_table;
use crate::failure::Failure;
use crate::reduced::{
    ChosenLaw, Fitted, LawArguments, Output, OutputArguments, family_of, find_key, find_loss,
    fit_numbers, fit_picture, fit_text, from_fit_error, histories_picture, parse_confidence,
    parse_family, parse_speed, parse_value, split,
};
use crate::standard_output;

/// Fit parameters of a contact law to restitutions over speeds
///
/// The case gives the two bodies, a CSV file the restitutions. Writes fit.json, residuals.csv,
/// fit.svg and histories.svg, and prints values with their confidence intervals.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions: a CSV file with the columns speed_m_s (or speed_cm_s) and restitution
    ///
    /// A column restitution_uncertainty weighs them. The sweep.csv of a sweep over speeds will do.
    #[arg(long, value_name = "FILE")]
    data: PathBuf,
    /// The law, such as bordbar_hyppanen or ting [default: that of the case's model]
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    law: Option<Family>,
    /// Parameters to find, such as a,n [default: the one that damps]
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    free: Vec<String>,
    #[command(flatten)]
    values: LawArguments,
    /// Where to search a free parameter, such as n=0.3..1.5; may be repeated
    #[arg(long, value_name = "KEY=LOW..HIGH")]
    bounds: Vec<String>,
    /// Draw the error over this free parameter, all others fitted anew [default: n if it is free]
    #[arg(long, value_name = "KEY")]
    profile: Option<String>,
    /// Fit this law too, for comparison, its damping free; may be repeated
    #[arg(long, value_name = "LAW", value_parser = parse_family)]
    compare: Vec<Family>,
    /// Fit the column contact_time_s as well
    #[arg(long)]
    contact_time: bool,
    /// Level of the confidence intervals
    #[arg(long, value_name = "P", default_value_t = 0.95, allow_negative_numbers = true,
        value_parser = parse_confidence)]
    confidence: f64,
    /// Speed of the histories that are drawn [default: the middle of the data]
    #[arg(long, value_name = "SPEED", value_parser = parse_speed)]
    at: Option<f64>,
    #[command(flatten)]
    output: OutputArguments,
}

/// Values of a profile that are drawn.
const GRID: usize = 25;
/// Half the width of that grid, in widths of the parameter's interval, where that is known.
const GRID_REACH: f64 = 2.5;

/// Fits and writes.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = Case::load(&arguments.input.case, &arguments.input.set)?;
    let table = read_table(&arguments.data)?;
    let data = match arguments.contact_time {
        true => Restitutions::read_with_contact_times(&table, &case.scene)?,
        false => Restitutions::read(&table, &case.scene)?,
    };
    let family = arguments.law.or_else(|| family_of(&case)).ok_or_else(|| {
        Failure::bad_input("--law is missing, and the case's [model] names no law")
            .with_help("name one, such as --law bordbar_hyppanen; docs/fits.md lists them")
    })?;
    let chosen = arguments.values.choose(&case, family)?;
    let model = &chosen.model;
    let problem = problem(arguments, &chosen, &data)?;
    let profiled = profiled(arguments, &problem)?;
    let fit = problem.fit(arguments.confidence).map_err(from_fit_error)?;
    let profile = profiled
        .map(|free| problem.profile(&fit, free, &grid(free, &fit)))
        .transpose()
        .map_err(from_fit_error)?;
    let mut others = Vec::new();
    for family in &arguments.compare {
        let model = model.with_family(*family).map_err(from_fit_error)?;
        others.push((model, *family));
    }
    let compared = others.iter().map(|(model, family)| compare(model, *family, &data, arguments));
    let compared: Vec<(&Model, Fit)> = compared.collect::<Result<_, _>>()?;

    let mut output = arguments.output.claim(&stem_of(&arguments.data), "fit")?;
    let fitted = Fitted {
        case: &arguments.input.case,
        data: &data,
        problem: &problem,
        fit: &fit,
        profile: profile.as_ref(),
        compared: &compared,
        confidence: arguments.confidence,
    };
    write_residuals(&mut output, &problem, &fit)?;
    output.write("fit.svg", fit_picture(&fitted))?;
    let speed = arguments.at.unwrap_or_else(|| problem.middle_speed());
    let histories = histories_picture(&case.scene, model, &fit.values, speed);
    output.write("histories.svg", histories.map_err(|error| from_fit_error(error.into()))?)?;
    let place = output.publish(fit_numbers(&fitted))?;
    if arguments.output.quiet {
        return Ok(());
    }
    standard_output::print(&format!("{}\nResult: {place}\n", fit_text(&fitted)))
}

/// The problem with all that options and case say.
fn problem<'a>(
    arguments: &Arguments,
    chosen: &'a ChosenLaw,
    data: &'a Restitutions,
) -> Result<Problem<'a>, Failure> {
    let model = &chosen.model;
    let family = model.family();
    let default = [loss_key(family)?.to_string()];
    let keys = if arguments.free.is_empty() { &default[..] } else { &arguments.free };
    for key in keys {
        find_key(family, key, "--free")?;
    }
    let keys: Vec<&str> = keys.iter().map(|key| key.trim()).collect();
    let mut problem = Problem::new(model, &data.points, &keys).map_err(from_fit_error)?;
    problem.values = chosen.values(&problem.values);
    for free in &mut problem.free {
        free.start = chosen.start(free.index);
    }
    let is_free = |index: usize| problem.free.iter().any(|free| free.index == index);
    if let Some(key) = chosen.missing(is_free) {
        let message = format!("{} needs a value of {key}", family.name());
        return Err(Failure::bad_input(message).with_help(format!(
            "give it, --param {key}=VALUE, or let it be found, --free {},{key}",
            keys.join(",")
        )));
    }
    for text in &arguments.bounds {
        bound(&mut problem, family, text)?;
    }
    Ok(problem)
}

/// The key of what stands for the loss.
fn loss_key(family: Family) -> Result<&'static str, Failure> {
    Ok(family.parameters()[find_loss(family)?].key)
}

fn bound(problem: &mut Problem<'_>, family: Family, text: &str) -> Result<(), Failure> {
    let (key, range) = split(text, "--bounds")?;
    let index = find_key(family, key, "--bounds")?;
    let parameter = &family.parameters()[index];
    let fault = |found: &str| {
        Failure::bad_input(format!("--bounds {text:?}: {found}"))
            .with_help("write --bounds KEY=LOW..HIGH with LOW < HIGH, such as --bounds n=0.3..1.5")
    };
    let (low, high) = range.split_once("..").ok_or_else(|| fault("there is no `..`"))?;
    let low = parse_value(parameter, low, "--bounds")?;
    let high = parse_value(parameter, high, "--bounds")?;
    if low >= high {
        return Err(fault("the range is empty"));
    }
    let free = problem.free.iter_mut().find(|free| free.index == index);
    free.ok_or_else(|| fault("the parameter is not free"))?.bounds = (low, high);
    Ok(())
}

/// The free parameter whose profile is drawn.
fn profiled<'p>(
    arguments: &Arguments,
    problem: &'p Problem<'_>,
) -> Result<Option<&'p Free>, Failure> {
    let find = |index: usize| problem.free.iter().find(|free| free.index == index);
    match &arguments.profile {
        None => Ok(problem.free.iter().find(|free| problem.parameter(free.index).key == "n")),
        Some(key) => {
            let free = find(find_key(problem.model.family(), key, "--profile")?);
            free.map(Some).ok_or_else(|| {
                Failure::bad_input(format!("--profile {key}: this parameter is not free"))
                    .with_help(format!("add it to --free, such as --free {key}"))
            })
        }
    }
}

/// Values around the best one; a logarithmic parameter's in equal ratios.
fn grid(free: &Free, fit: &Fit) -> Vec<f64> {
    let best = fit.values[free.index];
    let estimate = fit.estimates.iter().find(|estimate| estimate.index == free.index);
    let is_number = estimate.is_some_and(|estimate| estimate.key == "n");
    let (low, high) = match estimate.and_then(|estimate| estimate.interval) {
        _ if is_number => (best.min(0.4), best.max(1.1)),
        Some((low, high)) if low > 0.0 => {
            ((low / best).powf(GRID_REACH) * best, (high / best).powf(GRID_REACH) * best)
        }
        _ => (0.5 * best, 2.0 * best),
    };
    let (low, high) = (low.max(free.bounds.0), high.min(free.bounds.1));
    let part = |k: usize| k as f64 / (GRID - 1) as f64;
    (0..GRID)
        .map(|k| match is_number {
            true => low + part(k) * (high - low),
            false => low * (high / low).powf(part(k)),
        })
        .collect()
}

/// Another law on the same data.
fn compare<'a>(
    model: &'a Model,
    family: Family,
    data: &Restitutions,
    arguments: &Arguments,
) -> Result<(&'a Model, Fit), Failure> {
    let mut free = vec![loss_key(family)?];
    // Contact times determine a stiffness that no theory gives; restitutions do not depend on it.
    if data.points.iter().any(|point| point.contact_time.is_some()) {
        let stiff =
            family.parameters().iter().filter(|parameter| parameter.role == Role::Stiffness);
        free.extend(stiff.map(|parameter| parameter.key));
    }
    let problem = Problem::new(model, &data.points, &free).map_err(from_fit_error)?;
    let fit = problem.fit(arguments.confidence).map_err(|error| {
        Failure::bad_input(format!("--compare {}: {error}", family.name()))
            .with_help("leave it out, or fit it alone with --law")
    })?;
    Ok((model, fit))
}

fn write_residuals(output: &mut Output, problem: &Problem<'_>, fit: &Fit) -> Result<(), Failure> {
    let header = [
        "speed_m_s",
        "restitution",
        "restitution_uncertainty",
        "fitted_restitution",
        "residual",
        "contact_time_s",
        "fitted_contact_time_s",
    ];
    let rows = problem.points.iter().map(|point| {
        let fitted = problem.model.outcome(&fit.values, point.speed).ok();
        let restitution = fitted.map(|fitted| fitted.restitution);
        vec![
            Some(point.speed),
            Some(point.restitution),
            point.restitution_uncertainty,
            restitution,
            restitution.map(|restitution| restitution - point.restitution),
            point.contact_time,
            fitted.and_then(|fitted| fitted.contact_time),
        ]
    });
    output.write_table("residuals.csv", &header, rows)
}
