//! `fem-run validate …`: starts the program `fem-validate`, which is built apart from the command.

use std::env::{self, consts::EXE_SUFFIX};
use std::ffi::OsString;
use std::process::Command;

use crate::text::{Failure, shown};

/// Check the program against theory, other programs and measurements
///
/// Starts the program fem-validate, which lies beside this one, with these arguments.
#[derive(clap::Args, Debug)]
#[command(disable_help_flag = true)]
pub struct Arguments {
    /// Arguments of fem-validate; --help lists them
    #[arg(value_name = "ARGUMENT", trailing_var_arg = true, allow_hyphen_values = true)]
    words: Vec<OsString>,
}

pub fn execute(arguments: Arguments) -> Result<(), Failure> {
    let beside = |error| Failure::failed(format!("the program's own place is unknown: {error}"));
    let path = env::current_exe().map_err(beside)?;
    let path = path.with_file_name(format!("fem-validate{EXE_SUFFIX}"));
    if !path.exists() {
        return Err(Failure::bad_input(format!(
            "there is no {}: make it by `cargo build --release -p fem-validate`, or put it there",
            shown(&path)
        )));
    }
    let error = replace_process(Command::new(&path).args(arguments.words));
    Err(Failure::failed(format!("{}: {error}", shown(&path))))
}

/// Runs another program in place of this one, and returns only if that does not start.
fn replace_process(command: &mut Command) -> std::io::Error {
    #[cfg(unix)]
    {
        std::os::unix::process::CommandExt::exec(command)
    }
    #[cfg(not(unix))]
    match command.status() {
        Ok(status) => std::process::exit(status.code().unwrap_or(1)),
        Err(error) => error,
    }
}
