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

pub fn parse(text: &str) -> Result<Case, CaseError> {
    Case::parse("pair.toml", text, Path::new("."), &[])
}

/// Returns the error of `marked`, in which «» enclose the text that must be underlined.
#[track_caller]
pub fn error_at_mark(marked: &str) -> CaseError {
    let (before, rest) = marked.split_once('«').expect("a mark");
    let (culprit, after) = rest.split_once('»').expect("the mark's end");
    let text = format!("{before}{culprit}{after}");
    let error = parse(&text).expect_err("a fault");
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

/// Each line of the table replaces a part of the valid case and names the message and the help of the fault.
#[test]
fn every_fault_of_the_table_has_its_position_message_and_help() {
    let lines = include_str!("table.txt").lines();
    for line in lines.filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let line = line.replace('⏎', "\n");
        let (part, rest) = line.split_once(" => ").unwrap();
        let cells: Vec<&str> = rest.split(" | ").collect();
        assert!(VALID.contains(part), "{part}");
        let error = error_at_mark(&VALID.replacen(part, cells[0], 1));
        assert!(error.message().contains(cells.get(1).unwrap_or(&"")), "{error}");
        assert!(error.help().unwrap_or("").contains(cells.get(2).unwrap_or(&"")), "{error}");
    }
}

#[test]
fn the_valid_case_is_valid() {
    parse(VALID).unwrap();
}
