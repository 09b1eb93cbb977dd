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

/// One fault of each class for every command that reads a case; the table of faults in crate fem-case has them all.
#[test]
fn invalid_cases_are_rejected_with_their_position() {
    let second = &CASE[CASE.rfind("[[body]]").unwrap()..CASE.find("[mesh]").unwrap()];
    let third = format!("{second}{}", second.replace("target", "third"));
    for (old, new, expected) in [
        ("title = \"A pair\"", "title = A pair", "case.toml:1:"),
        ("poissons_ratio", "poisson_ratio", "did you mean"),
        ("density = \"2390 kg/m^3\"\n", "", "density"),
        ("sphere = { diameter = \"22.2 mm\" }\n", "", "neither sphere, wall, half_space nor plate"),
        ("\"22.2 mm\"", "\"22,2 mm\"", "comma"),
        ("\"22.2 mm\"", "1e999", "diameter"),
        ("weight = 1.0", "weight = 1.1", "weight"),
        (second, &third, "3"),
        ("\"0.5 m/s\"", "\"-0.5 m/s\"", "do not approach"),
    ] {
        check(old, new, expected);
    }
}

#[test]
fn too_coarse_or_expensive_meshes_are_rejected_unless_limits_allow() {
    check("\"90 um\"", "\"30 mm\"", "too large");
    check("\"90 um\"", "\"1 nm\"", "can be numbered");
    check("\"90 um\"", "\"50 nm\"", "limits.elements");
    let place = Place::new();
    for (limit, expected) in [
        ("limits.elements=100", "at most 100"),
        ("limits.element_updates=1e5", "element updates"),
        ("limits.memory=1000", "memory"),
    ] {
        let message = refused(&place, &["case.toml", "--set", limit]);
        assert!(message.contains(expected), "{message}");
    }
    let long = ["check", "case.toml", "--set", "time.step_factor=1e-7"];
    let message = refused(&place, &long);
    assert!(message.contains("limits.element_updates"), "{message}");
    place.succeed((long, "--set limits.element_updates=1e15"));
}

/// The tests of overrides in crate fem-case have all faults.
#[test]
fn overrides_are_checked_like_the_file() {
    let place = Place::new();
    for (set, expected) in [("mesh.size=1", "unknown key"), ("nonsense", "--set")] {
        let message = refused(&place, &["case.toml", "--set", set]);
        let (source, line, _) = position(&message);
        assert!(source.starts_with("--set ") && line == 1, "{message}");
        assert!(message.contains(expected), "{message}");
    }
}

/// Files that are no case, and command lines that mean nothing; the message says what to write instead.
#[test]
fn meaningless_files_and_command_lines_are_rejected() {
    let place = Place::new();
    std::fs::write(place.path("binary.toml"), [0x66, 0xff, 0x00]).unwrap();
    place.write("empty.toml", "");
    place.write(
        "sweep.toml",
        "case = \"case.toml\"\n[vary]\n\"body.0.approach_speed\" = [0.1, 0.2]\n",
    );
    for (arguments, expected) in [
        (&["missing.toml"][..], "missing.toml: there is no such file"),
        (&["."], "folder"),
        (&["binary.toml"], "UTF-8"),
        (&["empty.toml"], "body"),
        (&["sweep.toml"], "this file is a sweep, not a case"),
        (&["check", "sweep.toml"], "compute it with fem-run sweep FILE"),
        (&["case.toml", "--threads", "-1"], "--threads"),
        (&["case.toml", "--threads", "0"], "give a whole number, at least 1"),
        (&["case.toml", "--threads", "many"], "give a whole number, at least 1"),
        (&["case.toml", "--bogus"], "--bogus"),
        (&["case.toml", "case.toml"], "one case"),
        (&["chek", "case.toml"], "did you mean check?"),
        (&["nwe"], "did you mean fem-run new?"),
        (&["swep", "sweep.toml"], "did you mean sweep?"),
        (&["mateirals"], "did you mean fem-run materials?"),
        (&["help", "exprt"], "did you mean export?"),
        // These words are meant as files.
        (&["mesh.toml"], "there is no such file"),
        (&["glass"], "there is no such file"),
        (&["case"], "did you mean case.toml?"),
        (&["--quiet"], "CASE"),
        (&["case.toml", "--out", ""], "--out"),
        (&["run", "case.toml"], "run is not a command: run a case with fem-run CASE.toml"),
        (&["compare", "runs/a", "runs/b"], "fem-run report A B compares the results"),
        (&["compare"], "fem-run report A B compares the results"),
        (&["invert", "case.toml", "--restitution", "92"], "92 % is --restitution 0.92"),
        (&["invert", "case.toml", "--restitution", "1"], "such as 0.92"),
        (&["check", "case.toml", "--set", "model=tingg"], "did you mean `ting`?"),
        (&["check", "case.toml", "--set", "model.law=tsujii"], "did you mean `tsuji`?"),
    ] {
        let message = refused(&place, arguments);
        assert!(message.contains(expected), "{message}");
    }
    let ran = place.fails(2, "sweep case.toml");
    ran.tells("this file is a case, not a sweep|run it with fem-run FILE");
    assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
}

/// A number without its unit is no long run: it is rejected with its place, and runs with the unit, also as the resolved case
/// that `check` prints.
#[test]
fn implausible_bare_numbers_are_rejected_and_a_unit_admits_them() {
    let place = Place::new();
    for (set, expected) in [
        (
            "material.glass.youngs_modulus=2.93",
            "youngs_modulus = \"2.93 GPa\", or youngs_modulus = \"2.93 Pa\"",
        ),
        ("body.0.sphere.diameter=10", "diameter = \"10 mm\", or diameter = \"10 m\""),
        ("material.glass.density=2.39", "density = \"2.39 g/cm^3\""),
    ] {
        for command in ["", "check", "export", "accuracy"] {
            let words: Vec<&str> =
                command.split_whitespace().chain(["case.toml", "--set", set]).collect();
            let message = refused(&place, &words);
            assert!(message.contains(expected), "{message}");
        }
    }
    let all = "case.toml --set material.glass.youngs_modulus=2.93 --set material.glass.density=1 --set body.1.sphere.diameter=15";
    let ran = place.fails(2, all);
    assert_eq!(ran.stderr.matches("error: ").count(), 3, "{}", ran.stderr);
    let soft = [
        "--set",
        "material.glass.youngs_modulus='2.93 Pa'",
        "--set",
        "body.0.sphere.diameter='10 m'",
    ];
    let ting = "--set model.hertz={} --set body.0.approach_speed=1e-6";
    let ran = place.succeed(("check case.toml --resolved", soft, ting));
    place.write("resolved.toml", &ran.stdout);
    place.succeed("resolved.toml --out a -q");
    place.succeed(("case.toml --out b -q", soft, ting));
    let e = |out: &str| place.json(&format!("{out}/summary.json"))["restitution"].clone();
    assert_eq!(e("a"), e("b"));
}

/// The memory that a run announces is held to the limit, with that of the program and of reference runs.
#[test]
fn the_announced_memory_is_limited() {
    let place = Place::new();
    for model in ["model.fem={}", "model.condensed={}"] {
        let run = |memory: &str| {
            let memory = format!("limits.memory='{memory}'");
            place.run(["case.toml", "--set", model, "--set", &memory, "--out", "out", "--force"])
        };
        let ran = run("5 MB");
        assert_eq!(ran.code, Some(2), "{model}: {}", ran.stderr);
        ran.tells("limits.memory|of memory, reference runs included");
        assert_eq!(run("1 GB").code, Some(0), "{model}");
    }
}

/// A tolerance that no mesh meets is an error before the run, unless the best mesh is asked for.
#[test]
fn a_tolerance_out_of_reach_is_rejected() {
    let place = Place::with(&CASE.replace("[mesh]\ncontact_element_size = \"90 um\"\n", ""));
    for model in ["model.fem={}", "model.condensed={}"] {
        let words = ["case.toml", "--tolerance", "1e-9", "--set", model];
        let message = refused(&place, &words);
        assert!(
            message.contains("accuracy.tolerance cannot be met") && message.contains("--best"),
            "{message}"
        );
    }
    // `check` announces it; --best runs, here into a limit.
    place.succeed("check case.toml --tolerance 1e-9 --set model.fem={}").prints("cannot be met");
    let limited = "case.toml --tolerance 1e-9 --best --set model.fem={} --set limits.elements=1000";
    place.fails(2, limited).tells("limits.elements");
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

/// A mesh or a table without end is refused before memory is full.
#[cfg(target_os = "linux")]
#[test]
fn files_without_end_are_refused() {
    let place = Place::new();
    let mesh = "body.1.sphere={ diameter='22.2 mm', mesh='/dev/zero' }";
    for arguments in
        [&["case.toml", "--set", mesh][..], &["fit", "case.toml", "--data", "/dev/zero"]]
    {
        let message = refused(&place, arguments);
        assert!(message.contains("/dev/zero"), "{message}");
        assert!(message.contains("too large"), "{message}");
    }
}
