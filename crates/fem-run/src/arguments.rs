//! The command line.

use std::time::Instant;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};

use crate::case_arguments::CaseArguments;
use crate::commands::{Command, run};
use crate::failure::Failure;

/// Computes the collision of two viscoelastic spheres, or of a sphere and a rigid wall.
///
/// Prints the result beside Hertz' closed form and writes summary.json, history.csv and ParaView
/// files into a folder.
#[derive(Debug, Parser)]
#[command(
    name = "fem-run",
    version,
    args_conflicts_with_subcommands = true,
    arg_required_else_help = true,
    override_usage = "fem-run [OPTIONS] CASE.toml\n       fem-run <COMMAND> …",
    after_help = AFTER_HELP
)]
pub struct Arguments {
    /// Another job than to run a case.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The case to run.
    #[command(flatten)]
    pub input: Option<CaseArguments>,
    /// How to run it.
    #[command(flatten)]
    pub options: run::Options,
}

const AFTER_HELP: &str = "\
Exit status: 0 done; 1 the run failed, what was computed is kept and marked incomplete; 2 bad \
input, nothing written; 130 interrupted, kept and marked (a second Ctrl-C kills at once).
A case file that is named like a command runs as ./check.

Examples:
  fem-run cases/glass_0.5ms.toml
  fem-run cases/glass_0.5ms.toml --set body.0.approach_speed='\"1 m/s\"' --out runs/glass_1ms
  fem-run check cases/glass_0.5ms.toml";

/// Reads the command line; prints help, version or what is wrong with it, and exits.
pub fn parse() -> Arguments {
    let error = match Arguments::try_parse() {
        Ok(arguments) => return arguments,
        Err(error) => error,
    };
    // clap's own message takes the second of two cases for a command.
    let is_of_commands = error.to_string().contains("the subcommand");
    if error.kind() != ErrorKind::ArgumentConflict || !is_of_commands {
        error.exit()
    }
    let mut command = Arguments::command();
    let names: Vec<&str> = command.get_subcommands().map(|command| command.get_name()).collect();
    let names = names.join(", ");
    command
        .error(
            error.kind(),
            format!(
                "one case at a time, and a command comes before everything else; the commands \
                 are {names}"
            ),
        )
        .exit()
}

impl Arguments {
    /// Does what is asked for; `started` is when the process began.
    pub fn execute(self, started: Instant) -> Result<(), Failure> {
        match (self.command, self.input) {
            (Some(command), _) => command.execute(Self::command),
            (None, Some(input)) => run::execute(&input, &self.options, started),
            // clap prints its help when there are no arguments at all.
            (None, None) => Ok(()),
        }
    }
}
