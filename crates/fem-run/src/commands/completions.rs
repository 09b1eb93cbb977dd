//! `fem-run completions SHELL`.

use clap_complete::Shell;

use crate::failure::Failure;
use crate::standard_output;

/// Print a script that completes fem-run's arguments in a shell
///
/// For bash: fem-run completions bash > ~/.local/share/bash-completion/completions/fem-run
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

/// Prints the script for a command line.
pub fn execute(arguments: &Arguments, mut command: clap::Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "fem-run", &mut script);
    standard_output::print(&String::from_utf8_lossy(&script))
}
