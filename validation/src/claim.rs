//! What a claim is.

use std::collections::BTreeMap;
use std::path::Component::{Normal, ParentDir};
use std::path::{Path, PathBuf};

use fem_case::{Case, CaseError};
use serde::Deserialize;

use crate::check::Check;

/// What a claim is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// Closed forms, limits and convergence.
    Theory,
    /// What must hold whatever the scene.
    Mechanics,
    /// Other programs.
    CrossCode,
    /// The paper that the program began with.
    Paper,
}

impl Section {
    /// All, in the order in which they are shown.
    pub const ALL: [Self; 4] = [Self::Theory, Self::Mechanics, Self::CrossCode, Self::Paper];

    /// Its heading.
    pub fn heading(self) -> &'static str {
        match self {
            Self::Theory => "Against theory",
            Self::Mechanics => "Mechanics",
            Self::CrossCode => "Against other programs",
            Self::Paper => "Against the paper",
        }
    }
}

/// A case that a study runs.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunFile {
    /// Relative to the claim's folder.
    pub case: PathBuf,
    /// Overrides of the case, `KEY=VALUE` each.
    #[serde(default)]
    pub set: Vec<String>,
}

/// A claim.
#[derive(Debug, Clone)]
pub struct Claim {
    /// Its folder's name.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// A heading.
    pub title: String,
    /// What it is about.
    pub section: Section,
    /// What is claimed, and why one should expect it.
    pub statement: String,
    /// What to make of the result: what departs, and why. Paragraphs.
    pub discussion: Vec<String>,
    /// Cases by name.
    pub runs: BTreeMap<String, RunFile>,
    /// What the study varies.
    pub parameters: toml::Table,
    /// Quantities with references.
    pub checks: Vec<Check>,
    /// What measures the quantities: the name of one of the studies.
    pub study: String,
}

impl Claim {
    /// A case of the claim.
    ///
    /// # Errors
    /// What is wrong with the case.
    pub(crate) fn load_case(&self, run: &RunFile) -> Result<Case, CaseError> {
        Case::load(&tidy(&self.folder.join(&run.case)), &run.set)
    }
}

/// A path without `..` where that needs no look at the disk.
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
