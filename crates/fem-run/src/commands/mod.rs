//! The jobs of the command line: one variant and one file a job.

pub mod accuracy;
pub mod calibrate;
pub mod check;
pub mod completions;
pub mod cradle;
pub mod export;
pub mod fit;
pub mod invert;
pub mod man;
pub mod materials;
pub mod mesh;
pub mod new;
pub mod plot;
pub mod report;
pub mod run;
pub mod schema;
pub mod sweep;
pub mod validate;

use clap::Subcommand;

use crate::failure::Failure;

/// Another job than to run a case.
#[derive(Debug, Subcommand)]
pub enum Command {
    New(new::Arguments),
    Check(check::Arguments),
    Mesh(mesh::Arguments),
    Materials(materials::Arguments),
    Sweep(sweep::Arguments),
    Accuracy(accuracy::Arguments),
    Validate(validate::Arguments),
    Fit(fit::Arguments),
    Calibrate(calibrate::Arguments),
    Invert(invert::Arguments),
    Export(export::Arguments),
    Cradle(cradle::Arguments),
    Schema(schema::Arguments),
    Report(report::Arguments),
    Plot(plot::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

impl Command {
    /// Does the job; `whole` makes the whole command line, which completions need.
    pub fn execute(self, whole: fn() -> clap::Command) -> Result<(), Failure> {
        match self {
            Self::New(arguments) => new::execute(&arguments),
            Self::Check(arguments) => check::execute(&arguments),
            Self::Mesh(arguments) => mesh::execute(&arguments),
            Self::Materials(arguments) => materials::execute(&arguments),
            Self::Sweep(arguments) => sweep::execute(&arguments),
            Self::Accuracy(arguments) => accuracy::execute(&arguments),
            Self::Validate(arguments) => validate::execute(&arguments),
            Self::Fit(arguments) => fit::execute(&arguments),
            Self::Calibrate(arguments) => calibrate::execute(&arguments),
            Self::Invert(arguments) => invert::execute(&arguments),
            Self::Export(arguments) => export::execute(&arguments),
            Self::Cradle(arguments) => cradle::execute(&arguments),
            Self::Schema(arguments) => schema::execute(&arguments),
            Self::Report(arguments) => report::execute(&arguments),
            Self::Plot(arguments) => plot::execute(&arguments),
            Self::Completions(arguments) => completions::execute(&arguments, whole()),
            Self::Man(arguments) => man::execute(&arguments, whole()),
        }
    }
}
