//! A case on the command line.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;
use fem_case::{Case, CaseError};

use crate::standard_output;

/// As a case: it is read from the standard input.
const STDIN: &str = "-";

/// A case file and what overrides it.
#[derive(Args, Debug)]
pub struct CaseArguments {
    /// The case file, TOML; - reads it from the standard input
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Override a key of the case by its dotted path; may be repeated
    ///
    /// The value is TOML, or words: --set mesh.contact_element_size=28e-6, --set
    /// body.0.approach_speed='1 m/s' (arrays count from 0), --set model=ting, which takes the
    /// place of another model. Overrides apply from left to right and can add keys and tables that
    /// the file leaves out.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// How far results may be off, of commands that compute a case.
#[derive(Args, Debug)]
pub struct ToleranceArguments {
    /// How far restitution, contact time and force may be off, 0.01 or '1 %': accuracy.tolerance of
    /// the case
    #[arg(long, value_name = "SHARE", value_parser = tolerance)]
    tolerance: Option<String>,
}

/// A share as an override of the case.
fn tolerance(text: &str) -> Result<String, std::convert::Infallible> {
    let value = match text.parse::<f64>() {
        Ok(share) => format!("{share:?}"),
        Err(_) => format!("{text:?}"),
    };
    Ok(format!("accuracy.tolerance={value}"))
}

impl CaseArguments {
    /// Reads the case; mesh files of one from the standard input are looked for in the current folder.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn load(&self) -> Result<Case, CaseError> {
        self.overridden(&self.set)
    }

    /// The same, with a warning of what is so odd that a unit was probably forgotten: for commands that do
    /// not run the case.
    ///
    /// # Errors
    /// As [`CaseArguments::load`].
    pub fn load_and_warn(&self) -> Result<Case, CaseError> {
        let case = self.load()?;
        standard_output::warn(case.scene().oddities());
        Ok(case)
    }

    /// The same with a tolerance of its own.
    ///
    /// # Errors
    /// As [`CaseArguments::load`].
    pub fn load_within(&self, within: &ToleranceArguments) -> Result<Case, CaseError> {
        self.overridden(&[&self.set[..], within.tolerance.as_slice()].concat())
    }

    fn overridden(&self, overrides: &[String]) -> Result<Case, CaseError> {
        if self.case.as_os_str() == STDIN {
            return Case::read(std::io::stdin().lock(), &self.name(), Path::new("."), overrides);
        }
        Case::load(&self.case, overrides)
    }

    /// What messages call it.
    pub fn name(&self) -> String {
        if self.case.as_os_str() == STDIN {
            return "<stdin>".to_string();
        }
        self.case.display().to_string()
    }

    /// The case file's name without its ending: what results are named after.
    ///
    /// ParaView's collections list relative file names with `/` between folders, so characters
    /// that mean something in one are replaced.
    pub fn stem(&self) -> String {
        if self.case.as_os_str() == STDIN {
            return "stdin".to_string();
        }
        stem_of(&self.case)
    }
}

/// A file's name without its ending, fit to name results.
pub fn stem_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    stem.replace(|c: char| c.is_control() || c == ':' || c == '\\', "_")
}

/// A number of threads or shards.
pub fn parse_count(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "it must be a whole number, at least 1".to_string())
}
