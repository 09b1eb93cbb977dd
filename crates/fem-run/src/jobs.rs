//! Jobs of the command without files and printed text, for front ends other than a shell, such as Python.
//!
//! A job takes the options of its command, so both share names, checks and messages. Case and data are
//! passed in memory; messages and results call them by their names.

use clap::{Args, CommandFactory, FromArgMatches, Parser};
use fem::measured::Table;
use fem::results::Summary;
use fem_case::Case;
use fem_collision::Collision;
use fem_laws::LawFamily;
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::{commands, text::Failure};

/// The input of a job.
#[derive(Clone, Debug, Default)]
pub struct JobInput {
    /// The case that the job starts from.
    pub case: Option<Case>,
    /// The name of the case in messages.
    pub name: String,
    /// Measured data points.
    pub table: Option<Table>,
}

/// The command line of one job.
#[derive(Parser)]
struct Line<A: Args> {
    #[command(flatten)]
    arguments: A,
}

/// Parses the options of a job after the words `before`.
fn parsed<A: Args>(job: &'static str, before: &[&str], options: &[String]) -> Result<A, Failure> {
    let words = before.iter().map(ToString::to_string).chain(options.iter().cloned());
    let words = std::iter::once(job.to_string()).chain(words);
    let line = Line::<A>::command().disable_help_flag(true).try_get_matches_from(words);
    let line = line.and_then(|matches| Line::<A>::from_arg_matches(&matches));
    line.map(|line| line.arguments).map_err(|error| {
        let text = error.to_string();
        let text = text.trim_start_matches("error: ");
        let end = text.find("\n\nUsage:").or(text.find("\n\nFor more")).unwrap_or(text.len());
        Failure::bad_input(text[..end].trim_end())
    })
}

/// Returns the options of the jobs by job and name, for front ends that declare them: whether an option is a flag, and
/// the values that it may have, or `null` if they cannot be listed.
pub fn options() -> Value {
    use commands::laws::{calibrate, cradle, export, fit, invert};
    use commands::{measure, relaxation};
    json!({
        "calibrate": options_of::<calibrate::Arguments>(),
        "cradle": options_of::<cradle::Arguments>(),
        "export": options_of::<export::Arguments>(),
        "fit": options_of::<fit::Arguments>(),
        "invert": options_of::<invert::Arguments>(),
        "measure": options_of::<measure::Arguments>(),
        "relaxation": options_of::<relaxation::Arguments>(),
    })
}

fn options_of<A: Args>() -> Value {
    let describe = |option: &clap::Arg| {
        let is_flag = !option.get_action().takes_values();
        let is_law = option.get_value_names().is_some_and(|names| *names == ["LAW"]);
        let values: Vec<String> = match is_law {
            true => LawFamily::ALL.iter().map(|family| family.name().to_string()).collect(),
            false => {
                let values = option.get_possible_values();
                values.iter().map(|value| value.get_name().to_string()).collect()
            }
        };
        let values = (!is_flag && !values.is_empty()).then_some(values);
        Some((option.get_long()?.to_string(), json!({ "flag": is_flag, "values": values })))
    };
    Line::<A>::command().get_arguments().filter_map(describe).collect::<Map<_, _>>().into()
}

/// Returns numbers as JSON.
pub(crate) fn value_of(numbers: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(numbers).map_err(|error| Failure::failed(error.to_string()))
}

impl JobInput {
    fn case(&self) -> Result<&Case, Failure> {
        self.case.as_ref().ok_or_else(|| Failure::bad_input("a case is missing"))
    }

    fn table(&self) -> Result<&Table, Failure> {
        self.table.as_ref().ok_or_else(|| Failure::bad_input("data are missing"))
    }

    /// Returns the name of the data as an option.
    fn data(&self) -> Vec<&str> {
        self.table.as_ref().map_or(Vec::new(), |table| vec!["--data", table.name()])
    }
}

/// Runs `fem-run fit`.
///
/// # Errors
/// Options, data or a case that the command rejects, with its messages.
pub fn fit(input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    let before = [&[input.name.as_str()][..], &input.data()].concat();
    commands::laws::fit::numbers(&parsed("fit", &before, options)?, input.case()?, input.table()?)
}

/// Runs `fem-run invert`.
///
/// # Errors
/// The same as those of [`fit`].
pub fn invert(input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    commands::laws::invert::numbers(&parsed("invert", &[&input.name], options)?, input.case()?)
}

/// Runs `fem-run export`; `texts` contains the snippets.
///
/// # Errors
/// The same as those of [`fit`].
pub fn export(input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    let before = [&[input.name.as_str()][..], &input.data()].concat();
    let arguments = parsed("export", &before, options)?;
    commands::laws::export::numbers(&arguments, input.case()?, input.table.as_ref())
}

/// Runs `fem-run calibrate`; `relaxation_toml` is the table to paste into a case.
///
/// # Errors
/// The same as those of [`fit`].
pub fn calibrate(input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    let before = [&[input.name.as_str()][..], &input.data()].concat();
    let arguments = parsed("calibrate", &before, options)?;
    commands::laws::calibrate::numbers(&arguments, input.case()?, input.table()?)
}

/// Runs `fem-run cradle` and returns one object per trial, in a list if there is a table.
///
/// # Errors
/// The same as those of [`fit`].
pub fn cradle(input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    let arguments = parsed("cradle", &input.data(), options)?;
    commands::laws::cradle::numbers(&arguments, input.table.as_ref())
}

/// Runs `fem-run measure` on the bytes of a record; messages refer to it by `name`. The key `svg` is the picture.
///
/// # Errors
/// Options or a record that the command rejects, with its messages.
pub fn measure(name: &str, bytes: &[u8], options: &[String]) -> Result<Value, Failure> {
    commands::measure::numbers(&parsed("measure", &[name], options)?, bytes)
}

/// Runs `fem-run relaxation` on the bytes of a table of moduli; messages refer to it by `name`. The key `svg` is the picture,
/// `relaxation_toml` and `material_toml` are the tables to paste into a case.
///
/// # Errors
/// Options or a table that the command rejects, with its messages.
pub fn relaxation(name: &str, bytes: &[u8], options: &[String]) -> Result<Value, Failure> {
    commands::relaxation::numbers(&parsed("relaxation", &[name], options)?, bytes)
}

/// Runs `fem-run check --resolved` and returns the resolved case with comments on the expected run.
///
/// # Errors
/// The model rejects the case.
pub fn check(input: &JobInput) -> Result<String, Failure> {
    commands::check::text(input.case()?.clone(), &input.name)
}

/// Returns why a collision stopped early, as `fem-run CASE` reports it; `None` if it is complete.
pub fn stopped(collision: &Collision, summary: &Summary, kept: &str) -> Option<Failure> {
    collision.stop().map(|stop| commands::run::stopped(stop, summary, kept))
}

/// Runs `fem-run materials NAME`.
///
/// # Errors
/// There is no such material.
pub fn material(name: &str) -> Result<String, Failure> {
    commands::materials::one(name)
}
