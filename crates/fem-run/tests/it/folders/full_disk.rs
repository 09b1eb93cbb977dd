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
        ("calibrate", data("bridges_ice"), series.to_vec(), Some(9), "rms"),
        // The numbers of these two are the largest file.
        ("fit", data("bridges_ice"), law.to_vec(), None, "rms error"),
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

/// Every command that writes ends with status 1 and names the file as the user did and the cause, leaves no cut file and no empty
/// folder, and names no file that is not there. Sizes in kilobytes: none at all, and one that the first large file exceeds.
#[test]
fn every_command_names_the_file_and_the_limit_and_leaves_nothing_cut() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/data");
    let sweep = "case = \"case.toml\"\n[vary]\n\"body.0.approach_speed\" = [0.1, 0.2]\n";
    for (words, kilobytes, named, kept) in [
        ("case.toml --out made/new", &[0, 1][..], "result", &[][..]),
        ("mesh case.toml --out made/new", &[0, 1], "made/new/striker.vtu", &[]),
        ("measure DATA/bounce_times.csv --out made/new", &[0, 1], "", &[]),
        ("measure DATA/bounce_times.csv --out new.csv", &[10], "measure.svg", &["new.csv", "runs"]),
        ("relaxation DATA/dma_23_degc.csv --out made/new", &[0, 1], "", &[]),
        (
            "fit case.toml --law kuwabara_kono --data DATA/bridges_ice.csv --out made/new",
            &[0, 1],
            "",
            &[],
        ),
        (
            "calibrate case.toml --model=ting --terms=1 --data DATA/bridges_ice.csv --out made/new",
            &[0, 1],
            "",
            &[],
        ),
        ("export case.toml --out made/new", &[0, 1], "", &[]),
        ("report run --out new.html", &[0, 1], "new.html", &[]),
        ("plot run --what force --out new.svg", &[0, 1], "new.svg", &[]),
        ("sweep sweep.toml --out made/new", &[0], "made/new", &[]),
        ("accuracy case.toml --budget 0.1 --out made/new", &[0, 1], "", &[]),
        (
            "cradle --length 20cm --diameters 2cm,2cm --data DATA/cradle_trials.csv --out made/new",
            &[0],
            "",
            &[],
        ),
        ("new new", &[0, 1], "new.toml", &[]),
        ("new new", &[10], "fem-run.schema.json", &["new.toml"]),
    ] {
        for kilobytes in kilobytes {
            let place = Place::new();
            place.write("sweep.toml", sweep);
            place.succeed("case.toml --out run --set model={hertz={}}");
            let before = place.list("");
            let words: Vec<_> = words.split(' ').map(|word| word.replace("DATA", data)).collect();
            let words: Vec<_> = words.iter().map(String::as_str).collect();
            let ran = run_within(&place, *kilobytes, &words);
            assert_eq!(ran.code, Some(1), "{words:?}: {}", ran.stderr);
            ran.tells(named);
            ran.tells("the limit on the size of files (ulimit -f) is reached");
            let said = ran.stdout + &ran.stderr;
            assert!(!said.contains(".tmp") && !said.contains("os error"), "{words:?}: {said}");
            assert!(
                !said.contains("--data made") && !said.contains("--fit made"),
                "{words:?}: {said}"
            );
            assert!(!said.contains("file = \"made"), "{words:?}: {said}");
            let after = place.list("").into_iter().filter(|name| !before.contains(name));
            assert_eq!(after.collect::<Vec<_>>(), kept, "{words:?} {kilobytes}: {said}");
        }
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
