//! A contact law on the command line: `--law bordbar_hyppanen --param n=0.65 --end zero_overlap`.

use fem::fit::cradle::Measured;
use fem::laws::{ChosenLaw, ParameterError, find_parameter, parse_value};
use fem::measured::NotMeasured;
use fem_case::{Case, nearest, parse_quantity};
use fem_laws::{EndRule, LawFamily};

use crate::text::failure::Failure;

/// Parameters of a law.
#[derive(clap::Args, Clone, Debug)]
pub struct LawArguments {
    /// A parameter's value, such as a=2e-4 or a='0.2 ms'; may be repeated
    ///
    /// Bare numbers are SI. Parameters that are not given are taken from the case's model if that names the
    /// same law. For a parameter that is fitted, the value is the start.
    #[arg(long, value_name = "KEY=VALUE")]
    pub param: Vec<String>,
    /// When a contact ends [default: as in the case's model if it names the same law, else zero_force]
    #[arg(long, value_name = "RULE")]
    pub end: Option<End>,
}

/// The end of contact, spelled as in a case file.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
#[value(rename_all = "snake_case")]
pub enum End {
    /// At zero force: the surfaces cannot pull
    ZeroForce,
    /// At zero overlap: until then the dashpot may pull
    ZeroOverlap,
}

impl End {
    pub fn rule(self) -> EndRule {
        match self {
            Self::ZeroForce => EndRule::ZeroForce,
            Self::ZeroOverlap => EndRule::ZeroOverlap,
        }
    }
}

impl LawArguments {
    /// Returns the law with the parameters of the options, and else those of the case if it has the same
    /// law.
    pub fn choose(&self, case: &Case, family: LawFamily) -> Result<ChosenLaw, Failure> {
        let parse = |text: &String| {
            let (key, value) = split(text, "--param")?;
            let parameter = &family.parameters()[find_key(family, key, "--param")?];
            let value = parse_value(parameter, value).map_err(of_value("--param"))?;
            Ok((parameter.key, value))
        };
        let given: Vec<(&str, f64)> =
            self.param.iter().map(parse).collect::<Result<_, Failure>>()?;
        Ok(ChosenLaw::of(case, family, &given, self.end.map(End::rule))?)
    }
}

pub fn parse_family(name: &str) -> Result<LawFamily, String> {
    LawFamily::from_name(name).ok_or_else(|| {
        let names: Vec<_> = LawFamily::ALL.iter().map(|family| family.name()).collect();
        let near = nearest(name, &names, 0.8);
        let asked = near.map_or(String::new(), |law| format!("did you mean {law}? "));
        format!("{asked}the laws are {}", names.join(", "))
    })
}

pub fn find_key(family: LawFamily, key: &str, option: &str) -> Result<usize, Failure> {
    find_parameter(family, key).map_err(|error| {
        Failure::bad_input(format!("{option}: {error}")).with_help_if(error.help())
    })
}

/// Turns the error of a value into a failure that names its option.
pub fn of_value(option: &str) -> impl Fn(ParameterError) -> Failure {
    move |error| Failure::bad_input(format!("{option} {error}")).with_help_if(error.help())
}

/// Splits `KEY=VALUE` at its first `=`.
pub fn split<'t>(text: &'t str, option: &str) -> Result<(&'t str, &'t str), Failure> {
    text.split_once('=').ok_or_else(|| {
        Failure::bad_input(format!("{option} {text:?}: there is no `=`"))
            .with_help(format!("write {option} KEY=VALUE, such as {option} n=0.65"))
    })
}

pub fn parse_confidence(text: &str) -> Result<f64, String> {
    let level = parse_share(text).ok().filter(|level| *level > 0.0 && *level < 1.0);
    level.ok_or_else(|| "give a level between 0 and 1, such as 0.95 for 95 %".to_string())
}

/// Parses a number without a unit, `0.9` or `90 %`.
pub fn parse_share(text: &str) -> Result<f64, String> {
    match parse_quantity(text) {
        Ok((value, dimension)) if dimension.0 == [0; 4] => Ok(value),
        _ => Err("this is not a number, such as 0.9 or '90 %'".to_string()),
    }
}

/// Parses a number with or without an uncertainty, `0.92 ± 0.01` or `92 % ± 1 %`.
pub fn parse_measured_share(text: &str) -> Result<Measured, String> {
    let parts = ["±", "+/-", "+-"].iter().find_map(|sign| text.split_once(sign));
    let Some((value, uncertainty)) = parts else { return parse_share(text).map(Measured::exact) };
    let (value, uncertainty) = (parse_share(value.trim())?, parse_share(uncertainty.trim())?);
    match uncertainty >= 0.0 && uncertainty.is_finite() {
        true => Ok(Measured { value, uncertainty }),
        false => Err(NotMeasured::NegativeUncertainty.to_string()),
    }
}

/// Parses a speed, m/s.
pub fn parse_speed(text: &str) -> Result<f64, String> {
    positive(text, "speed", "1 cm/s", [1, 0, -1, 0])
}

/// Parses a length, m.
pub fn parse_length(text: &str) -> Result<f64, String> {
    positive(text, "length", "2 mm", [1, 0, 0, 0])
}

fn positive(text: &str, what: &str, example: &str, wanted: [i32; 4]) -> Result<f64, String> {
    match parse_quantity(text) {
        Ok((value, dimension)) if [[0; 4], wanted].contains(&dimension.0) => {
            if value > 0.0 {
                Ok(value)
            } else {
                Err(format!("a {what} must be greater than 0"))
            }
        }
        Ok(_) => Err(format!("this is not a {what}, such as '{example}'")),
        Err(error) => Err(format!("this is not a {what}: {error}")),
    }
}
