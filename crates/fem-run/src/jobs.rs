//! What commands compute, without their files and what they print: for front doors that are not a shell, such as
//! Python's.
//!
//! The words are the options of the command, so that both have the same ones, the same checks and the same
//! messages. Case and data are given as they are in memory; in messages and results they have their names.

use clap::{Args, CommandFactory, FromArgMatches, Parser};
use fem::measured::Table;
use fem::results::Summary;
use fem_case::Case;
use fem_collision::Collision;
use serde::Serialize;
use serde_json::Value;

use crate::commands;
use crate::failure::Failure;

/// What a job is given in place of files.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// The case.
    pub case: Option<Case>,
    /// What messages call it.
    pub name: String,
    /// Measured data.
    pub table: Option<Table>,
}

/// The command line of one job.
#[derive(Parser)]
struct Line<A: Args> {
    #[command(flatten)]
    arguments: A,
}

/// The arguments that these options of a job are, behind those that `before` names.
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

/// Numbers as JSON.
pub(crate) fn value_of(numbers: &impl Serialize) -> Result<Value, Failure> {
    serde_json::to_value(numbers).map_err(|error| Failure::failed(error.to_string()))
}

impl Given {
    fn case(&self) -> Result<&Case, Failure> {
        self.case.as_ref().ok_or_else(|| Failure::bad_input("a case is missing"))
    }

    fn table(&self) -> Result<&Table, Failure> {
        self.table.as_ref().ok_or_else(|| Failure::bad_input("data are missing"))
    }

    /// The name of the data as an option.
    fn data(&self) -> Vec<&str> {
        self.table.as_ref().map_or(Vec::new(), |table| vec!["--data", table.name()])
    }
}

/// `fem-run fit`.
///
/// # Errors
/// Options, data or a case that the command refuses, in its words.
pub fn fit(given: &Given, options: &[String]) -> Result<Value, Failure> {
    let before = [&[given.name.as_str()][..], &given.data()].concat();
    commands::fit::numbers(&parsed("fit", &before, options)?, given.case()?, given.table()?)
}

/// `fem-run invert`.
///
/// # Errors
/// As [`fit`].
pub fn invert(given: &Given, options: &[String]) -> Result<Value, Failure> {
    commands::invert::numbers(&parsed("invert", &[&given.name], options)?, given.case()?)
}

/// `fem-run export`; `texts` has the snippets.
///
/// # Errors
/// As [`fit`].
pub fn export(given: &Given, options: &[String]) -> Result<Value, Failure> {
    let before = [&[given.name.as_str()][..], &given.data()].concat();
    let arguments = parsed("export", &before, options)?;
    commands::export::numbers(&arguments, given.case()?, given.table.as_ref())
}

/// `fem-run calibrate`; `relaxation_toml` is the table to paste into a case.
///
/// # Errors
/// As [`fit`].
pub fn calibrate(given: &Given, options: &[String]) -> Result<Value, Failure> {
    let before = [&[given.name.as_str()][..], &given.data()].concat();
    let arguments = parsed("calibrate", &before, options)?;
    commands::calibrate::numbers(&arguments, given.case()?, given.table()?)
}

/// `fem-run cradle`: an object a trial, a list of them where there is a table.
///
/// # Errors
/// As [`fit`].
pub fn cradle(given: &Given, options: &[String]) -> Result<Value, Failure> {
    let arguments = parsed("cradle", &given.data(), options)?;
    commands::cradle::numbers(&arguments, given.table.as_ref())
}

/// `fem-run check`: the resolved case, with comments on what to expect of a run.
///
/// # Errors
/// What the case's model refuses.
pub fn check(given: &Given) -> Result<String, Failure> {
    commands::check::text(given.case()?.clone(), &given.name)
}

/// Why a collision did not come to its end, as `fem-run CASE` says it; none where it did.
pub fn stopped(collision: &Collision, summary: &Summary, kept: &str) -> Option<Failure> {
    collision.stop().map(|stop| commands::run::stopped(stop, summary, kept))
}

/// `fem-run materials NAME`.
///
/// # Errors
/// No such material.
pub fn material(name: &str) -> Result<String, Failure> {
    commands::materials::one(name)
}
