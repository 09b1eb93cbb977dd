//! Claims as they are written: `validation/NAME/claim.toml`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Component::{Normal, ParentDir};
use std::path::{Path, PathBuf};

use fem_case::{Case, CaseError};
use serde::Deserialize;
use serde::de::Error as _;

use crate::check::{Check, Kind, Tolerance};
use crate::error::ClaimError;
use crate::position::position;
use crate::studies::{Study, find_study, study_names};

const CLAIM_FILE: &str = "claim.toml";

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
    /// `KEY=VALUE`, as `--set` takes them.
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
    /// Measures the quantities.
    pub(crate) study: Study,
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimFile {
    title: String,
    section: Section,
    claim: String,
    study: String,
    #[serde(default)]
    discussion: String,
    #[serde(default)]
    run: BTreeMap<String, RunFile>,
    #[serde(default)]
    parameters: toml::Table,
    check: Vec<CheckFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, try_from = "RawCheck")]
struct CheckFile(Check);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCheck {
    quantity: String,
    label: String,
    #[serde(default)]
    unit: String,
    kind: Kind,
    source: String,
    reference: Option<f64>,
    relative: Option<f64>,
    absolute: Option<f64>,
    at_most: Option<f64>,
    at_least: Option<f64>,
    within: Option<[f64; 2]>,
    reason: String,
}

impl TryFrom<RawCheck> for CheckFile {
    type Error = String;

    fn try_from(raw: RawCheck) -> Result<Self, String> {
        let given = [
            raw.relative.map(Tolerance::Relative),
            raw.absolute.map(Tolerance::Absolute),
            raw.at_most.map(Tolerance::AtMost),
            raw.at_least.map(Tolerance::AtLeast),
            raw.within.map(|[from, to]| Tolerance::Within(from, to)),
        ];
        let mut given = given.into_iter().flatten();
        let (Some(tolerance), None) = (given.next(), given.next()) else {
            return Err(format!(
                "the check of `{}` needs exactly one of relative, absolute, at_most, at_least \
                 and within",
                raw.quantity
            ));
        };
        let is_distance = matches!(tolerance, Tolerance::Relative(_) | Tolerance::Absolute(_));
        if is_distance != raw.reference.is_some() {
            return Err(format!(
                "the check of `{}`: relative and absolute tolerances, and only they, need a \
                 reference",
                raw.quantity
            ));
        }
        Ok(Self(Check {
            quantity: raw.quantity,
            label: raw.label,
            unit: raw.unit,
            kind: raw.kind,
            source: raw.source,
            reference: raw.reference,
            tolerance,
            reason: raw.reason,
        }))
    }
}

/// Reads the claims of a folder, those with the given names or all, in the order in which they
/// are shown.
///
/// # Errors
/// A folder that cannot be read, a claim file that is wrong, a name that is not there.
pub fn load_claims(folder: &Path, names: &[String]) -> Result<Vec<Claim>, ClaimError> {
    let unreadable = |error| ClaimError::Unreadable { path: folder.to_path_buf(), error };
    let mut known = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.join(CLAIM_FILE).is_file() {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            known.push((name, path));
        }
    }
    known.sort();
    if let Some(name) = names.iter().find(|name| known.iter().all(|(other, _)| other != *name)) {
        let known: Vec<_> = known.into_iter().map(|(name, _)| name).collect();
        return Err(ClaimError::Unknown { name: name.clone(), known: known.join(", ") });
    }
    let wanted = known.into_iter().filter(|(name, _)| names.is_empty() || names.contains(name));
    let mut claims =
        wanted.map(|(name, folder)| read(name, folder)).collect::<Result<Vec<_>, _>>()?;
    claims.sort_by(|a, b| (a.section, &a.name).cmp(&(b.section, &b.name)));
    Ok(claims)
}

fn read(name: String, folder: PathBuf) -> Result<Claim, ClaimError> {
    let path = folder.join(CLAIM_FILE);
    let text = fs::read_to_string(&path)
        .map_err(|error| ClaimError::Unreadable { path: path.clone(), error })?;
    let invalid = |error: toml::de::Error| {
        let (line, column) = position(&text, error.span().map_or(0, |span| span.start));
        let message = error.message().to_string();
        ClaimError::Invalid { path: path.clone(), line, column, message }
    };
    let file: ClaimFile = toml::from_str(&text).map_err(invalid)?;
    let study = find_study(&file.study).ok_or_else(|| {
        let known = study_names().collect::<Vec<_>>().join(", ");
        let message = format!("there is no study `{}`; the studies are {known}", file.study);
        invalid(toml::de::Error::custom(message))
    })?;
    let paragraphs = file.discussion.split("\n\n").map(str::trim);
    let claim = Claim {
        name,
        folder,
        title: file.title,
        section: file.section,
        statement: file.claim.trim().to_string(),
        discussion: paragraphs.filter(|text| !text.is_empty()).map(String::from).collect(),
        runs: file.run,
        parameters: file.parameters,
        checks: file.check.into_iter().map(|check| check.0).collect(),
        study,
    };
    for run in claim.runs.values() {
        claim.load_case(run)?;
    }
    Ok(claim)
}
