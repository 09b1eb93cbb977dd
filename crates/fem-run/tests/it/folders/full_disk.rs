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

/// Commands with a result of their own print their answer, keep the numbers before the pictures, and leave an older result as it is.
#[test]
fn commands_on_a_full_disk_answer_and_keep_what_they_can() {
    let data = |name: &str| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/data/");
        format!("{folder}{name}.csv")
    };
    let law = ["--law", "kuwabara_kono", "--data"];
    let series = ["--model=ting", "--terms=1", "--data"];
    for (command, table, options, kept, answer) in [
        ("measure", data("bounce_times"), vec![], Some(10), "12 restitutions"),
        ("relaxation", data("dma_23_degc"), vec![], Some(10), "glassy modulus"),
        ("fit", data("bridges_ice"), law.to_vec(), Some(20), "rms error"),
        ("calibrate", data("bridges_ice"), series.to_vec(), Some(10), "rms"),
        // Its numbers are the largest file.
        ("export", "case.toml".to_string(), vec![], None, "lammps"),
    ] {
        let place = Place::new();
        let json = format!("{command}.json");
        let mut words = vec![command];
        if matches!(command, "fit" | "calibrate") {
            words.push("case.toml");
        }
        words.extend(options);
        words.extend([table.as_str(), "--out", "result"]);
        let ran = run_within(&place, 1, &words);
        assert_eq!(ran.code, Some(1), "{command}: {}", ran.stderr);
        ran.prints(format!("{answer}|Result: not written"));
        ran.tells("cannot be written|nothing was kept");
        assert!(!place.path("result").exists(), "{command}");
        let Some(kept) = kept else { continue };
        let ran = run_within(&place, kept, &words);
        assert_eq!(ran.code, Some(1), "{command}: {}", ran.stderr);
        ran.prints(format!("{answer}|Result: result"));
        ran.tells(format!("cannot be written|kept: {json}"));
        let numbers = place.json(&format!("result/{json}"));
        let listed = numbers["files"].as_array().unwrap().len();
        assert_eq!(listed, place.list("result").len(), "{command}");
        place.succeed(&words[..]);
        let whole = place.result("result");
        assert!(whole.len() > listed, "{command}");
        run_within(&place, kept, &words).prints("Result: result.new");
        assert_eq!(place.result("result"), whole, "{command}");
    }
}

/// Pages and pictures of results, and the copy of a table, fail like other files.
#[test]
fn pages_on_a_full_disk_are_an_error() {
    let place = Place::new();
    place.succeed("case.toml --out run");
    for words in [["report", "run", "--out=page.html"], ["plot", "run", "--what=force"]] {
        let ran = run_within(&place, 1, &words);
        assert_eq!(ran.code, Some(1), "{}", ran.stderr);
        ran.tells("is the disk full");
    }
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
