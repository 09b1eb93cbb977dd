//! A full disk: what is kept, in which order, and the messages.

#![cfg(unix)]

use crate::common::{Place, Ran};

/// Runs the command with a limit on the size of files, in kilobytes: writing fails as on a full disk.
fn run_within(place: &Place, kilobytes: usize, arguments: &[&str]) -> Ran {
    let script = r#"ulimit -f "$0"; exec "$@""#;
    // The limit is in blocks of 512 bytes.
    let blocks = (2 * kilobytes).to_string();
    let mut command = std::process::Command::new("sh");
    command.current_dir(place.path("")).args(["-c", script, &blocks]);
    command.arg(env!("CARGO_BIN_EXE_fem-run")).args(arguments).output().unwrap().into()
}

/// A snapshot takes 360 kB, the history 300 kB, the contact a few kB, the summary 7 kB and 16 kB of
/// reserve.
const FINE: [&str; 3] = ["case.toml", "--set", "mesh.contact_element_size='30 um'"];

#[test]
fn full_disk_drops_snapshots_first_then_the_history() {
    for (kilobytes, kept, lost) in [
        (325, &["contact.csv", "history.csv", "summary.json"][..], "the snapshots"),
        (60, &["summary.json"], "history.csv and the snapshots"),
        (20, &["summary.json"], "history.csv and the snapshots"),
    ] {
        let place = Place::new();
        let ran = run_within(&place, kilobytes, &FINE);
        assert_eq!(ran.code, Some(1), "{}", ran.stderr);
        let said = format!("{lost} cannot be written");
        assert!(ran.stderr.contains(&said) && ran.stderr.contains("kept: "), "{}", ran.stderr);
        assert!(ran.stdout.contains("peak force") && ran.stdout.contains(&said), "{}", ran.stdout);
        assert_eq!(place.list("runs/case"), kept);
        assert_eq!(place.list("runs"), ["case"]);
        let summary = place.json("runs/case/summary.json");
        let mut listed: Vec<_> = summary["files"].as_array().unwrap().iter().collect();
        listed.sort_by_key(|name| name.to_string());
        assert_eq!(listed, kept);
        assert!(summary["warnings"].to_string().contains(&said), "{}", summary["warnings"]);
        assert_eq!(summary["complete"], true);
    }
}

/// The report is still printed, and an older result is unchanged.
#[test]
fn full_disk_still_prints_the_report_and_keeps_an_older_result() {
    let place = Place::new();
    place.succeed("case.toml");
    let before = place.result("runs/case");
    let ran = run_within(&place, 1, &["case.toml"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    ran.prints("peak force|Result: not written");
    ran.tells("nothing was kept");
    assert_eq!((place.result("runs/case"), place.list("runs")), (before, vec!["case".to_string()]));
}

/// An incomplete result does not replace a complete one.
#[test]
fn incomplete_result_is_written_beside_an_older_result() {
    let place = Place::new();
    place.succeed(FINE);
    let before = place.result("runs/case");
    let ran = run_within(&place, 325, &FINE);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    ran.prints("Result: runs/case.new");
    assert_eq!(place.result("runs/case"), before);
    assert_eq!(place.list("runs/case.new"), ["contact.csv", "history.csv", "summary.json"]);
}

/// A reader that has gone away is no error; a stdout that cannot be written is one, and the result is kept.
#[cfg(target_os = "linux")]
#[test]
fn full_standard_output_is_an_error_and_keeps_the_result() {
    let place = Place::new();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let ran: Ran = place.command("case.toml").stdout(full).output().unwrap().into();
    assert_eq!(ran.code, Some(1));
    ran.tells("standard output");
    assert_eq!(place.json("runs/case/summary.json")["complete"], true);
}
