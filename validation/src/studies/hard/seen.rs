//! Faults of earlier versions, and the present results of the scenes that guard against them.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::error::StudyError;
use crate::findings::Findings;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Seen {
    class: Vec<Class>,
}

/// A class of fault.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Class {
    lie: String,
    /// Cases of it in an early version.
    seen: String,
    /// Axis, scene and model.
    #[serde(default)]
    now: Vec<[String; 3]>,
    /// Tests that hold what no scene can.
    #[serde(default)]
    held: Vec<String>,
}

/// Result of a scene with a model: restitution, differences, outcome.
pub(super) struct Now {
    pub key: [String; 3],
    pub restitution: String,
    pub outcome: String,
}

/// Adds the table, if the claim has the file.
///
/// # Errors
/// A file that is none, a scene that is not there.
pub(super) fn tabulate(
    folder: &Path,
    results: &[Now],
    is_quick: bool,
    findings: &mut Findings,
) -> Result<(), StudyError> {
    let path = folder.join("seen.toml");
    let Ok(text) = fs::read_to_string(&path) else { return Ok(()) };
    let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
    let seen: Seen = toml::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let mut rows = Vec::new();
    for class in &seen.class {
        let mut heading = [class.lie.clone(), class.seen.clone()];
        for key in &class.now {
            let [axis, scene, model] = key;
            let found = results.iter().find(|now| now.key == *key);
            let Some(found) = found else {
                // Half of the scenes are not there.
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
