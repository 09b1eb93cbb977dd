//! `fem-run new NAME`: a case to start from.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use fem_case::{CASE_SCHEMA, Case};

use crate::arguments::case::stem_of;
use crate::commands::materials;
use crate::result_folder::whole_file::{folder_of, unwritten, write_new, write_whole};
use crate::text::{Failure, one_line, shown, standard_output};

/// The text of a new case; `{…}` are placeholders.
const TEMPLATE: &str = include_str!("template.toml");

/// A made-up relaxation for an elastic material, commented out.
const RELAXATION: &str = include_str!("relaxation.toml");

/// A flow rule for a material with a yield strength, commented out.
const FLOW: &str = include_str!("flow.toml");

/// Gravity for a sphere above a resting body, commented out.
const GRAVITY: &str = include_str!("gravity.toml");

/// The schema next to the case, for editors.
const SCHEMA_FILE: &str = "fem-run.schema.json";
/// Identifies a schema of this program.
const SCHEMA_TITLE: &str = "A case of fem-run";

/// Write a case to start from, NAME.toml, with comments on what can be changed
///
/// fem-run.schema.json next to it lets editors complete and check keys. No file is overwritten.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The new case file, with or without .toml
    name: PathBuf,
    /// A material of the library, as listed by fem-run materials
    #[arg(long, value_name = "MATERIAL", default_value = "soda-lime-glass")]
    material: String,
    /// The partner of the sphere
    #[arg(long, value_enum, default_value_t = Partner::Sphere)]
    partner: Partner,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq)]
enum Partner {
    /// The target is another sphere
    Sphere,
    /// A rigid plane
    Wall,
    /// A half-space of the same material
    HalfSpace,
    /// A plate of the same material
    Plate,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let path = arguments.name.with_extension_toml();
    let text = text_of(&path, &arguments.material, arguments.partner)?;
    // The written text is checked to be a valid case.
    Case::parse(&path.display().to_string(), &text, Path::new("."), &[])?;
    let schema = path.with_file_name(SCHEMA_FILE);
    let place = "name a file in a folder that exists and that you may write to";
    write_new(&path, text.as_bytes()).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Failure::bad_input(format!("{} exists", shown(&path)))
            .with_help("give the new case another name; nothing is overwritten"),
        _ => unwritten(&shown(&path), &error, place),
    })?;
    let wrote_schema = write_schema(&schema)
        .map_err(|failure| failure.with_help(format!("kept: {}", shown(&path))))?;
    if arguments.quiet {
        return Ok(());
    }
    let name = shown(&path);
    let word = shell_word(&name);
    let beside = match wrote_schema {
        true => format!(", with {SCHEMA_FILE} for your editor"),
        false => format!(" (the existing {SCHEMA_FILE} is not from fem-run and is kept)"),
    };
    standard_output::print(&format!(
        "{name} is written{beside}.\n\n  fem-run {word}         runs it\n  fem-run check {word}   prints its cost \
         and the effects that it includes, and with --resolved its defaults\n"
    ))
}

fn shell_word(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./,:+@%".contains(c);
    match name.chars().all(is_plain) {
        true => name.to_string(),
        false => format!("'{}'", name.replace('\'', r"'\''")),
    }
}

trait WithToml {
    fn with_extension_toml(&self) -> PathBuf;
}

impl WithToml for PathBuf {
    /// Appends `.toml` unless it is there: `ball_0.5ms` becomes `ball_0.5ms.toml`.
    fn with_extension_toml(&self) -> PathBuf {
        if self.extension().is_some_and(|extension| extension == "toml") {
            return self.clone();
        }
        let mut name = self.clone().into_os_string();
        name.push(".toml");
        name.into()
    }
}

fn text_of(path: &Path, material: &str, partner: Partner) -> Result<String, Failure> {
    let material = material.strip_prefix("lib:").unwrap_or(material);
    let table = materials::one(material)?;
    let flow =
        if table.contains("yield_strength") { "\n".to_string() + FLOW } else { String::new() };
    let relaxation = match table.contains("relaxation") || table.contains(".flow]") {
        true => String::new(),
        false => "\n".to_string() + RELAXATION,
    };
    let below = match partner {
        Partner::Sphere => {
            "name = \"lower\"\nsphere = { diameter = \"20 mm\" }\nmaterial = \"{material}\""
        }
        Partner::Wall => {
            "name = \"floor\"\nwall = {}                              # rigid, no material"
        }
        Partner::HalfSpace => "name = \"floor\"\nhalf_space = {}\nmaterial = \"{material}\"",
        Partner::Plate => {
            "name = \"plate\"\nplate = { thickness = \"5 mm\" }         # also diameter = \"20 cm\", support = \"bonded\"\n\
             material = \"{material}\""
        }
    };
    let gravity = if partner == Partner::Sphere { "" } else { GRAVITY };
    let words = [
        ("{below}", below),
        ("{table}", table.trim_end()),
        ("{flow}", &flow),
        ("{relaxation}", &relaxation),
        ("{gravity}", gravity),
        ("{material}", material),
        ("{file}", &one_line(&path.file_name().unwrap_or_default().to_string_lossy())),
        ("{title}", &one_line(&stem_of(path)).replace(['"', '\\'], "'")),
    ];
    Ok(words.iter().fold(TEMPLATE.to_string(), |text, (from, to)| text.replace(from, to)))
}

/// Writes the schema unless another program's file is in the way; returns whether it did.
fn write_schema(path: &Path) -> Result<bool, Failure> {
    if fs::read(path).is_ok_and(|old| !String::from_utf8_lossy(&old).contains(SCHEMA_TITLE)) {
        return Ok(false);
    }
    write_whole(path, folder_of(path), CASE_SCHEMA.as_bytes())
        .map_err(|error| unwritten(&shown(path), &error, ""))?;
    Ok(true)
}
