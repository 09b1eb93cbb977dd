//! The file of an axis of hard scenes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::imported::Imported;
use crate::error::StudyError;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Axis {
    /// Difficulty of the axis, in words.
    pub hard: String,
    /// Case that all scenes modify, relative to the claim's folder.
    pub case: PathBuf,
    #[serde(default)]
    pub set: Vec<String>,
    pub scene: Vec<Scene>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Scene {
    pub name: String,
    pub hard: String,
    #[serde(default)]
    pub set: Vec<String>,
    #[serde(default)]
    pub imported: Vec<Imported>,
    pub against: Option<Against>,
    /// Expectations by the model's table: `ting = {}`, `condensed = { vibration_modes = 12 }`.
    pub model: BTreeMap<String, Expected>,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Against {
    Hertz,
    Ting,
    /// Another scene of the axis with the same model, in numbers without unit.
    Scene(String),
    Restitution(f64),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Expected {
    /// Allowed differences: |Δe|, and relative ones of contact time and peak force.
    pub restitution: Option<f64>,
    pub contact_time: Option<f64>,
    pub peak_force: Option<f64>,
    /// Texts that its warnings must contain.
    #[serde(default)]
    pub says: Vec<String>,
    /// Allowed relative gain of energy, of which the run must warn; `None` allows no gain.
    pub gains: Option<f64>,
    /// Text that the message of its rejection or stop must contain.
    pub refuses: Option<String>,
    /// Whether it takes only milliseconds.
    #[serde(default)]
    pub quick: bool,
}

impl Axis {
    pub fn read(folder: &Path, name: &str) -> Result<Self, StudyError> {
        let path = folder.join(format!("{name}.toml"));
        let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
        let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string()))?;
        toml::from_str(&text).map_err(|error| wrong(error.to_string()))
    }
}
