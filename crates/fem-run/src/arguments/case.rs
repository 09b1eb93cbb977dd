//! A case on the command line.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;
use fem_case::{Case, CaseError};

use crate::result_folder::Origin;
use crate::text::standard_output;

const STDIN: &str = "-";

/// A case file and its overrides.
#[derive(Args, Debug)]
pub struct CaseArguments {
    /// The case file, TOML; - reads it from the standard input
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Override a key of the case by its dotted path; may be repeated
    ///
    /// The value is TOML or plain words: --set mesh.contact_element_size=28e-6, --set
    /// body.0.approach_speed='1 m/s' (arrays count from 0), --set model=ting (selects the model).
    /// Overrides apply from left to right and can add keys and tables that the file does not have.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// The tolerance of commands that compute a case.
#[derive(Args, Debug)]
pub struct ToleranceArguments {
    /// Tolerance of restitution, contact time and force, such as 0.01 or '1 %'; sets accuracy.tolerance of
    /// the case
    #[arg(long, value_name = "SHARE", value_parser = tolerance)]
    tolerance: Option<String>,
}

fn tolerance(text: &str) -> Result<String, std::convert::Infallible> {
    let value = match text.parse::<f64>() {
        Ok(share) => format!("{share:?}"),
        Err(_) => format!("{text:?}"),
    };
    Ok(format!("accuracy.tolerance={value}"))
}

impl CaseArguments {
    /// Reads the case. Mesh files of a case from the standard input are looked up in the current folder.
    pub fn load(&self) -> Result<Case, CaseError> {
        self.overridden(&self.set)
    }

    /// Reads the case and warns of implausible values, which often lack a unit; for commands that do not
    /// run the case.
    pub fn load_and_warn(&self) -> Result<Case, CaseError> {
        let case = self.load()?;
        standard_output::warn(case.scene().implausible_numbers());
        Ok(case)
    }

    /// Reads the case with another tolerance.
    pub fn load_within(&self, within: &ToleranceArguments) -> Result<Case, CaseError> {
        self.overridden(&[&self.set[..], within.tolerance.as_slice()].concat())
    }

    /// Returns the origin of a result that is computed with another tolerance.
    pub fn origin_within(
        &self,
        within: &ToleranceArguments,
        command: &str,
        made_from: String,
    ) -> Origin {
        self.origin(command, made_from).with_options(within.tolerance.as_slice())
    }

    fn overridden(&self, overrides: &[String]) -> Result<Case, CaseError> {
        let case = if self.case.as_os_str() == STDIN {
            Case::read(std::io::stdin().lock(), &self.name(), Path::new("."), overrides)?
        } else {
            Case::load(&self.case, overrides)?
        };
        case.check_units(false)?;
        Ok(case)
    }

    /// Returns the origin of a result of `command` that is made from this case and has this digest.
    pub fn origin(&self, command: &str, made_from: String) -> Origin {
        Origin::of_digest(command, made_from).with_file(&self.case).with_options(&self.set)
    }

    pub fn name(&self) -> String {
        if self.case.as_os_str() == STDIN {
            return "<stdin>".to_string();
        }
        self.case.display().to_string()
    }

    /// Returns the case file's name without extension, after which results are named.
    ///
    /// Characters that have a meaning in ParaView's collections of relative file names are replaced.
    pub fn stem(&self) -> String {
        if self.case.as_os_str() == STDIN {
            return "stdin".to_string();
        }
        stem_of(&self.case)
    }
}

/// Returns a file's name without extension, fit to name results.
pub fn stem_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    stem.replace(|c: char| c.is_control() || c == ':' || c == '\\', "_")
}

/// Parses an option that counts something.
pub fn parse_count(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "give a whole number, at least 1".to_string())
}
