//! Jobs of the command without files and printed text, for front ends other than a shell, such as Python.
//!
//! A job takes the options of its command, so both share names, checks and messages. Case and data are
//! passed in memory; messages and results call them by their names.

use clap::{Args, CommandFactory, FromArgMatches, Parser};
use fem::measured::{Table, decode, is_of_library, library_table};
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
    /// Measured data: their name in messages, and the bytes of their file.
    pub data: Option<(String, Vec<u8>)>,
}

/// The command line of one job.
#[derive(Parser)]
struct Line<A: Args> {
    #[command(flatten)]
    arguments: A,
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
    /// Parses the options of a job after the names of its case and data.
    fn parsed<A: Args>(&self, options: &[String]) -> Result<A, Failure> {
        let command = Line::<A>::command().disable_help_flag(true);
        let has_data = command.get_arguments().any(|option| option.get_long() == Some("data"));
        let data = self.data.iter().flat_map(|(name, _)| {
            has_data.then(|| "--data".to_string()).into_iter().chain([name.clone()])
        });
        let words = self.case.iter().map(|_| self.name.clone()).chain(data);
        let words = std::iter::once("fem-run".to_string()).chain(words);
        let line = command.try_get_matches_from(words.chain(options.iter().cloned()));
        let line = line.and_then(|matches| Line::<A>::from_arg_matches(&matches));
        line.map(|line| line.arguments).map_err(|error| {
            let text = error.to_string();
            let text = text.trim_start_matches("error: ");
            let end = text.find("\n\nUsage:").or(text.find("\n\nFor more")).unwrap_or(text.len());
            Failure::bad_input(text[..end].trim_end())
        })
    }

    fn case(&self) -> Result<&Case, Failure> {
        self.case.as_ref().ok_or_else(|| Failure::bad_input("a case is missing"))
    }

    fn bytes(&self) -> &[u8] {
        self.data.as_ref().map_or(&[], |(_, bytes)| bytes)
    }

    fn table(&self) -> Result<Option<Table>, Failure> {
        let read = |(name, bytes): &(String, Vec<u8>)| match is_of_library(name) {
            true => library_table(name).map(|(table, _)| table),
            false => Table::parse(name, &decode(bytes)),
        };
        Ok(self.data.as_ref().map(read).transpose()?)
    }

    fn needed_table(&self) -> Result<Table, Failure> {
        self.table()?.ok_or_else(|| Failure::bad_input("data are missing"))
    }
}

/// Returns the numbers of a job by the name of its command, with its options: the keys of its JSON file, and the content of files that
/// others use. `calibrate` has `relaxation_toml`, the table to paste into a case, and so has `relaxation`, with `material_toml`; `export`
/// has the snippets in `texts`; `measure` and `relaxation` have the picture in `svg`; and `cradle` has one object per trial, in a list if
/// there are data.
///
/// # Errors
/// Options, data or a case that the command rejects, with its messages.
pub fn numbers_of(job: &str, input: &JobInput, options: &[String]) -> Result<Value, Failure> {
    use commands::laws::{calibrate, cradle, export, fit, invert};
    use commands::{measure, relaxation};
    match job {
        "calibrate" => {
            let arguments = input.parsed(options)?;
            calibrate::numbers(&arguments, input.case()?, &input.needed_table()?)
        }
        "cradle" => cradle::numbers(&input.parsed(options)?, input.table()?.as_ref()),
        "export" => {
            export::numbers(&input.parsed(options)?, input.case()?, input.table()?.as_ref())
        }
        "fit" => fit::numbers(&input.parsed(options)?, input.case()?, &input.needed_table()?),
        "invert" => invert::numbers(&input.parsed(options)?, input.case()?),
        "measure" => measure::numbers(&input.parsed(options)?, input.bytes()),
        "relaxation" => relaxation::numbers(&input.parsed(options)?, input.bytes()),
        _ => Err(Failure::bad_input(format!("there is no job {job}"))),
    }
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
