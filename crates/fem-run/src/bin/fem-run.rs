//! The `fem-run` program.

use std::env::args_os;
use std::process::ExitCode;

fn main() -> ExitCode {
    fem_command::run(args_os()).into()
}
