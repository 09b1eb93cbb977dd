//! The command line.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand};

use crate::commands::{
    calibrate, check, completions, cradle, export, fit, invert, mesh, run, sweep, validate,
};

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
    if error.kind() != ErrorKind::ArgumentConflict {
        error.exit()
    }
    // clap's own message takes the second of two cases for a command.
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

/// One variant and one file in `commands/` a job.
#[derive(Debug, Subcommand)]
pub enum Command {
    Check(check::Arguments),
    Mesh(mesh::Arguments),
    Sweep(sweep::Arguments),
    Validate(validate::Arguments),
    Fit(fit::Arguments),
    Calibrate(calibrate::Arguments),
    Invert(invert::Arguments),
    Export(export::Arguments),
    Cradle(cradle::Arguments),
    Completions(completions::Arguments),
}

/// A case file and what overrides it.
#[derive(Args, Debug)]
pub struct CaseArguments {
    /// The case file, TOML
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Override a key of the case by its dotted path; may be repeated
    ///
    /// The value is TOML: --set mesh.contact_element_size=28e-6, --set
    /// body.0.approach_speed='"1 m/s"' (arrays count from 0), --set model.ting={}, which takes the
    /// place of another model. Overrides apply from left to right and can add keys and tables that
    /// the file leaves out.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl CaseArguments {
    /// The case file's name without its ending: what results are named after.
    ///
    /// ParaView's collections list relative file names with `/` between folders, so characters
    /// that mean something in one are replaced.
    pub fn stem(&self) -> String {
        stem_of(&self.case)
    }
}

/// A file's name without its ending, fit to name results.
pub fn stem_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    stem.replace(|c: char| c.is_control() || c == ':' || c == '\\', "_")
}
