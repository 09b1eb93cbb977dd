//! A case on the command line.

use std::path::{Path, PathBuf};

use clap::Args;

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
