//! The file of an axis of hard scenes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::imported::Imported;
use crate::error::StudyError;

/// Scenes from one extreme to the other.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Axis {
    /// Difficulty of the axis, in words.
    pub hard: String,
    /// Case that all scenes modify, relative to the claim's folder.
    pub case: PathBuf,
    /// Overrides of all scenes.
    #[serde(default)]
    pub set: Vec<String>,
    pub scene: Vec<Scene>,
}

/// A hard scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Scene {
    pub name: String,
    /// Difficulty of the scene, in words.
    pub hard: String,
    /// Overrides, after those of the axis.
    #[serde(default)]
    pub set: Vec<String>,
    /// Mesh files of its bodies.
    #[serde(default)]
    pub imported: Vec<Imported>,
    /// Reference of its results.
    pub against: Option<Against>,
    /// Expectations by the model's table: `ting = {}`, `condensed = { vibration_modes = 12 }`.
    pub model: BTreeMap<String, Expected>,
}

/// Reference of the results of a scene.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Against {
    /// Hertz' elastic half-spaces.
    Hertz,
    /// Ting's impact with the spheres' finite size.
    Ting,
    /// Another scene of the axis with the same model, in numbers without unit.
    Scene(String),
    /// A published restitution.
    Restitution(f64),
}

/// How a run ends.
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
    /// Reads an axis.
    pub fn read(folder: &Path, name: &str) -> Result<Self, StudyError> {
        let path = folder.join(format!("{name}.toml"));
        let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
        let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string()))?;
        toml::from_str(&text).map_err(|error| wrong(error.to_string()))
    }
}
