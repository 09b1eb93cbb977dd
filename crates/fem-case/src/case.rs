//! A case, read from text and overrides or made in code, to a scene, and back to text.

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeTable;

use crate::error::CaseError;
use crate::library;
use crate::quantity::Quantity;
use crate::scene::Scene;
use crate::scene::body::Shape;
use crate::schema::{CaseFile, is_list};
use crate::source::document::{Document, Insertions};
use crate::source::error_recovery::{self, Repair};
use crate::source::explain::{explain, listed};
use crate::validate::validate;

/// Larger than any case, smaller than what hurts.
const LARGEST_FILE: u64 = 16 << 20;

/// A valid case: as written, as a scene, and with the positions of its keys.
#[derive(Clone, Debug)]
pub struct Case {
    file: CaseFile,
    scene: Scene,
    document: Document,
    defaults: Defaults,
}

/// Defaults for keys that a case leaves out.
#[derive(Clone, Debug)]
struct Defaults {
    title: String,
    /// Where relative mesh files are looked for; absolute.
    folder: PathBuf,
}

impl Case {
    /// Reads a case file and applies overrides (`KEY=VALUE`), left to right.
    ///
    /// # Errors
    /// Returns all errors of the file, the overrides and the case that they make:
    /// [`CaseError::others`].
    pub fn load(path: &Path, overrides: &[String]) -> Result<Case, CaseError> {
        let name = path.display().to_string();
        let text = text_at(path, &name)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let stem = path.file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().to_string());
        Case::built(&name, &stem, &text, folder, overrides)
    }

    /// As [`Case::load`], from a text; `name` stands for the file in messages and as the title,
    /// mesh files are looked for in `folder`.
    ///
    /// # Errors
    /// The errors are those of [`Case::load`].
    pub fn parse(
        name: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        let stem = Path::new(name).file_stem();
        let stem = stem.map_or(name.to_string(), |stem| stem.to_string_lossy().to_string());
        Case::built(name, &stem, text, folder, overrides)
    }

    /// As [`Case::parse`], of a text that comes from elsewhere, such as the standard input.
    ///
    /// # Errors
    /// The errors are those of [`Case::load`].
    pub fn read(
        source: impl Read,
        name: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        Case::parse(name, &text_of(source, name)?, folder, overrides)
    }

    /// A case made in code, validated as a text is.
    ///
    /// Its faults name the key: there is no line to point at. Its title is the names of its bodies
    /// unless it has one; mesh files are looked for in the current folder.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    ///
    /// ```
    /// use fem_case::schema::{BodyTable, MaterialTable};
    /// use fem_case::{Case, CaseFile};
    ///
    /// let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
    /// let pair = |diameter: f64| {
    ///     let floor = BodyTable::wall("floor");
    ///     let ball = BodyTable::sphere("ball", diameter, "ice").approaching("10 cm/s");
    ///     CaseFile::of_bodies(floor, ball).with_material("ice", ice.clone())
    /// };
    /// assert_eq!(Case::of(pair(0.02))?.scene().approach_speed(), 0.1);
    ///
    /// let error = Case::of(pair(0.0)).unwrap_err();
    /// assert_eq!(error.key(), Some("body.1.sphere.diameter"));
    /// assert_eq!(
    ///     error.to_string(),
    ///     "body.1.sphere.diameter: diameter is 0.0 m\n  help: diameter must be greater than 0"
    /// );
    /// # Ok::<(), fem_case::CaseError>(())
    /// ```
    pub fn of(mut file: CaseFile) -> Result<Case, CaseError> {
        library::fill(&mut file);
        let document = Document::of_code(&file.tree()?);
        let names: Vec<&str> = file.body.iter().map(|body| body.name.as_str()).collect();
        let defaults = Defaults { title: listed(&names), folder: absolute(Path::new(".")) };
        Case::validated(document, file, defaults)
    }

    /// The same case with some keys changed, validated anew.
    ///
    /// The change sees [`Case::file`]. Faults of what it changed name the key, those of all else
    /// still point at their line. A key that it sets to the value it had is not changed.
    ///
    /// # Errors
    /// The first thing that is wrong with the case that it makes.
    ///
    /// ```
    /// # use std::path::Path;
    /// # let text = "material.ice = { density = 917, youngs_modulus = 9.3e9, poissons_ratio = 0.33 }
    /// # [[body]]
    /// # name = 'floor'
    /// # wall = {}
    /// # [[body]]
    /// # name = 'ball'
    /// # sphere.diameter = 0.02
    /// # material = 'ice'
    /// # approach_speed = 0.1";
    /// # let case = fem_case::Case::parse("ball.toml", text, Path::new("."), &[])?;
    /// let fine = case.edited(|file| {
    ///     file.body[1].approach_speed = Some("1 m/s".into());
    ///     file.mesh.get_or_insert_default().contact_element_size = Some(14e-6.into());
    /// })?;
    /// assert_eq!(fine.scene().approach_speed(), 1.0);
    /// assert!(fine.gives("mesh.contact_element_size"));
    /// # Ok::<(), fem_case::CaseError>(())
    /// ```
    pub fn edited(&self, change: impl FnOnce(&mut CaseFile)) -> Result<Case, CaseError> {
        let mut file = self.file.clone();
        change(&mut file);
        library::fill(&mut file);
        let document = self.document.edited(&self.file.tree()?, &file.tree()?);
        Case::validated(document, file, self.defaults.clone())
    }

    /// The case of a text, or all of its faults.
    fn built(
        name: &str,
        stem: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        let read = |repairs: &[Repair]| {
            let document = Document::parse(name, text, overrides, None, repairs)?;
            Case::of_document(document, stem, folder)
        };
        read(&[]).map_err(|first| error_recovery::all(first, |repairs| read(repairs).err()))
    }

    /// The case of a text with insertions, or its first fault.
    pub(crate) fn build(
        name: &str,
        stem: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
        insertions: Insertions<'_, '_>,
    ) -> Result<Case, CaseError> {
        Case::of_document(
            Document::parse(name, text, overrides, Some(insertions), &[])?,
            stem,
            folder,
        )
    }

    /// All faults of a text with insertions, each alone; `insertions` makes them anew for each reading.
    pub(crate) fn faults_with<'i>(
        (name, text): (&str, &str),
        folder: &Path,
        overrides: &[String],
        insertions: impl Fn() -> Insertions<'i, 'i>,
    ) -> Vec<CaseError> {
        let read = |repairs: &[Repair]| {
            let document = Document::parse(name, text, overrides, Some(insertions()), repairs);
            document.and_then(|document| Case::of_document(document, name, folder)).err()
        };
        read(&[]).map_or_else(Vec::new, |first| error_recovery::all(first, read).each().collect())
    }

    fn of_document(
        (document, tree): (Document, Spanned<DeTable<'_>>),
        stem: &str,
        folder: &Path,
    ) -> Result<Case, CaseError> {
        let file = CaseFile::deserialize(toml::de::Deserializer::from(tree))
            .map_err(|error| explain(&document, &error))?;
        if let Some(path) = document.arrays().iter().find(|path| !is_list(path)) {
            let error = document.error_at(path, format!("{path} is an array"));
            return Err(error.with_help("it wants a table, { … }"));
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let defaults = Defaults { title: stem.to_string(), folder: absolute(folder) };
        Case::validated(document, file, defaults)
    }

    /// The one way from what is written to a scene.
    fn validated(
        document: Document,
        mut file: CaseFile,
        defaults: Defaults,
    ) -> Result<Case, CaseError> {
        let scene = validate(&document, &file, &defaults.title, &defaults.folder)?;
        fill_in(&mut file, &scene);
        Ok(Case { file, scene, document, defaults })
    }

    /// The case as written, overrides in it; title, approach speeds and the full paths of mesh files
    /// are filled in. What else it leaves open, a method resolves.
    pub fn file(&self) -> &CaseFile {
        &self.file
    }

    /// The case in SI units, validated.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// An error about the key at a dotted path (`mesh.contact_element_size`, `body.0.sphere`).
    ///
    /// It points at the key's value, in the file or in an override; if the case does not give
    /// the key, at the nearest table around it. Where code gave that, it names the key.
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

    /// Its keys and values.
    fn tree(&self) -> Result<toml::Table, CaseError> {
        toml::Table::try_from(self).map_err(|error| CaseError::new("the case", error.to_string()))
    }
}

fn absolute(folder: &Path) -> PathBuf {
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf())
}

/// The defaults that do not depend on physics. A path that is not Unicode stays as written.
fn fill_in(file: &mut CaseFile, scene: &Scene) {
    file.title = Some(scene.title.clone());
    for (table, body) in file.body.iter_mut().zip(&scene.bodies) {
        if let (Some(sphere), Shape::Sphere { mesh: Some(mesh), .. }) =
            (&mut table.sphere, &body.shape)
        {
            sphere.mesh = mesh.to_str().map(str::to_string).or(sphere.mesh.take());
        }
        table.approach_speed.get_or_insert(Quantity::from_si(0.0));
    }
}

/// The text of a file, which messages call `name`: what [`Case::load`] reads, for [`Case::parse`].
///
/// # Errors
/// A file that is not there or cannot be read, is too large for a case, or is no UTF-8.
pub fn text_at(path: &Path, name: &str) -> Result<String, CaseError> {
    text_of(open(path, name)?, name)
}

/// The bytes of a file that a case or a sweep names.
pub(crate) fn bytes_at(path: &Path, name: &str) -> Result<Vec<u8>, CaseError> {
    let mut bytes = Vec::new();
    let read = open(path, name)?.read_to_end(&mut bytes);
    read.map_err(|error| unreadable(name, &error))?;
    Ok(bytes)
}

fn open(path: &Path, name: &str) -> Result<fs::File, CaseError> {
    fs::File::open(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => CaseError::new(name, "there is no such file")
            .with_help("name a case file: fem-run cases/glass_0.5ms.toml"),
        _ => unreadable(name, &error),
    })
}

fn text_of(source: impl Read, name: &str) -> Result<String, CaseError> {
    let fail = |message: &str| CaseError::new(name, message);
    let mut bytes = Vec::new();
    let read = source.take(LARGEST_FILE + 1).read_to_end(&mut bytes);
    read.map_err(|error| unreadable(name, &error))?;
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

fn unreadable(name: &str, error: &std::io::Error) -> CaseError {
    match error.kind() {
        ErrorKind::IsADirectory => CaseError::new(name, "this is a folder")
            .with_help("name a case file in it, FOLDER/CASE.toml"),
        ErrorKind::PermissionDenied => CaseError::new(name, "this file may not be read"),
        _ => CaseError::new(name, format!("this file cannot be read: {error}")),
    }
}
