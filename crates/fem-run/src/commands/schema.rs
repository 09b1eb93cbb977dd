//! `fem-run schema`.

use fem_case::json_schema;
use serde_json::Value;

use crate::failure::Failure;
use crate::standard_output;

/// Print the JSON schema of case files, or of sweep files
///
/// An editor that knows TOML (Even Better TOML, Taplo, Zed, Helix) completes and checks keys by it: save
/// it as fem-run.schema.json and begin a case with the line #:schema ./fem-run.schema.json, as fem-run
/// new does. It knows keys, types, words, units and ranges; what keys have to do with each other,
/// fem-run check knows.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Of which files
    #[arg(value_enum, default_value_t = Of::Case)]
    of: Of,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Of {
    /// Case files
    Case,
    /// Sweep files
    Sweep,
}

/// Prints it.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let schema = match arguments.of {
        Of::Case => json_schema::of_cases(),
        Of::Sweep => json_schema::of_sweeps(),
    };
    standard_output::print(&text_of(&schema))
}

/// A schema as its file has it.
pub fn text_of(schema: &Value) -> String {
    format!("{schema:#}\n")
}
