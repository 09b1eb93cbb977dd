//! Reads claims from their files, `validation/NAME/claim.toml`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::Error as _;

use crate::{Check, Claim, ClaimError, Kind, RunFile, Section, Tolerance, studies::find_study};

const CLAIM_FILE: &str = "claim.toml";

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
    find_study(&file.study).map_err(|message| invalid(toml::de::Error::custom(message)))?;
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
        study: file.study,
    };
    for run in claim.runs.values() {
        claim.load_case(run)?;
    }
    Ok(claim)
}

/// Returns line and column, both from 1, of a byte offset; columns count characters.
fn position(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}
