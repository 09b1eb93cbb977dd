//! A case from the standard input, a summary on the standard output.

use std::io::Write;
use std::process::Stdio;

use crate::common::{CASE, FAILS, Place, Ran, set};

/// Runs the command with a text on the standard input.
fn fed(place: &Place, arguments: &[&str], text: &[u8]) -> Ran {
    let mut command = place.command(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(text).unwrap();
    child.wait_with_output().unwrap().into()
}

#[test]
fn case_from_standard_input_gives_the_result_of_the_file() {
    let place = Place::new();
    let ting = ["--set", "model.ting={}"];
    place.succeed(("case.toml --out file", ting));
    let ran = fed(&place, &[&["-"][..], &ting].concat(), CASE.as_bytes());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stderr.starts_with("<stdin>: "), "{}", ran.stderr);
    assert_eq!(place.result("runs/stdin"), place.result("file"));
    // Every command that reads a case.
    let checked = fed(&place, &["check", "-"], CASE.as_bytes());
    checked.prints("\n<stdin> is valid. Expected of a run:");
}

#[test]
fn faults_in_standard_input_have_line_and_column() {
    let place = Place::new();
    let text = CASE.replace("density", "densitty");
    let ran = fed(&place, &["-", "--json"], text.as_bytes());
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
    ran.tells("<stdin>:4:1: ");
    for (text, message) in [
        (vec![b'#'; (16 << 20) + 1], "16 MiB"),
        (b"title = \"\xff\"".to_vec(), "not UTF-8"),
        (Vec::new(), "<stdin>"),
    ] {
        let ran = fed(&place, &["-"], &text);
        assert_eq!(ran.code, Some(2));
        ran.tells(message);
    }
    assert_eq!(place.list("."), ["case.toml"]);
}

/// The summary is alone on stdout, as in the file, for any end of the run, and with --quiet too.
#[test]
fn json_option_prints_only_the_summary() {
    let place = Place::new();
    for quiet in [&[][..], &["--quiet"]] {
        let ran = place.succeed(("case.toml --json --out out", quiet));
        assert_eq!(ran.stdout.as_bytes(), place.read("out/summary.json"));
        let is_warning = |line: &str| line.starts_with("warning: ");
        assert_eq!(ran.stderr.lines().all(is_warning), !quiet.is_empty(), "{}", ran.stderr);
    }
    let failed = place.fails(1, ("case.toml --json", set(&FAILS)));
    let summary: serde_json::Value = serde_json::from_str(&failed.stdout).unwrap();
    assert_eq!(summary["complete"], false);
}
