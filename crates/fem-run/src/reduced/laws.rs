//! A law on the command line: `--law bordbar_hyppanen --param n=0.65 --end zero_overlap`.

use fem_case::parse_quantity;
use fem_fit::FitError;
use fem_laws::{EndRule, Family, Parameter, Role};

use crate::failure::Failure;

/// Which law, with which values.
#[derive(clap::Args, Clone, Debug)]
pub struct LawArguments {
    /// A parameter's value, such as a=2e-4 or a='0.2 ms'; may be repeated
    ///
    /// Bare numbers are SI. What is not given has the value of the case's model, if that names the
    /// same law. The value of a parameter that is searched for is where to begin.
    #[arg(long, value_name = "KEY=VALUE")]
    pub param: Vec<String>,
    /// When a contact is over [default: that of the case's model if it names the same law, or else
    /// zero_force]
    #[arg(long, value_name = "RULE")]
    pub end: Option<End>,
}

/// As the case file says it.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
#[value(rename_all = "snake_case")]
pub enum End {
    /// At zero force: the surfaces cannot pull
    ZeroForce,
    /// At zero overlap: the dashpot may pull until then
    ZeroOverlap,
}

impl End {
    /// For the law.
    pub fn rule(self) -> EndRule {
        match self {
            Self::ZeroForce => EndRule::ZeroForce,
            Self::ZeroOverlap => EndRule::ZeroOverlap,
        }
    }
}

/// `family` of a name.
///
/// # Errors
/// No such law.
pub fn parse_family(name: &str) -> Result<Family, String> {
    Family::from_name(name).ok_or_else(|| {
        let names: Vec<_> = Family::ALL.iter().map(|family| family.name()).collect();
        format!("the laws are {}", names.join(", "))
    })
}

/// The place of a law's parameter.
///
/// # Errors
/// No such key.
pub fn find_key(family: Family, key: &str, option: &str) -> Result<usize, Failure> {
    let keys: Vec<_> = family.parameters().iter().map(|parameter| parameter.key).collect();
    keys.iter().position(|found| *found == key.trim()).ok_or_else(|| {
        let message = format!("{option}: {} has no parameter {:?}", family.name(), key.trim());
        Failure::bad_input(message).with_help(format!("its parameters are {}", keys.join(", ")))
    })
}

/// The place of the parameter that stands for a law's loss.
///
/// # Errors
/// A law without a loss.
pub fn find_loss(family: Family) -> Result<usize, Failure> {
    family.loss_parameter().ok_or_else(|| {
        Failure::bad_input(format!("{} loses nothing: it has no parameter to find", family.name()))
            .with_help("take another law; docs/fits.md lists them")
    })
}

/// `KEY` and `VALUE`.
///
/// # Errors
/// No `=`.
pub fn split<'t>(text: &'t str, option: &str) -> Result<(&'t str, &'t str), Failure> {
    text.split_once('=').ok_or_else(|| {
        Failure::bad_input(format!("{option} {text:?}: there is no `=`"))
            .with_help(format!("write {option} KEY=VALUE, such as {option} n=0.65"))
    })
}

/// A value with or without its unit.
///
/// # Errors
/// No number, another dimension, a value without a meaning.
pub fn parse_value(parameter: &Parameter, text: &str, option: &str) -> Result<f64, Failure> {
    let Parameter { key, unit, dimension: [m, kg, s], limits, .. } = *parameter;
    let text = text.trim().trim_matches(['"', '\'']);
    let fault = |message: String| Failure::bad_input(format!("{option} {key}: {message}"));
    let (value, dimension) =
        parse_quantity(text).map_err(|error| fault(format!("{text:?}: {error}")))?;
    if dimension.0 != [0; 4] && dimension.0 != [m, kg, s, 0] {
        let unit = if unit.is_empty() { "a plain number".into() } else { format!("in {unit}") };
        return Err(fault(format!("{text:?} is of another dimension"))
            .with_help(format!("{key} is {unit}; bare numbers are SI")));
    }
    let is_allowed = value >= limits.0 && value <= limits.1 && value.is_finite();
    if !is_allowed || (parameter.role != Role::Number && value <= 0.0) {
        let allowed = match (parameter.role, limits) {
            (Role::Number, (low, high)) => format!("it must be from {low} to {high}"),
            _ => "it must be greater than 0".to_string(),
        };
        return Err(fault(format!("the value is {value:?}")).with_help(allowed));
    }
    Ok(value)
}

/// A level of confidence.
///
/// # Errors
/// None, in words.
pub fn parse_confidence(text: &str) -> Result<f64, String> {
    let level = text.parse::<f64>().ok().filter(|level| *level > 0.0 && *level < 1.0);
    level.ok_or_else(|| "it must be between 0 and 1, such as 0.95 for 95 %".to_string())
}

/// A speed, m/s.
///
/// # Errors
/// What is no positive speed.
pub fn parse_speed(text: &str) -> Result<f64, String> {
    match parse_quantity(text) {
        Ok((value, dimension)) if [[0; 4], [1, 0, -1, 0]].contains(&dimension.0) => {
            if value > 0.0 {
                Ok(value)
            } else {
                Err("a speed is greater than 0".to_string())
            }
        }
        Ok(_) => Err("this is not a speed, such as '1 cm/s'".to_string()),
        Err(error) => Err(format!("this is not a speed: {error}")),
    }
}

/// An error of fem-fit: bad input all of them, since data and options are the user's.
pub fn from_fit_error(error: FitError) -> Failure {
    let help = match &error {
        FitError::TooFewData { .. } => "free fewer parameters, or measure at more speeds",
        FitError::Degenerate { .. } => {
            "hold one of them with --param KEY=VALUE and leave it out of --free, or measure over a \
             wider range of speeds"
        }
        FitError::Insensitive { .. } => "the data show no loss, or nothing but loss",
        FitError::NotConverged { .. } => {
            "give a start with --param KEY=VALUE, or a range with --bounds KEY=LOW..HIGH"
        }
        FitError::NoSolution { .. } => "no value of this parameter makes it: take another law",
        FitError::OwnEnd { .. } => "leave --end out; zhang_whiten with another end is tsuji",
        FitError::NoRelaxation => "give a material a [material.NAME.relaxation] table",
        _ => return Failure::bad_input(error.to_string()),
    };
    Failure::bad_input(error.to_string()).with_help(help)
}
