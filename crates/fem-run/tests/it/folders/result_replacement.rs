//! Which results a new one replaces.

use crate::common::{CASE, Place, set};

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
    let own = "case-model.ting-limits.elements=1e6";
    assert_eq!(place.read("runs/case/summary.json"), first);
    ran.tells(format!("result: runs/{own} (runs/case holds another result)"));
    ran.prints(format!("Result: runs/{own}\n"));

    place.write(&format!("runs/{own}/notes.txt"), "mine");
    place.succeed(LIMITED);
    place.succeed(TING);
    assert_eq!(place.list("runs"), ["case", own]);
    assert_eq!(place.read(format!("runs/{own}/notes.txt")), b"mine");
    place.succeed((LIMITED, "--force"));
    assert_eq!(place.json("runs/case/summary.json")["case"]["limits"]["elements"], 1e6);
}

/// Overrides that change the scene are in the title and in the name of the folder, not in those of its files.
#[test]
fn changes_of_the_scene_name_title_and_folder() {
    let place = Place::new();
    let ran = place.succeed((TING, ["--set", "body.0.approach_speed=\"1 m/s\""]));
    ran.prints("A pair, but approach_speed = 1 m/s\n|Result: runs/case-approach_speed=1m_s\n");
    assert_eq!(place.list("runs"), ["case-approach_speed=1m_s"]);
    let summary = place.json("runs/case-approach_speed=1m_s/summary.json");
    assert_eq!(summary["case"]["title"], "A pair, but approach_speed = 1 m/s");
    place.succeed((SLOWER, ["--set", "title=mine"])).prints("mine\n|case-approach_speed=0.25m_s");
}

#[test]
fn a_named_folder_of_another_case_is_refused() {
    let place = Place::new();
    place.succeed((TING, "--out out"));
    let before = place.result("out");
    place
        .fails(2, (SLOWER, "--out out"))
        .tells("out: this folder holds another result: run ../case.toml model.ting={}|--force");
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

/// A case that is edited keeps its folder: a reader of the old report would take it for the new one's.
#[test]
fn an_edited_file_replaces_its_own_result() {
    let place = Place::new();
    let ran = place.succeed(TING);
    assert!(!ran.stderr.contains("earlier result"), "{}", ran.stderr);
    place.succeed((TING, "--out out -q"));
    place.write("case.toml", &CASE.replace("0.5 m/s", "0.25 m/s"));
    place.succeed(TING).tells("result: runs/case (replaces an earlier result)");
    place.succeed((TING, "--out out -q"));
    assert_eq!(place.list("runs"), ["case"]);
    for folder in ["runs/case", "out"] {
        let summary = place.json(&format!("{folder}/summary.json"));
        assert_eq!(summary["case"]["body"][0]["approach_speed"], 0.25, "{folder}");
    }
    // Another file of the same name is another case, even after the project was moved.
    std::fs::create_dir(place.path("soft")).unwrap();
    place.write("soft/case.toml", &CASE.replace("63 GPa", "6 GPa"));
    place.succeed("soft/case.toml --set model.ting={}").prints("Result: runs/case-model.ting");
    place.succeed("soft/case.toml").prints("Result: runs/case-soft");
    place
        .fails(2, "soft/case.toml --out out")
        .tells("this folder holds another result: run ../case.toml");
}

/// The rule is one for all commands that write a folder: other files or overrides are kept, and so is a folder that has
/// anything else.
#[test]
fn every_command_keeps_results_of_other_inputs() {
    let place = Place::new();
    place.write("a.csv", "speed_m_s,restitution\n0.1,0.95\n0.3,0.935\n0.5,0.92\n");
    place.write("b.csv", "speed_m_s,restitution\n0.1,0.90\n0.3,0.880\n0.5,0.86\n");
    place.write("a_trials.csv", "alpha_deg,beta_deg\n30,28\n20,19\n");
    place.write("b_trials.csv", "alpha_deg,beta_deg\n30,27\n20,18\n");
    place.write("a_bounces.csv", "time_s\n0.4\n1.0\n1.54\n");
    place.write("b_bounces.csv", "time_s\n0.4\n1.1\n1.64\n");
    place.write("a_moduli.csv", "f [Hz],E' [MPa],E'' [MPa]\n1,2000,100\n10,2200,90\n");
    place.write("b_moduli.csv", "f [Hz],E' [MPa],E'' [MPa]\n1,1000,100\n10,1200,90\n");
    place.write("a.toml", "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = [0.1, 0.2]\n");
    place.write(
        "b.toml",
        "case = 'case.toml'\n[vary]\n'body.0.sphere.diameter' = ['1 cm', '2 cm']\n",
    );
    let ting = "--set model.ting={}";
    let faster = "--set body.0.approach_speed=1 --set model.ting={}";
    let smaller = "--set body.1.sphere.diameter=1cm --set model.ting={}";
    for (command, inputs) in [
        ("case.toml", [ting, faster]),
        ("sweep", ["a.toml --set model.ting={}", "b.toml --set model.ting={}"]),
        ("sweep a.toml", [ting, smaller]),
        ("export case.toml", [ting, smaller]),
        ("export case.toml --data", ["a.csv", "b.csv"]),
        ("export case.toml --diameters", ["1mm", "2mm"]),
        ("fit case.toml --law tsuji --data", ["a.csv", "b.csv"]),
        ("fit case.toml --law tsuji --data a.csv", [ting, smaller]),
        ("calibrate case.toml --terms 1 --model ting --data", ["a.csv", "b.csv"]),
        ("cradle --diameters 2cm,2cm --length 1m --data", ["a_trials.csv", "b_trials.csv"]),
        ("measure", ["a_bounces.csv", "b_bounces.csv"]),
        ("relaxation", ["a_moduli.csv", "b_moduli.csv"]),
        ("accuracy case.toml --budget 0.01", [ting, smaller]),
    ] {
        let run = |input: &str, more: &str| place.run(&format!("{command} {input} -q {more}"));
        let out = format!("--out {}", command.replace([' ', '.', '-'], "_"));
        for input in [inputs[0], inputs[0]] {
            let ran = run(input, &out);
            assert_eq!(ran.code, Some(0), "{command} {input}: {}", ran.stderr);
        }
        let before = place.list(&out[6..]);
        let ran = run(inputs[1], &out);
        assert_eq!(ran.code, Some(2), "{command}: {}", ran.stderr);
        ran.tells("holds another|--force");
        assert_eq!(place.list(&out[6..]), before);
        assert_eq!(run(inputs[1], &format!("{out} --force")).code, Some(0), "{command}");
        // Without --out nothing is lost.
        for input in inputs {
            assert_eq!(run(input, "").code, Some(0), "{command}");
        }
        let folders = place.list("runs");
        assert_eq!(folders.len(), 2, "{command}: {folders:?}");
        std::fs::remove_dir_all(place.path("runs")).unwrap();
        std::fs::create_dir(place.path(format!("{}_foreign", &out[6..]))).unwrap();
        place.write(&format!("{}_foreign/notes.txt", &out[6..]), "mine");
        for force in ["", " --force"] {
            assert_eq!(run(inputs[0], &format!("{out}_foreign{force}")).code, Some(2), "{command}");
        }
    }
}

/// One of two cases that run at the same time for one folder says that its result lies elsewhere.
#[cfg(unix)]
#[test]
fn a_race_for_one_folder_is_not_lost_silently() {
    let place = Place::new();
    let endless = ["mesh.contact_element_size=6e-6", "time.step_factor=1e-2"];
    let mut slow = place.command(("case.toml --quiet --out out", set(&endless))).spawn().unwrap();
    // It has looked at the folder, and writes into a hidden one.
    while place.list(".") == ["case.toml"] {
        assert!(slow.try_wait().unwrap().is_none());
    }
    place.succeed((TING, "--quiet --out out"));
    crate::folders::send(&slow, nix::sys::signal::Signal::SIGINT);
    assert_eq!(slow.wait().unwrap().code(), Some(1));
    assert_eq!(place.list("."), ["case.toml", "out", "out.new"]);
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
    assert_eq!(folders, ["data_fit", "data_fit-body.0.sphere.diameter=2cm"]);
    place.fails(2, (TING, "--out runs/data_fit"));
}
