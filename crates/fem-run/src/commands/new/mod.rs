//! `fem-run new NAME`: a case to start from.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use fem::measured::{Kind, NotMeasured, parse_measured};
use fem_case::{CASE_SCHEMA, Case, library};

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

/// Gravity for a sphere above a resting body, commented out unless the ball is dropped.
const GRAVITY: &str = include_str!("gravity.toml");

/// The schema next to the case, for editors.
const SCHEMA_FILE: &str = "fem-run.schema.json";
/// Identifies a schema of this program.
const SCHEMA_TITLE: &str = "A case of fem-run";

/// Write a commented case to start from, NAME.toml
///
/// fem-run.schema.json next to it lets editors complete and check keys. No file is overwritten.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The new case file, with or without .toml
    name: PathBuf,
    /// A material of the library, as listed by fem-run materials
    #[arg(long, value_name = "MATERIAL", default_value = "soda-lime-glass")]
    material: String,
    /// Diameter of the ball
    #[arg(long, value_name = "LENGTH", value_parser = quantity(Kind::Length), default_value = "10 mm")]
    diameter: String,
    /// Speed of the ball toward its partner
    #[arg(long, value_name = "SPEED", value_parser = quantity(Kind::Speed), default_value = "1 m/s")]
    speed: String,
    /// Height from which the ball falls, in place of a speed: writes gravity and start.gap
    #[arg(long, value_name = "LENGTH", value_parser = quantity(Kind::Length), conflicts_with = "speed")]
    drop_height: Option<String>,
    /// The partner of the ball
    #[arg(long, value_enum, default_value_t = Partner::Sphere)]
    partner: Partner,
    /// The partner's material of the library [default: that of the ball]
    #[arg(long, value_name = "MATERIAL")]
    partner_material: Option<String>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq)]
enum Partner {
    /// The target is another sphere
    Sphere,
    /// The target is a rigid plane
    Wall,
    /// The target is a half-space
    HalfSpace,
    /// The target is a plate
    Plate,
}

/// Returns a parser of quantities, which gives them as values of a case: bare numbers, or strings with their unit.
fn quantity(kind: Kind) -> impl Fn(&str) -> Result<String, NotMeasured> + Clone {
    move |text| {
        parse_measured(kind, text)?;
        Ok(if text.parse::<f64>().is_ok() { text.to_string() } else { format!("\"{text}\"") })
    }
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let path = arguments.name.with_extension_toml();
    let text = text_of(&path, arguments)?;
    // The written text is checked to be a valid case.
    Case::parse(&path.display().to_string(), &text, Path::new("."), &[])?.check_units(false)?;
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
        "{name} is written{beside}.\n\n  fem-run {word}         runs it\n  fem-run check {word}   prints cost and effects; \
         --resolved: the defaults\n"
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

/// Returns the name of a material in the library, and its table of a case with comments.
fn of_library(name: &str) -> Result<(&str, String), Failure> {
    let name = name.strip_prefix("lib:").unwrap_or(name);
    let table = materials::one(name)?;
    Ok((library::find(name).map_or(name, |(known, _)| known), table))
}

fn text_of(path: &Path, arguments: &Arguments) -> Result<String, Failure> {
    let partner = arguments.partner;
    let (material, mut table) = of_library(&arguments.material)?;
    let flow =
        if table.contains("yield_strength") { "\n".to_string() + FLOW } else { String::new() };
    let relaxation = match table.contains("relaxation") || table.contains(".flow]") {
        true => String::new(),
        false => "\n".to_string() + RELAXATION,
    };
    let mut of_partner = material;
    if let Some(other) = &arguments.partner_material {
        if partner == Partner::Wall {
            return Err(Failure::bad_input("a wall is rigid and has no material").with_help(
                "add --partner half-space, plate or sphere, or leave --partner-material out",
            ));
        }
        let (other, own) = of_library(other)?;
        if other != material {
            table += &format!("\n{own}");
        }
        of_partner = other;
    }
    let below = match partner {
        Partner::Sphere => {
            "name = \"lower\"\nsphere = { diameter = \"20 mm\" }\nmaterial = \"{of_partner}\""
        }
        Partner::Wall => {
            "name = \"floor\"\nwall = {}                              # rigid, no material"
        }
        Partner::HalfSpace => "name = \"floor\"\nhalf_space = {}\nmaterial = \"{of_partner}\"",
        Partner::Plate => {
            "name = \"plate\"\nplate = { thickness = \"5 mm\" }         # also diameter = \"20 cm\", support = \"bonded\"\n\
             material = \"{of_partner}\""
        }
    };
    let speed = format!("approach_speed = {:<21} # toward the other body\n", arguments.speed);
    let (motion, gravity) = match (&arguments.drop_height, partner) {
        (None, Partner::Sphere) => (speed, String::new()),
        (None, _) => (speed, GRAVITY.to_string()),
        (Some(_), Partner::Sphere) => {
            return Err(Failure::bad_input("a ball that is dropped needs a support")
                .with_help("add --partner wall, half-space or plate"));
        }
        (Some(height), _) => {
            let start = format!("[start]\ngap = {height:<32} # the height of the fall\n\n");
            let gravity = GRAVITY.replace("#[gravity]", "[gravity]");
            (String::new(), start + &gravity.replace("#acceleration", "acceleration"))
        }
    };
    let words = [
        ("{below}", below),
        ("{table}", table.trim_end()),
        ("{flow}", &flow),
        ("{relaxation}", &relaxation),
        ("{gravity}", &gravity),
        ("{diameter}", &arguments.diameter),
        ("{motion}", &motion),
        ("{of_partner}", of_partner),
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
