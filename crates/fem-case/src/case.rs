//! A case: read from text and overrides or made in code, validated as a scene, and written as text.

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
use crate::source::changes::{Change, changes, folder_name, titled};
use crate::source::document::Document;
use crate::source::error_recovery::{KeyRepair, read_repaired};
use crate::source::explain::{explain, listed};
use crate::source::overrides;
use crate::validate::flow::read_flow_tables;
use crate::validate::relaxation::read_relaxation_files;
use crate::validate::validate;

/// The largest size of a case file, bytes: more than any case needs.
const MAX_FILE: u64 = 16 << 20;
/// Most bytes of a table, a record or a mesh.
const MAX_DATA_FILE: u64 = 1 << 30;

/// A valid case: as written, as a scene, and with the origins of its keys.
#[derive(Clone, Debug)]
pub struct Case {
    pub(crate) file: CaseFile,
    pub(crate) scene: Scene,
    pub(crate) document: Document,
    defaults: Defaults,
    changes: Vec<Change>,
}

/// Defaults for keys that a case leaves out.
#[derive(Clone, Debug)]
struct Defaults {
    title: String,
    /// The folder of relative mesh files, as an absolute path.
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

    /// Reads a case from a text, as [`Case::load`] does from a file. `name` stands for the file in messages and as the
    /// title; mesh files are relative to `folder`.
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

    /// Reads a case from a stream such as the standard input, as [`Case::parse`] does from a text.
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

    /// Validates a case that is made in code as one that is read.
    ///
    /// Its faults name the key, since there is no line to point at. Its default title is the names of its bodies; mesh
    /// files are relative to the current folder.
    ///
    /// # Errors
    /// Returns the first fault of the case.
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
        Case::validated(document, file, defaults, Vec::new())
    }

    /// Returns this case with some keys changed, validated again.
    ///
    /// The change receives [`Case::file`]. Faults of changed keys name the key; all others still point at their line.
    /// A key that is set to its old value counts as unchanged.
    ///
    /// # Errors
    /// Returns the first fault of the changed case.
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
        Case::validated(document, file, self.defaults.clone(), self.changes.clone())
    }

    /// Returns the case of a text, or all of its faults.
    fn built(
        name: &str,
        stem: &str,
        text: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        let read = |repairs: &[KeyRepair]| {
            let document = Document::parse(name, text, overrides, None, repairs)?;
            Case::of_document(document, stem, folder, overrides)
        };
        read(&[]).map_err(|first| CaseError::joined(read_repaired(read).1).unwrap_or(first))
    }

    /// Returns the case of a document, or its first fault. `overrides` are those that its title names.
    pub(crate) fn of_document(
        (document, tree): (Document, Spanned<DeTable<'_>>),
        stem: &str,
        folder: &Path,
        overrides: &[String],
    ) -> Result<Case, CaseError> {
        // Without a key to repair, this is the only fault that is reported.
        let of_sweep = |key: &&str| tree.get_ref().get_key_value(*key);
        if let Some((key, _)) = ["vary", "combine"].iter().find_map(of_sweep) {
            return Err(document
                .error_on(key.span(), "this file is a sweep, not a case")
                .labelled("a key of sweeps")
                .with_help("compute it with fem-run sweep FILE, or run the case that it names"));
        }
        let mut file = CaseFile::deserialize(toml::de::Deserializer::from(tree))
            .map_err(|error| explain(&document, &error))?;
        if let Some(path) = document.arrays().iter().find(|path| !is_list(path)) {
            let error = document.error_at(path, format!("{path} is an array"));
            return Err(error.with_help("write a table, { … }"));
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let defaults = Defaults { title: stem.to_string(), folder: absolute(folder) };
        let changes = changes(&file, overrides);
        let is_named = overrides.iter().any(|text| overrides::key_text(text) == "title");
        if !changes.is_empty() && !is_named {
            let title = file.title.as_deref().unwrap_or(stem);
            file.title = Some(titled(title, &changes));
        }
        Case::validated(document, file, defaults, changes)
    }

    /// Validates a case as written: the one path from keys to a scene.
    fn validated(
        document: Document,
        mut file: CaseFile,
        defaults: Defaults,
        changes: Vec<Change>,
    ) -> Result<Case, CaseError> {
        read_flow_tables(&document, &mut file, &defaults.folder)?;
        read_relaxation_files(&document, &mut file, &defaults.folder)?;
        let scene = validate(&document, &file, &defaults.title, &defaults.folder)?;
        fill_in(&mut file, &scene);
        Ok(Case { file, scene, document, defaults, changes })
    }

    /// Returns the case as written, with overrides. Title, approach speeds and the full paths of mesh files are filled
    /// in; the method resolves all other absent keys.
    pub fn file(&self) -> &CaseFile {
        &self.file
    }

    /// Returns the name of the default result folder: that of the case file, `stem`, and the overrides that change
    /// the scene, `glass-approach_speed=1m_s`.
    pub fn folder_name(&self, stem: &str) -> String {
        folder_name(stem, &self.changes)
    }

    /// Returns the validated case in SI units.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Creates an error about the key at a dotted path (`mesh.contact_element_size`, `body.0.sphere`).
    ///
    /// It points at the key's value, in the file or in an override, or, if the case does not give the key, at the nearest
    /// table around it. If code gave the value, the error names the key instead.
    pub fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        self.document.error_at(path, message)
    }

    /// Returns whether the case itself, not a default, gives the key at a dotted path.
    pub fn gives(&self, path: &str) -> bool {
        self.document.has(path)
    }
}

impl CaseFile {
    /// Returns this case as TOML, with numbers in SI. Reading it gives the same scene.
    ///
    /// # Errors
    /// Fails if code has set a value that TOML cannot represent; a case that was read has none.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        // By way of a table: the tables of a case are compiled for one serializer instead of three.
        toml::to_string(&toml::Table::try_from(self)?)
    }

    /// Returns the keys and values as TOML.
    fn tree(&self) -> Result<toml::Table, CaseError> {
        toml::Table::try_from(self).map_err(|error| CaseError::new("the case", error.to_string()))
    }
}

fn absolute(folder: &Path) -> PathBuf {
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_path_buf())
}

/// Fills in the defaults that do not depend on physics. A path that is not Unicode stays as written.
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

/// Reads the text of a file for [`Case::parse`]; messages call it `name`.
///
/// # Errors
/// The file does not exist, cannot be read, is too large for a case, or is not UTF-8.
pub fn text_at(path: &Path, name: &str) -> Result<String, CaseError> {
    text_of(open(path, name)?, name)
}

/// Reads the bytes of a file that a sweep names.
pub(crate) fn bytes_at(path: &Path, name: &str) -> Result<Vec<u8>, CaseError> {
    let read = read_at_most(MAX_DATA_FILE, open(path, name)?);
    read.map_err(|error| unreadable(name, &error))
}

/// Reads a file of data: a table, a record or a mesh.
///
/// # Errors
/// The file cannot be read, or has no end: it is larger than 1 GiB.
pub fn read_data_file(path: &Path) -> std::io::Result<Vec<u8>> {
    read_at_most(MAX_DATA_FILE, fs::File::open(path)?)
}

/// Reads all of a source of at most so many bytes; a device may have no end.
fn read_at_most(most: u64, source: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > most {
        true => Err(ErrorKind::FileTooLarge.into()),
        false => Ok(bytes),
    }
}

fn open(path: &Path, name: &str) -> Result<fs::File, CaseError> {
    fs::File::open(path).map_err(|error| {
        let with_extension = path.with_file_name(format!(
            "{}.toml",
            path.file_name().unwrap_or_default().to_string_lossy()
        ));
        let fault = unreadable(name, &error);
        match error.kind() == ErrorKind::NotFound && with_extension.is_file() {
            true => fault.with_help(format!("did you mean {}?", with_extension.display())),
            false => fault,
        }
    })
}

fn text_of(source: impl Read, name: &str) -> Result<String, CaseError> {
    let fail = |message: &str| CaseError::new(name, message);
    let bytes = read_at_most(MAX_FILE, source).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => fail("this file is larger than 16 MiB, the limit for a case"),
        _ => unreadable(name, &error),
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes());
        fail("this is not UTF-8 text")
            .at(&text, start..start + '\u{fffd}'.len_utf8())
            .with_help("save the case file as text in UTF-8")
    })
}

fn unreadable(name: &str, error: &std::io::Error) -> CaseError {
    match error.kind() {
        ErrorKind::NotFound => CaseError::new(name, "there is no such file")
            .with_help("give the path of a case file: fem-run cases/glass_0.5ms.toml"),
        ErrorKind::IsADirectory => CaseError::new(name, "this is a folder")
            .with_help("give the path of a case file in it, FOLDER/CASE.toml"),
        ErrorKind::PermissionDenied => CaseError::new(name, "no permission to read this file"),
        _ => CaseError::new(name, format!("this file cannot be read: {error}")),
    }
}
