//! A valid case, and cases with a fault at a marked position.

use std::path::Path;

use fem_case::{Case, CaseError};

pub const VALID: &str = r#"title = "a pair"

[material.glass]
density = "2390 kg/m^3"
youngs_modulus = "63 GPa"
poissons_ratio = 0.244

[material.glass.relaxation]
acts_on = "all"
terms = [{ weight = 0.5, decay_rate = "2708 1/s" }, { weight = 0.25, relaxation_time = 1e-3 }]

[[body]]
name = "striker"
sphere = { diameter = "22.2 mm" }
material = "glass"
approach_speed = "0.5 m/s"

[[body]]
name = "target"
sphere = { diameter = "15.9 mm" }
material = "glass"

[start]
gap = "1 um"

[mesh]
contact_element_size = "14 um"
refined_radius = "0.3 mm"
growth = 1.1

[contact]
penalty_factor = 1.0

[time]
step_factor = 0.9
mass_scaling = 2e-4

[output]
snapshots = ["mid-compression", "maximum"]

[model]
fem = {}

[effects]
finite_strain = "auto"
bulk_viscosity = "off"

[limits]
elements = 200000
element_updates = 1e12
memory = "8 GB"
"#;

/// A ball on a wall.
const BODIES: &str = r#"[material.glass]
density = 1
youngs_modulus = 1
poissons_ratio = 0
[[body]]
name = "striker"
sphere = { diameter = 1 }
material = "glass"
approach_speed = 1
[[body]]
name = "target"
wall = {}
"#;

/// A ball that falls on a floor.
pub const GRAVITY: &str = r#"[material.glass]
density = 2390
youngs_modulus = 63e9
poissons_ratio = 0.2
[[body]]
name = "floor"
wall = {}
[[body]]
name = "ball"
sphere = { diameter = 0.02 }
material = "glass"
approach_speed = 0.5
[start]
gap = 0.1
[gravity]
acceleration = "9.81 m/s^2"
[stop]
bounces = 3
"#;

pub fn parse(text: &str) -> Result<Case, CaseError> {
    Case::parse("pair.toml", text, Path::new("."), &[])
}

/// Returns the error of `marked`, in which «» enclose the text that must be underlined.
#[track_caller]
fn error_at_mark(marked: &str) -> CaseError {
    let (before, rest) = marked.split_once('«').expect("a mark");
    let (culprit, after) = rest.split_once('»').expect("the mark's end");
    let text = format!("{before}{culprit}{after}");
    let error = parse(&text).map(|_| ()).expect_err(marked);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
    assert_eq!((error.line(), error.column()), (Some(line), Some(column)), "{error}");
    assert_eq!(&text[error.span().unwrap()], culprit, "{error}");
    assert_eq!(error.others(), []);
    // The same case made in code has the same fault, at the same key.
    if let Some(in_code) = toml::from_str(&text).ok().and_then(|file| Case::of(file).err()) {
        assert_eq!((in_code.key(), in_code.message()), (error.key(), error.message()));
        assert_eq!((in_code.line(), Some(in_code.source_name())), (None, error.key()));
    }
    assert_eq!(error.source_name(), "pair.toml");
    assert_eq!(error.source_text(), Some(text.as_str()));
    error
}

/// Each line of the table replaces parts of a valid case and names the message and the help of the fault.
#[test]
fn every_fault_of_the_table_has_its_position_message_and_help() {
    let mut case = VALID;
    let lines = include_str!("table.txt").lines();
    for line in lines.filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(name) = line.strip_prefix("@ ") {
            case = if name == "bodies" { BODIES } else { GRAVITY };
            continue;
        }
        let row = line.replace('⏎', "\n");
        let cells: Vec<&str> = row.split(" | ").collect();
        let text = cells[0].split(" && ").fold(case.to_string(), |text, change| {
            let (part, replacement) = change.split_once(" => ").unwrap();
            assert!(text.contains(part), "{line}: {part}");
            text.replacen(part, replacement, 1)
        });
        let error = error_at_mark(&text);
        assert!(error.message().contains(cells.get(1).unwrap_or(&"")), "{line}\n{error}");
        assert!(
            error.help().unwrap_or("").contains(cells.get(2).unwrap_or(&"")),
            "{line}\n{error}"
        );
    }
}

/// The cases of the table, a moving wall, and a body that recedes more slowly than the other follows.
#[test]
fn the_valid_cases_are_valid() {
    let moving = BODIES.replace("speed = 1", "speed = -1");
    let moving = moving.replace("wall = {}", "wall = {}\napproach_speed = 2");
    for text in [VALID, BODIES, GRAVITY, &moving] {
        parse(text).unwrap();
    }
}
