//! Tables from files beside the claim: faults of earlier versions with the present results of the scenes that guard
//! against them (`seen.toml`), and counts of hostile inputs (`fed.toml`).

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::error::StudyError;
use crate::findings::Findings;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EarlierFaults {
    class: Vec<FaultClass>,
}

/// A class of fault.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FaultClass {
    lie: String,
    /// Cases of it in an early version.
    seen: String,
    /// Axis, scene and model.
    #[serde(default)]
    now: Vec<[String; 3]>,
    /// Tests of faults that no scene shows.
    #[serde(default)]
    held: Vec<String>,
}

/// Result of a scene with a model: restitution, differences, outcome.
pub(super) struct SceneResult {
    pub key: [String; 3],
    pub restitution: String,
    pub outcome: String,
}

/// Adds the table of earlier faults, if the claim has `seen.toml`.
///
/// # Errors
/// The file is invalid, or names a scene that does not exist.
pub(super) fn tabulate_earlier_faults(
    folder: &Path,
    results: &[SceneResult],
    is_quick: bool,
    findings: &mut Findings,
) -> Result<(), StudyError> {
    let path = folder.join("seen.toml");
    let Ok(text) = fs::read_to_string(&path) else { return Ok(()) };
    let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
    let seen: EarlierFaults = toml::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let mut rows = Vec::new();
    for class in &seen.class {
        let mut heading = [class.lie.clone(), class.seen.clone()];
        for key in &class.now {
            let [axis, scene, model] = key;
            let found = results.iter().find(|now| now.key == *key);
            let Some(found) = found else {
                // A quick study has only some of the scenes.
                if is_quick {
                    continue;
                }
                return Err(wrong(format!("there is no scene `{scene}` of {axis} with {model}")));
            };
            let [lie, seen] = std::mem::take(&mut heading);
            let scene = format!("{axis}: {scene}");
            let (e, outcome) = (found.restitution.clone(), found.outcome.clone());
            rows.push([lie, seen, scene, model.clone(), e, outcome]);
        }
        if !class.held.is_empty() {
            let [lie, seen] = heading;
            let tests: Vec<String> = class.held.iter().map(|test| format!("`{test}`")).collect();
            let none = String::new;
            rows.push([lie, seen, "tests".into(), none(), none(), tests.join(" ")]);
        }
    }
    findings.tabulate(
        "What an early version got wrong without a word, and what it does now.",
        ["fault", "seen then", "held now by", "model", "e", "outcome"],
        rows,
    );
    Ok(())
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FuzzFile {
    /// The command that repeats it.
    command: String,
    fed: Vec<FuzzTarget>,
}

/// Counts of one fuzz target.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FuzzTarget {
    target: String,
    accepted: u64,
    refused: u64,
    /// Panics, hangs, too much memory, bad messages, wrong exit codes.
    findings: u64,
    /// Descriptions of the findings.
    #[serde(default)]
    what: String,
}

/// Adds the table of hostile inputs.
///
/// # Errors
/// `fed.toml` is missing or invalid.
pub(super) fn tabulate_hostile_inputs(
    folder: &Path,
    findings: &mut Findings,
) -> Result<(), StudyError> {
    let path = folder.join("fed.toml");
    let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
    let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string()))?;
    let FuzzFile { command, fed } =
        toml::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let rows = fed.into_iter().map(|FuzzTarget { target, accepted, refused, findings, what }| {
        [target, accepted.to_string(), refused.to_string(), findings.to_string(), what]
    });
    findings.tabulate(
        format!(
            "Hostile inputs, by {command}: none may panic, hang or take more than it is given."
        ),
        ["what reads", "accepted", "refused with a message", "findings", ""],
        rows,
    );
    Ok(())
}
