//! Which results a new one replaces.

use crate::common::Place;

const TING: &str = "case.toml --set model.ting={}";
const SLOWER: &str = "case.toml --set model.ting={} --set body.0.approach_speed=0.25";
const LIMITED: &str = "case.toml --set model.ting={} --set limits.elements=1e6";

/// Without --out nothing is lost, and each case finds its own folder again.
#[test]
fn another_case_gets_its_own_result_folder() {
    let place = Place::new();
    place.succeed(TING);
    let first = place.read("runs/case/summary.json");
    let ran = place.succeed(LIMITED);
    let own = place.list("runs").pop().unwrap();
    assert!(own.starts_with("case-") && own.len() == "case-".len() + 8, "{own}");
    assert_eq!(place.read("runs/case/summary.json"), first);
    let said = format!("result: runs/{own} (runs/case holds another case)");
    ran.tells(said);
    ran.prints(format!("Result: runs/{own}\n"));

    place.write(&format!("runs/{own}/notes.txt"), "mine");
    place.succeed(LIMITED);
    place.succeed(TING);
    assert_eq!(place.list("runs"), ["case", own.as_str()]);
    assert_eq!(place.read(format!("runs/{own}/notes.txt")), b"mine");
    place.succeed((LIMITED, "--force"));
    assert_eq!(place.json("runs/case/summary.json")["case"]["limits"]["elements"], 1e6);
}

/// Overrides that change the scene are in the title and in the name of the folder, not in those of its files.
#[test]
fn changes_of_the_scene_name_title_and_folder() {
    let place = Place::new();
    let ran = place.succeed((TING, ["--set", "body.0.approach_speed=\"1 m/s\""]));
    ran.prints("A pair, approach_speed = 1 m/s\n|Result: runs/case-approach_speed=1m_s\n");
    assert_eq!(place.list("runs"), ["case-approach_speed=1m_s"]);
    let summary = place.json("runs/case-approach_speed=1m_s/summary.json");
    assert_eq!(summary["case"]["title"], "A pair, approach_speed = 1 m/s");
    place.succeed((SLOWER, ["--set", "title=mine"])).prints("mine\n|case-approach_speed=0.25m_s");
}

#[test]
fn a_named_folder_of_another_case_is_refused() {
    let place = Place::new();
    place.succeed((TING, "--out out"));
    let before = place.result("out");
    place
        .fails(2, (SLOWER, "--out out"))
        .tells("--out out: this folder holds the result of another case|--force");
    assert_eq!(
        (place.result("out"), place.list(".")),
        (before, vec!["case.toml".into(), "out".into()])
    );
    place.succeed((SLOWER, "--out out --force"));
}

/// Units, title, comments, file name and figures do not make another case; any key does, even if it changes
/// no number.
#[test]
fn case_identity_ignores_units_title_and_comments() {
    let place = Place::new();
    let out = "--out out --quiet";
    place.succeed((TING, out));
    let text = place.text("case.toml");
    let text = text.replace("\"63 GPa\"", "6.3e10").replace("A pair", "The pair");
    place.write("same.toml", &format!("# the same\n{text}"));
    place.succeed(("same.toml --set model.ting={}", out));
    place.succeed((TING, out, "--set output.snapshots=[]"));
    place.fails(2, (TING, out, "--set limits.elements=1e6"));
}

/// A fit, and the run of its case.
#[test]
fn commands_do_not_replace_each_others_results() {
    let place = Place::new();
    place.write("data.csv", "speed_m_s,restitution\n0.1,0.95\n0.5,0.92\n");
    let fit = "fit case.toml --data data.csv --law kuwabara_kono -q";
    place.succeed((TING, "--out out"));
    place.fails(2, (fit, "--out out"));
    place.succeed(fit);
    // Other options of the same fit replace it, another case does not.
    place.succeed((fit, "--confidence 0.9"));
    place.succeed((fit, ["--set", "body.0.sphere.diameter='2 cm'"]));
    let folders = place.list("runs");
    assert_eq!(folders.len(), 2, "{folders:?}");
    assert!(folders[0] == "data_fit" && folders[1].starts_with("data_fit-"), "{folders:?}");
    place.fails(2, (TING, "--out runs/data_fit"));
}
