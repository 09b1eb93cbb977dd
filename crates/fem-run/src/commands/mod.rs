//! One file a job of the command line.

pub mod calibrate;
pub mod check;
pub mod completions;
pub mod cradle;
pub mod export;
pub mod fit;
pub mod invert;
pub mod mesh;
pub mod run;
pub mod sweep;
pub mod validate;

use std::time::Instant;

use crate::arguments::{Arguments, Command};
use crate::failure::Failure;

/// Does what the command line asks for; `started` is when the process began.
pub fn execute(arguments: Arguments, started: Instant) -> Result<(), Failure> {
    match (arguments.command, arguments.input) {
        (Some(Command::Check(arguments)), _) => check::execute(&arguments),
        (Some(Command::Mesh(arguments)), _) => mesh::execute(&arguments),
        (Some(Command::Sweep(arguments)), _) => sweep::execute(&arguments),
        (Some(Command::Validate(arguments)), _) => validate::execute(&arguments),
        (Some(Command::Fit(arguments)), _) => fit::execute(&arguments),
        (Some(Command::Calibrate(arguments)), _) => calibrate::execute(&arguments),
        (Some(Command::Invert(arguments)), _) => invert::execute(&arguments),
        (Some(Command::Export(arguments)), _) => export::execute(&arguments),
        (Some(Command::Cradle(arguments)), _) => cradle::execute(&arguments),
        (Some(Command::Completions(arguments)), _) => completions::execute(&arguments),
        (None, Some(input)) => run::execute(&input, &arguments.options, started),
        // clap prints its help when there are no arguments at all.
        (None, None) => Ok(()),
    }
}
