//! A claim and the cases that it runs.

use std::collections::BTreeMap;
use std::path::Component::{Normal, ParentDir};
use std::path::{Path, PathBuf};

use fem_case::{Case, CaseError};
use serde::Deserialize;

use crate::check::Check;

/// Subject of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// Closed forms, limits and convergence.
    Theory,
    /// Laws of mechanics, which hold for any scene.
    Mechanics,
    /// Comparison with other programs.
    CrossCode,
    /// Comparison with experiments.
    Measured,
    /// Comparison with the published study of two glass spheres.
    Paper,
}

impl Section {
    /// All sections in the order of the tables.
    pub const ALL: [Self; 5] =
        [Self::Theory, Self::Mechanics, Self::CrossCode, Self::Measured, Self::Paper];

    /// Returns the heading of the section.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Theory => "Against theory",
            Self::Mechanics => "Mechanics",
            Self::CrossCode => "Against other programs",
            Self::Measured => "Against measurements",
            Self::Paper => "Against Bordbar & Hyppänen (2007)",
        }
    }
}

/// A case that a study runs.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunFile {
    /// Path of the case, relative to the claim's folder.
    pub case: PathBuf,
    /// Overrides of the case, `KEY=VALUE` each.
    #[serde(default)]
    pub set: Vec<String>,
}

/// A statement about results, with the cases and the checks that test it.
#[derive(Debug, Clone)]
pub struct Claim {
    /// Name of its folder.
    pub name: String,
    /// Path of its folder.
    pub folder: PathBuf,
    /// Heading of the claim.
    pub title: String,
    /// Subject of the claim.
    pub section: Section,
    /// The statement and the reason to expect it.
    pub statement: String,
    /// Paragraphs on deviations and their causes.
    pub discussion: Vec<String>,
    /// The cases by name.
    pub runs: BTreeMap<String, RunFile>,
    /// Parameters of the study.
    pub parameters: toml::Table,
    /// Quantities with references.
    pub checks: Vec<Check>,
    /// Name of the study that measures the quantities.
    pub study: String,
}

impl Claim {
    /// Loads a case of the claim.
    pub(crate) fn load_case(&self, run: &RunFile) -> Result<Case, CaseError> {
        Case::load(&tidy(&self.folder.join(&run.case)), &run.set)
    }
}

/// Returns the path with `NAME/..` removed, without access to the disk.
fn tidy(path: &Path) -> PathBuf {
    let mut tidy = PathBuf::new();
    for part in path.components() {
        match (part, tidy.components().next_back()) {
            (ParentDir, Some(Normal(_))) => {
                tidy.pop();
            }
            _ => tidy.push(part),
        }
    }
    tidy
}
