//! `fem-run schema`: the JSON schema of case and sweep files.

use fem_case::{CASE_SCHEMA, SWEEP_SCHEMA};

use crate::text::{Failure, standard_output};

/// Print the JSON schema of case files or of sweep files
///
/// Editors with TOML support (Even Better TOML, Taplo, Zed, Helix) use it to complete and check keys: save
/// it as fem-run.schema.json and begin a case with the line #:schema ./fem-run.schema.json, as fem-run new
/// does. The schema covers keys, types, words, units and ranges; fem-run check also checks how keys depend
/// on each other.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The kind of file
    #[arg(value_enum, default_value_t = Of::Case)]
    of: Of,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Of {
    /// Schema of case files
    Case,
    /// Schema of sweep files
    Sweep,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    standard_output::print(match arguments.of {
        Of::Case => CASE_SCHEMA,
        Of::Sweep => SWEEP_SCHEMA,
    })
}
