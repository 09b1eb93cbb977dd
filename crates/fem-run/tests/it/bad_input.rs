//! Bad input: exit status 2, one message with the position, nothing written.

use crate::common::{CASE, Place};

/// Runs a case that must be rejected, and returns the message.
#[track_caller]
fn refused(place: &Place, arguments: &[&str]) -> String {
    let before = place.list(".");
    let ran = place.fails(2, arguments);
    assert_eq!(ran.stdout, "", "{arguments:?}");
    assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
    assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    assert!(!ran.stderr.contains('\u{1b}'), "colour in a pipe: {:?}", ran.stderr);
    assert_eq!(place.list("."), before, "{arguments:?}");
    ran.stderr
}

/// Returns `SOURCE:LINE:COLUMN: message` of a rejected case.
#[track_caller]
fn position(message: &str) -> (String, usize, usize) {
    let parts: Vec<&str> = message.trim_start_matches("error: ").splitn(4, ':').collect();
    let [source, line, column, _] = parts[..] else { panic!("no position: {message}") };
    let number = |text: &str| text.parse().unwrap_or_else(|_| panic!("no position: {message}"));
    (source.to_string(), number(line), number(column))
}

/// Replaces `old` by `new` in the case. The message must point at the line with `new` (or, for a deleted
/// line, into the file) and contain `expected`.
#[track_caller]
fn check(old: &str, new: &str, expected: &str) {
    assert_eq!(CASE.matches(old).count(), 1, "{old}");
    let case = CASE.replace(old, new);
    let place = Place::with(&case);
    for arguments in [&["case.toml"][..], &["check", "case.toml"], &["mesh", "case.toml"]] {
        let message = refused(&place, arguments);
        let (source, line, column) = position(&message);
        assert_eq!(source, "case.toml");
        assert!(column >= 1 && line <= case.lines().count(), "{message}");
        assert!(message.contains(expected), "{message}");
        if !new.is_empty() {
            let lines: Vec<&str> = case.lines().skip(line - 1).collect();
            let is_there = lines[0].contains(new) || new.contains(lines[0]);
            assert!(is_there, "{message}points at {:?}", lines[0]);
        }
    }
}

#[test]
fn text_that_is_no_toml_is_refused() {
    check("[mesh]", "[mesh", "case.toml:");
    check("title = \"A pair\"", "title = A pair", "case.toml:1:");
}

#[test]
fn unknown_and_missing_keys_are_refused() {
    check("poissons_ratio", "poisson_ratio", "did you mean");
    check("approach_speed", "speed", "speed");
    check("density = \"2390 kg/m^3\"\n", "", "density");
    check("sphere = { diameter = \"22.2 mm\" }\n", "", "neither sphere, wall nor half_space");
}

#[test]
fn wrong_units_and_dimensions_are_refused() {
    check("\"63 GPa\"", "\"63 Gpa\"", "GPa");
    check("\"22.2 mm\"", "\"22.2 kg\"", "mass");
    check("\"0.5 m/s\"", "\"0.5 m\"", "length");
    check("\"22.2 mm\"", "\"22,2 mm\"", "comma");
}

#[test]
fn values_out_of_range_are_refused() {
    for bad in ["\"-22.2 mm\"", "0", "nan", "inf", "-inf", "1e999"] {
        check("\"22.2 mm\"", bad, "diameter");
    }
    for bad in ["-2390", "0", "nan", "inf"] {
        check("\"2390 kg/m^3\"", bad, "density");
        check("\"63 GPa\"", bad, "youngs_modulus");
    }
    for bad in ["-1", "0.5", "-1.5", "0.7", "nan"] {
        check("poissons_ratio = 0.244", &format!("poissons_ratio = {bad}"), "poissons_ratio");
    }
    for bad in ["nan", "inf"] {
        check("\"0.5 m/s\"", bad, "approach_speed");
    }
}

#[test]
fn bad_relaxation_is_refused() {
    check("weight = 1.0", "weight = 1.1", "weight");
    check("weight = 1.0", "weight = -0.1", "weight");
    let two = "{ weight = 0.6, decay_rate = 1 }, { weight = 0.6, decay_rate = 2 }";
    check("{ weight = 1.0, decay_rate = \"2708 1/s\" }", two, "1.2");
    for bad in ["0", "-1", "nan"] {
        check("decay_rate = \"2708 1/s\"", &format!("decay_rate = {bad}"), "decay_rate");
        check("decay_rate = \"2708 1/s\"", &format!("relaxation_time = {bad}"), "relaxation_time");
    }
}

#[test]
fn other_than_two_approaching_bodies_are_refused() {
    let second = &CASE[CASE.rfind("[[body]]").unwrap()..CASE.find("[mesh]").unwrap()];
    check(second, "", "one");
    check(second, &format!("{second}{}", second.replace("target", "third")), "3");
    check("\"0.5 m/s\"", "\"0 m/s\"", "do not approach");
    check("\"0.5 m/s\"", "\"-0.5 m/s\"", "do not approach");
    check("name = \"target\"", "name = \"striker\"", "striker");
}

#[test]
fn unknown_materials_are_refused() {
    let place = Place::with(&CASE.replacen("material = \"glass\"", "material = \"glas\"", 1));
    let message = refused(&place, &["case.toml"]);
    assert_eq!(position(&message).1, 15, "{message}");
    assert!(message.contains("did you mean"), "{message}");
}

#[test]
fn too_coarse_or_expensive_meshes_are_rejected_unless_limits_allow() {
    check("\"90 um\"", "\"30 mm\"", "too large");
    check("\"90 um\"", "\"1 nm\"", "can be numbered");
    check("\"90 um\"", "\"50 nm\"", "limits.elements");
    check("\"90 um\"", "0", "contact_element_size");
    check("\"90 um\"", "-1e-6", "contact_element_size");

    let place = Place::new();
    let message = refused(&place, &["case.toml", "--set", "limits.elements=100"]);
    assert!(message.contains("at most 100"), "{message}");
    let message = refused(&place, &["case.toml", "--set", "limits.element_updates=1e5"]);
    assert!(message.contains("element updates"), "{message}");
    let message = refused(&place, &["case.toml", "--set", "limits.memory=1000"]);
    assert!(message.contains("memory"), "{message}");
    let long = ["check", "case.toml", "--set", "time.step_factor=1e-7"];
    let message = refused(&place, &long);
    assert!(message.contains("limits.element_updates"), "{message}");
    place.succeed((long, "--set limits.element_updates=1e15"));
}

#[test]
fn overrides_are_checked_like_the_file() {
    let place = Place::new();
    for (set, expected) in [
        ("mesh.size=1", "unknown key"),
        ("mesh.contact_element_size='1 kg'", "mass"),
        ("body.2.approach_speed=1", "body"),
        ("mesh.growth=", "--set"),
        ("mesh.growth=1 2", "--set"),
        ("nonsense", "--set"),
        ("material.glass.density=nan", "density"),
    ] {
        let message = refused(&place, &["case.toml", "--set", set]);
        let (source, line, _) = position(&message);
        assert!(source.starts_with("--set ") && line == 1, "{message}");
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn files_that_are_no_case_are_refused() {
    let place = Place::new();
    assert!(refused(&place, &["missing.toml"]).contains("missing.toml: there is no such file"));
    assert!(refused(&place, &["."]).contains("folder"));
    std::fs::write(place.path("binary.toml"), [0x66, 0xff, 0x00]).unwrap();
    assert!(refused(&place, &["binary.toml"]).contains("UTF-8"));
    place.write("empty.toml", "");
    assert!(refused(&place, &["empty.toml"]).contains("body"));
}

#[test]
fn meaningless_command_lines_are_rejected() {
    let place = Place::new();
    for (arguments, expected) in [
        (&["case.toml", "--threads", "0"][..], "--threads"),
        (&["case.toml", "--threads", "-1"], "--threads"),
        (&["case.toml", "--bogus"], "--bogus"),
        (&["case.toml", "case.toml"], "one case"),
        (&["chek", "case.toml"], "check"),
        (&["--quiet"], "CASE"),
        (&["case.toml", "--out", ""], "--out"),
    ] {
        let message = refused(&place, arguments);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn unwritable_output_folders_are_rejected_before_the_run() {
    let place = Place::new();
    place.write("file", "mine");
    for out in ["file", "file/below", "file/far/below", "case.toml", "/", ".", "nowhere/.."] {
        let message = refused(&place, &["case.toml", "--out", out]);
        assert!(message.contains(out) && message.contains("help:"), "{message}");
    }
    assert_eq!(place.read("file"), b"mine");
    if cfg!(target_os = "linux") {
        assert!(refused(&place, &["case.toml", "--out", "/proc/result"]).contains("/proc/result"));
        assert!(refused(&place, &["case.toml", "--out", "/proc"]).contains("/proc"));
    }
    let long = "x".repeat(240) + ".toml";
    place.write(&long, CASE);
    assert!(refused(&place, &[&long]).contains("too long"));
    // No part of a path is left behind if it cannot be created as a whole.
    refused(&place, &["case.toml", "--out", &format!("a/b/{}", "x".repeat(300))]);
    refused(&place, &[&long, "--out", "a/b/c"]);
}

/// Options of other programs: the message names the one of this program.
#[test]
fn command_line_mistakes_get_a_suggested_fix() {
    let place = Place::new();
    for (arguments, expected) in [
        (&["run", "case.toml"][..], "running a case needs no command: fem-run CASE.toml"),
        (&["case.toml", "--threads", "0"], "give a whole number, at least 1"),
        (&["case.toml", "--threads", "many"], "give a whole number, at least 1"),
        (&["invert", "case.toml", "--restitution", "92"], "92 % is --restitution 0.92"),
        (&["invert", "case.toml", "--restitution", "1"], "such as 0.92"),
    ] {
        let message = refused(&place, arguments);
        assert!(message.contains(expected), "{message}");
    }
    let sweep = "case = \"case.toml\"\n[vary]\n\"body.0.approach_speed\" = [0.1, 0.2]\n";
    let place = Place::with(sweep);
    place.fails(2, "case.toml").tells("is a sweep: fem-run sweep FILE");
    Place::new().fails(2, "sweep case.toml").tells("is a case: fem-run FILE");
}
