//! Texts that are not TOML, and keys and types that a case does not have.

use std::collections::BTreeSet;
use std::path::Path;

use fem_case::Case;

use super::marked::{VALID, fault, parse};

#[test]
fn not_toml() {
    fault("\"22.2 mm\"", "«22.2 mm»", "must be quoted", "in quotes");
    fault("[start]", "[start«»", "", "TOML");
    fault("gap = ", "gap «»", "", "TOML");
    fault("\"a pair\"", "\"a pair«»", "", "TOML");
    fault("gap = \"1 um\"", "gap = «»", "", "TOML");
}

#[test]
fn duplicated_keys() {
    fault("growth = 1.1", "growth = 1.1\n«growth» = 1.1", "duplicate key", "");
    fault("[contact]", "[«mesh»]", "duplicate key", "");
}

#[test]
fn unknown_keys() {
    fault(
        "density",
        "«densty»",
        "unknown key `densty` in material.glass",
        "did you mean `density`?",
    );
    fault("density", "«densty»", "", "youngs_modulus, shear_modulus");
    fault("title", "«titel»", "unknown key `titel`", "did you mean `title`?");
    fault("diameter", "«radius»", "unknown key `radius` in body.0.sphere", "diameter, mesh");
    fault("[start]", "[«weather»]", "unknown key `weather`", "material, body");
    fault("fem = {}", "fem = { «fast» = 1 }", "unknown key `fast` in model.fem", "{}");
    fault(
        "fem = {}",
        "«\"fem`, expected `\"» = 1",
        "unknown key `fem`, expected `` in model",
        "fem",
    );
    fault("weight = 0.5", "«wait» = 0.5", "in material.glass.relaxation.terms.0", "weight");
    fault("finite_strain", "«friction»", "unknown key `friction` in effects", "mirror_symmetry");
}

#[test]
fn missing_keys() {
    fault(
        "[material.glass]\ndensity = \"2390 kg/m^3\"",
        "«[material.glass]»",
        "the key `density` is missing in material.glass",
        "density = \"2390 kg/m^3\"",
    );
    fault(
        "{ diameter = \"22.2 mm\" }",
        "«{ }»",
        "the key `diameter` is missing in body.0.sphere",
        "diameter = \"22.2 mm\"",
    );
    fault(
        "[[body]]\nname = \"target\"",
        "«[[body]]»",
        "the key `name` is missing in body.1",
        "name = \"striker\"",
    );
    fault(
        "[[body]]\nname = \"target\"\nsphere = { diameter = \"15.9 mm\" }\nmaterial = \"glass\"",
        "«[[body]]»\nname = \"target\"\nsphere = { diameter = \"15.9 mm\" }",
        "the key `material` is missing in body.1",
        "the case has glass",
    );
    fault(
        "{ weight = 0.5, decay_rate = \"2708 1/s\" }",
        "«{ decay_rate = 1 }»",
        "the key `weight` is missing in material.glass.relaxation.terms.0",
        "weight = 1.0",
    );
}

#[test]
fn wrong_types() {
    fault(
        "\"22.2 mm\" }\nm",
        "«true» }\nm",
        "body.0.sphere.diameter is a boolean `true`",
        "a length",
    );
    fault("0.244", "«[0.244]»", "material.glass.poissons_ratio is an array", "a plain number");
    fault("\"striker\"", "«3»", "body.0.name is an integer `3`", "a string");
    fault("\"all\"", "«{ all = {} }»", "acts_on is a table", "one of the words \"all\", \"shear\"");
    fault("{ diameter = \"22.2 mm\" }", "«\"22.2 mm\"»", "body.0.sphere is a string", "diameter =");
    fault("{ diameter = \"22.2 mm\" }", "«[\"22.2 mm\"]»", "body.0.sphere is an array", "a table");
    fault("fem = {}", "fem = «[]»", "model.fem is an array", "a table");
    fault("fem = {}", "fem = «true»", "model.fem is a boolean", "an empty table");
    fault("title = \"a pair\"", "title = «2024-01-01»", "title is a date or time", "a string");
    fault("[\"mid-compression\", \"maximum\"]", "«\"maximum\"»", "snapshots is a string", "a list");
}

#[test]
fn wrong_words() {
    fault("\"all\"", "«\"sheer\"»", "acts_on is \"sheer\"", "did you mean `shear`?");
    fault("\"off\"", "«\"no\"»", "bulk_viscosity is \"no\"", "\"auto\", \"on\", \"off\"");
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
    for expected in ["neither sphere, wall nor half_space", "no material \"lib:stel\""] {
        assert!(all.contains(expected), "{all}");
    }
}
