//! The commands: one variant and one file each.

pub mod accuracy;
pub mod check;
pub mod laws;
pub mod materials;
pub mod measure;
pub mod mesh;
pub mod new;
pub mod relaxation;
pub mod report;
pub mod run;
pub mod shell;
pub mod sweep;
pub mod validate;

use clap::Subcommand;

use crate::text::failure::Failure;
use laws::{calibrate, cradle, export, fit, invert};

/// A job other than running a case.
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
    Measure(measure::Arguments),
    Relaxation(relaxation::Arguments),
    Schema(shell::SchemaArguments),
    Report(report::ReportArguments),
    Plot(report::PlotArguments),
    Completions(shell::CompletionArguments),
    Man(shell::ManArguments),
}

impl Command {
    /// Runs the command; `whole` returns the whole command line, for completions and the manual.
    pub fn execute(self, whole: fn() -> clap::Command) -> Result<(), Failure> {
        match self {
            Self::New(arguments) => new::execute(&arguments),
            Self::Check(arguments) => check::execute(&arguments),
            Self::Mesh(arguments) => mesh::execute(&arguments),
            Self::Materials(arguments) => materials::execute(&arguments),
            Self::Sweep(arguments) => sweep::execute(&arguments),
            Self::Accuracy(arguments) => accuracy::execute(&arguments),
            Self::Validate(arguments) => validate::execute(arguments),
            Self::Fit(arguments) => fit::execute(&arguments),
            Self::Calibrate(arguments) => calibrate::execute(&arguments),
            Self::Invert(arguments) => invert::execute(&arguments),
            Self::Export(arguments) => export::execute(&arguments),
            Self::Cradle(arguments) => cradle::execute(&arguments),
            Self::Measure(arguments) => measure::execute(&arguments),
            Self::Relaxation(arguments) => relaxation::execute(&arguments),
            Self::Schema(arguments) => shell::schema(&arguments),
            Self::Report(arguments) => report::report(&arguments),
            Self::Plot(arguments) => report::plot(&arguments),
            Self::Completions(arguments) => shell::complete(&arguments, whole()),
            Self::Man(arguments) => shell::man(&arguments, whole()),
        }
    }
}
