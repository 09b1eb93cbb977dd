//! An axis of hard scenes as it is written.

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
    /// What is hard on it.
    pub hard: String,
    /// What all scenes are made of, relative to the claim's folder.
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
    /// What is hard in it.
    pub hard: String,
    /// Overrides, after those of the axis.
    #[serde(default)]
    pub set: Vec<String>,
    /// Mesh files of its bodies.
    #[serde(default)]
    pub imported: Vec<Imported>,
    /// What its numbers are held against.
    pub against: Option<Against>,
    /// By the model's table: `ting = {}`, `condensed = { vibration_modes = 12 }`.
    pub model: BTreeMap<String, Expected>,
}

/// What numbers are held against.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Against {
    /// Hertz' elastic half-spaces.
    Hertz,
    /// Ting's impact with the spheres' finite size.
    Ting,
    /// Another scene of the axis with the same model, in numbers without unit.
    Scene(String),
    /// A restitution of a source.
    Restitution(f64),
}

/// How a run ends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Expected {
    /// |Δe|, and the largest share of contact time and peak force that it may be off.
    pub restitution: Option<f64>,
    pub contact_time: Option<f64>,
    pub peak_force: Option<f64>,
    /// What its warnings contain.
    #[serde(default)]
    pub says: Vec<String>,
    /// Energy (of what the bodies had) that it may gain, and then has to say so; else none may.
    pub gains: Option<f64>,
    /// What the message contains with which it is refused or stopped.
    pub refuses: Option<String>,
    /// Whether it takes milliseconds.
    #[serde(default)]
    pub quick: bool,
}

impl Axis {
    /// Reads an axis.
    ///
    /// # Errors
    /// A file that is not there, or no axis.
    pub fn read(folder: &Path, name: &str) -> Result<Self, StudyError> {
        let path = folder.join(format!("{name}.toml"));
        let wrong = |error: String| StudyError::parameters(format!("{}: {error}", path.display()));
        let text = fs::read_to_string(&path).map_err(|error| wrong(error.to_string()))?;
        toml::from_str(&text).map_err(|error| wrong(error.to_string()))
    }
}
