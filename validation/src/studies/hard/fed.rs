//! Hostile inputs that were fed to everything that reads, as they are counted in `fed.toml`.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::error::StudyError;
use crate::findings::Findings;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// The command that does it again.
    command: String,
    fed: Vec<Fed>,
}

/// Counts of one fuzz target.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fed {
    target: String,
    accepted: u64,
    refused: u64,
    /// Panics, hangs, too much memory, bad messages, wrong exit codes.
    findings: u64,
    /// Descriptions of the findings.
    #[serde(default)]
    what: String,
}

/// Adds the table.
pub(super) fn tabulate(folder: &Path, findings: &mut Findings) -> Result<(), StudyError> {
    let path = folder.join("fed.toml");
    let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
    let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string()))?;
    let File { command, fed } = toml::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let rows = fed.into_iter().map(|Fed { target, accepted, refused, findings, what }| {
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
