//! Reading a case: text and overrides to a scene, and back to text.

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::Deserialize;

use crate::document::{Document, Insertions};
use crate::error::CaseError;
use crate::explain::explain;
use crate::quantity::Quantity;
use crate::scene::{Scene, Shape};
use crate::schema::{CaseFile, is_list};
use crate::validate::validate;

/// Larger than any case, smaller than what hurts.
const LARGEST_FILE: u64 = 16 << 20;

/// A valid case: as written, as a scene, and with the positions of its keys.
#[derive(Clone, Debug)]
pub struct Case {
    /// The case as written, overrides in it; title, approach speeds and the full paths of mesh
    /// files are filled in. The plan fills in the rest and prints it as the resolved case.
    pub file: CaseFile,
    /// The same in SI units, validated.
    pub scene: Scene,
    document: Document,
}

impl Case {
    /// Reads a case file and applies `--set` overrides (`KEY=VALUE`), left to right.
    ///
    /// # Errors
    /// The first thing that is wrong with file, overrides or the case that they make.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Case, CaseError> {
        let name = path.display().to_string();
        let text = read(path, &name)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let stem = path.file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().to_string());
        Case::build(&name, &stem, &text, folder, overrides, None)
    }

    /// As [`Case::load`], from a text; `name` stands for the file in messages and as the title,
    /// mesh files are looked for in `folder`.
    ///
    /// # Errors
    /// As [`Case::load`].
    pub fn parse(
        name: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        let stem = Path::new(name).file_stem();
        let stem = stem.map_or(name.to_string(), |stem| stem.to_string_lossy().to_string());
        Case::build(name, &stem, text, folder, overrides, None)
    }

    pub(crate) fn build(
        name: &str,
        stem: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
        insertions: Option<Insertions<'_, '_>>,
    ) -> Result<Case, CaseError> {
        let (document, tree) = Document::parse(name, text, overrides, insertions)?;
        let mut file = CaseFile::deserialize(toml::de::Deserializer::from(tree))
            .map_err(|error| explain(&document, &error))?;
        if let Some(path) = document.arrays().iter().find(|path| !is_list(path)) {
            let error = document.error_at(path, format!("{path} is an array"));
            return Err(error.with_help("it wants a table, { … }"));
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf());
        let scene = validate(&document, &file, stem, &folder)?;
        fill_in(&mut file, &scene);
        Ok(Case { file, scene, document })
    }

    /// An error about the key at a dotted path (`mesh.contact_element_size`, `body.0.sphere`).
    ///
    /// It points at the key's value, in the file or in an override; if the case does not give
    /// the key, at the nearest table around it.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// Whether the case itself, not a default, gives the key at a dotted path.
    pub fn gives(&self, path: &str) -> bool {
        self.document.has(path)
    }
}

impl CaseFile {
    /// This case as TOML, numbers in SI: the same scene when it is read.
    ///
    /// # Errors
    /// None for a case that was read; a value that TOML cannot hold, put in by hand.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }
}

/// The defaults that do not depend on physics.
fn fill_in(file: &mut CaseFile, scene: &Scene) {
    file.title = Some(scene.title.clone());
    for (table, body) in file.body.iter_mut().zip(&scene.bodies) {
        if let (Some(sphere), Shape::Sphere { mesh: Some(mesh), .. }) =
            (&mut table.sphere, &body.shape)
        {
            sphere.mesh = Some(mesh.to_string_lossy().to_string());
        }
        table.approach_speed.get_or_insert(Quantity::from_si(0.0));
    }
}

pub(crate) fn read(path: &Path, name: &str) -> Result<String, CaseError> {
    let fail = |message: &str| CaseError::new(name, message);
    let failed = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => fail("there is no such file")
            .with_help("name a case file: fem-run cases/glass_0.5ms.toml"),
        ErrorKind::IsADirectory => {
            fail("this is a folder").with_help("name a case file in it, FOLDER/CASE.toml")
        }
        ErrorKind::PermissionDenied => fail("this file may not be read"),
        _ => fail(&format!("this file cannot be read: {error}")),
    };
    let file = fs::File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(fail("this file is larger than 16 MiB, too large for a case"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes());
        fail("this is not UTF-8 text")
            .at(&text, start..start + '\u{fffd}'.len_utf8())
            .with_help("a case file is a text file in UTF-8; save it as such")
    })
}
