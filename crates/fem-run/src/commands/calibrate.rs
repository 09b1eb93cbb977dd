//! `fem-run calibrate CASE --data E.csv`: a Prony series from measured restitutions.

use std::path::PathBuf;

use fem::measured::{MeasuredPairs, UncertaintyError};
use fem_case::{Case, parse_quantity};
use fem_fit::FitError;
use fem_fit::spectrum::{SpectrumProblem, root_mean_square};
use fem_material::{ActsOn, PronyTerm};
use rayon::prelude::*;

use crate::calibrate::{
    Calibrated, Experiment, Maxwell, ModelName, Target, calibration_numbers, calibration_picture,
    calibration_text, ends, relaxation_table, terms, unused_model, warnings,
};
use crate::case_arguments::{CaseArguments, stem_of};
use crate::data_file::read_table;
use crate::failure::Failure;
use crate::reduced::{Output, OutputArguments, from_fit_error, parse_confidence};
use crate::standard_output;

/// Find a Prony series that makes measured restitutions, and what they leave open
///
/// The case gives bodies and instantaneous moduli, a CSV file the restitutions. Writes
/// calibrate.json, relaxation.toml (to paste into the case), residuals.csv and calibrate.svg, and
/// prints each weight with the range that the data allow.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions: a CSV file with the columns speed_m_s (or speed_cm_s) and restitution
    ///
    /// A column restitution_uncertainty weighs them. Columns diameter_1_mm and diameter_2_mm make
    /// several pairs, one series for all. The sweep.csv of a sweep over speeds and diameters will
    /// do.
    #[arg(long, value_name = "FILE")]
    data: PathBuf,
    /// Terms of the series
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=12))]
    terms: u8,
    /// Relaxation times of the first and the last term, the others evenly between in the logarithm
    /// [default: a tenth of the shortest contact time to ten times the longest]
    #[arg(long, value_name = "FIRST..LAST", value_parser = parse_window)]
    times: Option<(f64, f64)>,
    /// What relaxes: all moduli, or the shear modulus beside an elastic bulk modulus [default: as
    /// in the case, or all]
    #[arg(long, value_name = "MODULI", value_parser = ["all", "shear"])]
    acts_on: Option<String>,
    /// The material that is calibrated, where the bodies' differ; the other keeps its relaxation
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    /// A weight of 1 costs as much as this error of a restitution; 0 for none [default: the data's
    /// uncertainty, or 0.001]
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = parse_ridge)]
    regularisation: Option<f64>,
    /// Standard uncertainty of the restitutions, where the file has none
    #[arg(long, value_name = "U", allow_negative_numbers = true)]
    uncertainty: Option<f64>,
    /// What computes a collision
    #[arg(long, value_name = "MODEL", value_enum, default_value_t = ModelName::Condensed)]
    model: ModelName,
    /// Level of the ranges
    #[arg(long, value_name = "P", default_value_t = 0.95, allow_negative_numbers = true,
        value_parser = parse_confidence)]
    confidence: f64,
    #[command(flatten)]
    output: OutputArguments,
}

/// How far the relaxation times reach beyond the contact times: a term ten times slower or faster
/// loses a tenth, and one beyond is told from it by its weight only.
const REACH: f64 = 10.0;
/// λ without uncertainties.
const REGULARISATION: f64 = 1e-3;

/// Calibrates and writes.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = Case::load(&arguments.input.case, &arguments.input.set)?;
    let acts_on = arguments.acts_on.as_deref();
    let acts_on = acts_on.map(|on| if on == "all" { ActsOn::All } else { ActsOn::Shear });
    let target = Target::of(&case, arguments.material.as_deref(), acts_on)?;
    let mut measured = MeasuredPairs::read(&read_table(&arguments.data)?, &case.scene)?;
    fill_uncertainties(arguments, &mut measured)?;
    let uncertainties = measured.uncertainties();
    let regularisation = arguments
        .regularisation
        .unwrap_or_else(|| uncertainties.as_deref().map_or(REGULARISATION, root_mean_square));
    let (n_values, n_free) = (measured.data.points.len(), usize::from(arguments.terms));
    if n_values < n_free && regularisation == 0.0 {
        let free = "the weights".to_string();
        return Err(refused(FitError::TooFewData { n_values, n_free, free }));
    }
    let experiments = measured
        .pairs
        .par_iter()
        .map(|bodies| Experiment::new(&case, &measured, bodies, &target, arguments.model));
    let experiments: Vec<Experiment> = experiments.collect::<Result<_, _>>()?;
    let contacts = ends(experiments.iter().flat_map(|experiment| &experiment.contact_times));
    let window = arguments.times.unwrap_or((contacts.0 / REACH, contacts.1 * REACH));
    let times = spaced(window, n_free);
    let restitutions = |terms: &[PronyTerm]| all_restitutions(&experiments, terms, n_values);
    let of_weights = |weights: &[f64]| restitutions(&terms(&times, weights));
    let wanted = measured.restitutions();
    let problem = SpectrumProblem {
        restitutions: &of_weights,
        measured: &wanted,
        collisions: &measured.collisions(),
        uncertainties: uncertainties.as_deref(),
        times: &times,
        regularisation,
    };
    let fit = problem.fit(arguments.confidence).map_err(refused)?;
    let maxwell = Maxwell::of_mean(&restitutions, &wanted, contacts).map_err(refused)?;
    let mut warnings = warnings(&measured, &experiments, &fit);
    warnings.extend(unused_model(&case, arguments.model));
    let found = Calibrated {
        case: &arguments.input.case,
        measured: &measured,
        experiments: &experiments,
        target: &target,
        model: arguments.model,
        regularisation,
        confidence: arguments.confidence,
        times: &times,
        fit: &fit,
        maxwell: &maxwell,
        warnings: &warnings,
    };
    let picture = calibration_picture(&found).map_err(refused)?;
    let mut output = arguments.output.claim(&stem_of(&arguments.data), "calibrate")?;
    output.write("relaxation.toml", relaxation_table(&found))?;
    write_residuals(&mut output, &found)?;
    output.write("calibrate.svg", picture)?;
    let place = output.publish(calibration_numbers(&found))?;
    if arguments.output.quiet {
        return Ok(());
    }
    standard_output::print(&format!("{}\nResult: {place}\n", calibration_text(&found)))
}

/// `--uncertainty` for all rows of a file that has none.
fn fill_uncertainties(arguments: &Arguments, measured: &mut MeasuredPairs) -> Result<(), Failure> {
    let Some(uncertainty) = arguments.uncertainty else { return Ok(()) };
    measured.data.set_uncertainty(uncertainty).map_err(|error| match error {
        UncertaintyError::OutOfRange(found) => {
            Failure::bad_input(format!("--uncertainty is {found:?}"))
                .with_help("it must be greater than 0 and at most 1: restitutions lie between")
        }
        UncertaintyError::Known(_) => {
            Failure::bad_input(error.to_string()).with_help("leave --uncertainty out")
        }
    })
}

/// Restitutions of all points in the order of the data, the pairs side by side.
fn all_restitutions(
    experiments: &[Experiment],
    terms: &[PronyTerm],
    n_points: usize,
) -> Result<Vec<f64>, FitError> {
    let of_pair =
        |experiment: &Experiment| -> Result<Vec<f64>, FitError> { experiment.restitutions(terms) };
    let found: Vec<_> = experiments.par_iter().map(of_pair).collect::<Result<_, _>>()?;
    let mut restitutions = vec![0.0; n_points];
    for (experiment, found) in experiments.iter().zip(found) {
        for (point, restitution) in experiment.points.iter().zip(found) {
            restitutions[*point] = restitution;
        }
    }
    Ok(restitutions)
}

fn write_residuals(output: &mut Output, found: &Calibrated<'_>) -> Result<(), Failure> {
    let header = [
        "diameter_1_m",
        "diameter_2_m",
        "speed_m_s",
        "restitution",
        "restitution_uncertainty",
        "fitted_restitution",
        "residual",
    ];
    let rows = found.measured.data.points.iter().enumerate().map(|(k, point)| {
        let [first, second] = found.experiments[found.measured.pair_of(k)].diameters;
        let fitted = found.fit.restitutions[k];
        vec![
            first,
            second,
            Some(point.speed),
            Some(point.restitution),
            point.restitution_uncertainty,
            Some(fitted),
            Some(fitted - point.restitution),
        ]
    });
    output.write_table("residuals.csv", &header, rows)
}

/// A λ.
fn parse_ridge(text: &str) -> Result<f64, String> {
    let ridge = text.parse::<f64>().ok().filter(|ridge| *ridge >= 0.0 && ridge.is_finite());
    ridge.ok_or_else(|| "it must be at least 0, such as 0.001; 0 is none".to_string())
}

/// Evenly in the logarithm, the ends included; one alone lies in the middle.
fn spaced((first, last): (f64, f64), n: usize) -> Vec<f64> {
    let share = |k: usize| if n == 1 { 0.5 } else { k as f64 / (n - 1) as f64 };
    (0..n).map(|k| first * (last / first).powf(share(k))).collect()
}

/// `10 us..1 ms`.
fn parse_window(text: &str) -> Result<(f64, f64), String> {
    let (first, last) = text.split_once("..").ok_or("write FIRST..LAST, such as '10 us..1 ms'")?;
    let time = |text: &str| match parse_quantity(text.trim()) {
        Ok((value, dimension)) if [[0; 4], [0, 0, 1, 0]].contains(&dimension.0) => Ok(value),
        Ok(_) => Err(format!("{text:?} is no time, such as '10 us'")),
        Err(error) => Err(format!("{text:?} is no time: {error}")),
    };
    let (first, last) = (time(first)?, time(last)?);
    if first > 0.0 && first <= last && last.is_finite() {
        Ok((first, last))
    } else {
        Err("the first time must be greater than 0 and at most the last".to_string())
    }
}

/// Bad input, unless it is a collision that failed.
fn refused(error: FitError) -> Failure {
    match error {
        FitError::TooFewData { .. } => Failure::bad_input(error.to_string())
            .with_help("lower --terms, measure at more speeds, or give --regularisation above 0"),
        FitError::Collision { .. } => Failure::failed(error.to_string()).with_help(
            "leave out the speeds at which the bodies are not linear, or give slower --times",
        ),
        FitError::NotConverged { .. } => {
            Failure::failed(error.to_string()).with_help("lower --terms, or raise --regularisation")
        }
        error => from_fit_error(error),
    }
}
