//! `fem-run calibrate CASE --data E.csv`: a Prony series from measured restitutions.

use std::path::PathBuf;

use fem::calibrate::{Calibration, CalibrationFault, CalibrationModel, SettingNames, Settings};
use fem::measured::{MeasuredPairs, Table, UncertaintyError};
use fem_case::Case;
use fem_case::engineering::number;
use fem_case::parse_quantity;
use fem_case::schema::ActsOn;
use fem_report::law_figures::calibration_figure;
use serde_json::Value;

use super::calibration_text::calibration_text;
use crate::arguments::case::{CaseArguments, stem_of};
use crate::arguments::data::RestitutionArguments;
use crate::arguments::law::{parse_confidence, parse_share};
use crate::jobs::value_of;
use crate::result_folder::command_output::OutputArguments;
use crate::text::failure::Failure;
use crate::text::run_report::Detail;

/// Find a Prony series from measured restitutions
///
/// Also finds what they leave undetermined. The case gives bodies and instantaneous moduli, a CSV file the restitutions. Writes calibrate.json,
/// relaxation.toml (to paste into the case), residuals.csv and calibrate.svg, and prints each weight with
/// the range that the data allow.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions: a CSV file with the columns speed_m_s (or speed_cm_s) and restitution
    ///
    /// A column restitution_uncertainty weights them. Columns diameter_1_mm and diameter_2_mm define
    /// several pairs with one common series. The sweep.csv of a sweep over speeds and diameters has this
    /// form.
    #[arg(long, value_name = "FILE")]
    data: PathBuf,
    #[command(flatten)]
    restitutions: RestitutionArguments,
    /// Number of terms of the series
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=12))]
    terms: u8,
    /// Relaxation times of the first and the last term, with the others evenly spaced in the logarithm
    /// [default: a tenth of the shortest contact time to ten times the longest]
    #[arg(long, value_name = "FIRST..LAST", value_parser = parse_window)]
    times: Option<(f64, f64)>,
    /// The moduli that relax: all, or the shear modulus with an elastic bulk modulus [default: as in the
    /// case, or all]
    #[arg(long, value_name = "MODULI", value_parser = ["all", "shear"])]
    acts_on: Option<String>,
    /// The material to calibrate if the bodies differ; the other keeps its relaxation [default: that of a far softer body]
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    /// Strength of the regularisation: the error of a restitution that costs as much as a weight of 1; 0 for
    /// none [default: the data's uncertainty, or 0.001]
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = parse_ridge)]
    regularisation: Option<f64>,
    /// Standard uncertainty of the restitutions if the file has none
    #[arg(long, value_name = "U", allow_negative_numbers = true, value_parser = parse_share)]
    uncertainty: Option<f64>,
    /// Model that computes the collisions [default: condensed, or ting for a plate that bends]
    #[arg(long, value_name = "MODEL", value_enum)]
    model: Option<ModelName>,
    /// Fit robustly: points far from the curve count little, and are listed
    #[arg(long)]
    robust: bool,
    /// Take the measured relaxation of the case, relaxation = { file = ... }, as prior knowledge: its weights move
    /// within their uncertainties
    #[arg(long, conflicts_with_all = ["terms", "times", "acts_on", "robust"])]
    prior: bool,
    /// Confidence level of the ranges
    #[arg(long, value_name = "P", default_value_t = 0.95, allow_negative_numbers = true,
        value_parser = parse_confidence)]
    confidence: f64,
    /// Print everything: also which combinations of weights the data determine
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    output: OutputArguments,
}

/// The model that computes the restitutions.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum ModelName {
    /// Finite elements condensed to their contact
    Condensed,
    /// Ting's half-spaces with the spheres' finite size
    Ting,
}

/// Names of the options in warnings.
const OPTIONS: SettingNames = SettingNames {
    terms: "--terms",
    times: "--times",
    uncertainty: "--uncertainty",
    model: "--model",
};

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load_and_warn()?;
    let table = arguments.restitutions.read(&arguments.data)?;
    let (found, warnings) = found(arguments, &case, &table)?;
    let picture = calibration_figure(&found).map_err(CalibrationFault::Fit)?;
    let from_case = Some((&arguments.input, &case));
    let origin = arguments.restitutions.origin("calibrate", from_case, Some(&arguments.data));
    let mut output = arguments.output.claim(&stem_of(&arguments.data), "calibrate", origin)?;
    output.write("relaxation.toml", found.relaxation_toml());
    output.write_table("residuals.csv", &Calibration::RESIDUAL_COLUMNS, found.residuals());
    output.write("calibrate.svg", picture);
    let numbers = found.numbers(&arguments.input.name(), warnings.clone());
    let detail = if arguments.verbose { Detail::All } else { Detail::Short };
    output.publish(&numbers, |_| calibration_text(&found, &warnings, detail))
}

/// Calibrates to a table in memory and returns the numbers, with the table to paste into the case.
pub fn numbers(arguments: &Arguments, case: &Case, table: &Table) -> Result<Value, Failure> {
    let table = arguments.restitutions.name_columns(table.clone())?;
    let (found, warnings) = found(arguments, case, &table)?;
    let mut numbers = value_of(&found.numbers(&arguments.input.name(), warnings))?;
    numbers["relaxation_toml"] = found.relaxation_toml().into();
    Ok(numbers)
}

fn found(
    arguments: &Arguments,
    case: &Case,
    table: &Table,
) -> Result<(Calibration, Vec<String>), Failure> {
    let mut measured = MeasuredPairs::read(table, case.scene())?;
    fill_uncertainties(arguments, &mut measured)?;
    let found = Calibration::of(case, measured, &settings(arguments))?;
    let warnings = found.warnings(&OPTIONS);
    Ok((found, warnings))
}

fn settings(arguments: &Arguments) -> Settings {
    Settings {
        model: arguments.model.map(|model| match model {
            ModelName::Condensed => CalibrationModel::Condensed,
            ModelName::Ting => CalibrationModel::Ting,
        }),
        material: arguments.material.clone(),
        acts_on: arguments.acts_on.as_deref().and_then(ActsOn::from_word),
        n_terms: usize::from(arguments.terms),
        times: arguments.times,
        regularisation: arguments.regularisation,
        confidence: arguments.confidence,
        is_robust: arguments.robust,
        uses_prior: arguments.prior,
    }
}

/// Applies `--uncertainty` to a file without uncertainties.
fn fill_uncertainties(arguments: &Arguments, measured: &mut MeasuredPairs) -> Result<(), Failure> {
    let Some(uncertainty) = arguments.uncertainty else { return Ok(()) };
    measured.data.set_uncertainty(uncertainty).map_err(|error| match error {
        UncertaintyError::OutOfRange(found) => {
            Failure::bad_input(format!("--uncertainty is {}", number(found, 5)))
                .with_help("give a value greater than 0 and at most 1, the range of restitutions")
        }
        UncertaintyError::Known(_) => {
            Failure::bad_input(error.to_string()).with_help("leave --uncertainty out")
        }
    })
}

fn parse_ridge(text: &str) -> Result<f64, String> {
    let ridge = text.parse::<f64>().ok().filter(|ridge| *ridge >= 0.0 && ridge.is_finite());
    ridge.ok_or_else(|| {
        "give a value of at least 0, such as 0.001; 0 is no regularisation".to_string()
    })
}

/// Parses `10 us..1 ms`.
fn parse_window(text: &str) -> Result<(f64, f64), String> {
    let (first, last) = text.split_once("..").ok_or("write FIRST..LAST, such as '10 us..1 ms'")?;
    let time = |text: &str| match parse_quantity(text.trim()) {
        Ok((value, dimension)) if [[0; 4], [0, 0, 1, 0]].contains(&dimension.0) => Ok(value),
        Ok(_) => Err(format!("{text:?} is not a time, such as '10 us'")),
        Err(error) => Err(format!("{text:?} is not a time: {error}")),
    };
    let (first, last) = (time(first)?, time(last)?);
    if first > 0.0 && first <= last && last.is_finite() {
        Ok((first, last))
    } else {
        Err("the first time must be greater than 0 and at most the last".to_string())
    }
}
