//! Positions of faults: files that cannot be read, keys that a later check blames, and several faults at once.

use std::collections::BTreeSet;
use std::path::Path;

use fem_case::Case;

use super::message_table::{VALID, parse};

#[test]
fn unreadable_case_files_are_rejected_and_a_bom_is_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str| Case::load(&folder.path().join(name), &[]).unwrap_err();
    let error = load("none.toml");
    assert!(error.source_name().ends_with("none.toml"), "{error}");
    assert!(error.message().contains("no such file"), "{error}");
    assert_eq!((error.line(), error.span()), (None, None));
    let error = load("");
    assert!(error.message().contains("folder"), "{error}");
    std::fs::write(folder.path().join("latin.toml"), b"# caf\xc3\xa9\n# caf\xe9\n").unwrap();
    let error = load("latin.toml");
    assert!(error.message().contains("UTF-8"), "{error}");
    assert_eq!((error.line(), error.column()), (Some(2), Some(6)));
    std::fs::write(folder.path().join("bom.toml"), format!("\u{feff}{VALID}")).unwrap();
    let case = Case::load(&folder.path().join("bom.toml"), &[]).unwrap();
    assert_eq!(case.error_at("start.gap", "").line(), Some(24));
}

#[test]
fn later_faults_point_at_their_key() {
    let case = parse(VALID).unwrap();
    let error = case.error_at("mesh.contact_element_size", "too coarse").with_help("14 um");
    assert_eq!((error.line(), error.column()), (Some(27), Some(24)));
    assert!(case.gives("mesh.contact_element_size"));
    let without = VALID.replace("contact_element_size = \"14 um\"\n", "");
    let case = parse(&without).unwrap();
    let error = case.error_at("mesh.contact_element_size", "too coarse");
    assert!(!case.gives("mesh.contact_element_size"));
    assert_eq!((error.line(), error.column()), (Some(26), Some(1)));
    let error = case.error_at("nothing.at.all", "nowhere");
    assert_eq!((error.line(), error.column()), (Some(1), Some(1)));
}

/// Eight faults of five kinds, each reported once.
#[test]
fn all_faults_of_a_file_are_reported_at_once() {
    let text = VALID
        .replace("2390 kg/m^3", "2390 kg")
        .replace("poissons_ratio = 0.244", "poissons_ratio = 0.7")
        .replace("acts_on = \"all\"", "acts_on = \"bulk\"")
        .replace("name = \"target\"\n", "naem = \"target\"\n")
        .replace("15.9 mm", "15.9 furlong")
        .replace("refined_radius", "refined_raduis")
        .replace("penalty_factor = 1.0", "penalty_factor = -1.0")
        .replace("bulk_viscosity = \"off\"", "bulk_viscosity = true");
    let error = parse(&text).unwrap_err();
    let all: Vec<_> = std::iter::once(&error).chain(error.others()).collect();
    let lines: BTreeSet<_> = all.iter().map(|fault| fault.line().unwrap()).collect();
    let changed = VALID.lines().zip(text.lines()).enumerate();
    let expected: BTreeSet<_> =
        changed.filter(|(_, (old, new))| old != new).map(|(k, _)| k + 1).collect();
    assert_eq!(lines, expected, "{error}");
    assert_eq!(all.len(), 8, "{error}");
    // Each has its block, with the message of the single fault.
    for fault in &all {
        let own = fault.to_string();
        assert!(error.to_string().contains(own.lines().next().unwrap()), "{own}");
    }
    // Overrides are read as well.
    let overrides = ["mesh.growth=0.5", "body.0.approach_speed=1 kg"].map(String::from);
    let error = Case::parse("pair.toml", VALID, Path::new("."), &overrides).unwrap_err();
    let names: BTreeSet<_> =
        std::iter::once(&error).chain(error.others()).map(|fault| fault.source_name()).collect();
    let expected = ["--set body.0.approach_speed=…", "--set mesh.growth=…"];
    assert_eq!(names, BTreeSet::from(expected));
}

/// A missing shape does not hide other faults of a body.
#[test]
fn a_body_without_a_shape_reports_its_other_faults() {
    let sphere = "sphere = { diameter = \"15.9 mm\" }";
    let (before, after) = VALID.split_once(sphere).unwrap();
    let after = after.replacen("\"glass\"", "\"lib:stel\"", 1);
    let error = parse(&format!("{before}{after}")).unwrap_err();
    let all = std::iter::once(&error).chain(error.others()).map(ToString::to_string);
    let all = all.collect::<Vec<_>>().join("\n");
    for expected in ["neither sphere, wall, half_space nor plate", "no material \"lib:stel\""] {
        assert!(all.contains(expected), "{all}");
    }
}
