//! The next run removes what killed runs leave, and nothing of a running one.

#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::thread;
use std::time::Duration;

use nix::sys::signal::Signal;

use crate::common::Place;
use crate::folders::send;

const LOCK: &str = ".fem-run-lock";

/// Starts a run of hours and waits until it has its hidden folder.
fn endless(place: &Place, out: &str) -> Child {
    let n_before = hidden(place).len();
    let fine = "--set mesh.contact_element_size=6e-6 --set time.step_factor=1e-2";
    let mut command = place.command((["case.toml", "--out", out], fine));
    let mut child = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.contains(" elements, about "), "{line}");
    while hidden(place).len() == n_before {
        assert_eq!(child.try_wait().unwrap(), None);
        thread::sleep(Duration::from_millis(10));
    }
    child
}

fn hidden(place: &Place) -> Vec<String> {
    place.list(".").into_iter().filter(|name| name.starts_with(".fem-run-")).collect()
}

#[test]
fn recovery_deletes_folders_of_killed_runs_and_keeps_running_ones() {
    let place = Place::new();
    let mut living = endless(&place, "living");
    let of_living = hidden(&place);
    assert_eq!(of_living.len(), 1);
    let mut killed = endless(&place, "killed");
    assert_eq!(hidden(&place).len(), 2);
    killed.kill().unwrap();
    killed.wait().unwrap();
    place.succeed(["case.toml", "--set", "model.ting={}", "--out", "out"]);
    assert_eq!(hidden(&place), of_living);
    send(&living, Signal::SIGINT);
    assert_eq!(living.wait().unwrap().code(), Some(130));
    assert_eq!(place.list("."), ["case.toml", "living", "out"]);
    assert_eq!(place.json("living/summary.json")["complete"], false);
}

/// Writes two results of the case, `older` and `newer`, the older one with a file of the user.
fn two_results() -> Place {
    let place = Place::new();
    place.succeed(["case.toml", "--set", "model.ting={}", "--out", "older"]);
    place.write("older/notes.txt", "mine");
    place.succeed(["case.toml", "--set", "model.hertz={}", "--out", "newer"]);
    place
}

/// Creates the hidden folder of a process that was killed before it wrote `out`.
fn abandon(place: &Place, name: &str) -> String {
    let folder = format!(".fem-run-{name}");
    fs::create_dir_all(place.path(&folder)).unwrap();
    place.write(&format!("{folder}/{LOCK}"), "out");
    folder
}

fn rename(place: &Place, from: &str, to: &str) {
    fs::rename(place.path(from), place.path(to)).unwrap();
}

fn sweep(place: &Place) {
    place.succeed(["case.toml", "--set", "model.ting={}", "--out", "another"]);
    assert_eq!(hidden(place), [""; 0]);
}

/// Processes that were killed before anything was finished, one before it had a lock.
#[test]
fn recovery_deletes_an_unfinished_result() {
    let place = Place::new();
    fs::create_dir(place.path(".fem-run-b")).unwrap();
    let folder = abandon(&place, "a");
    place.write(&format!("{folder}/history.csv"), "time_s");
    sweep(&place);
    assert_eq!(place.list("."), ["another", "case.toml"]);
}

/// The process was killed just after it had moved the old result aside.
#[test]
fn recovery_restores_an_older_result_moved_aside() {
    let place = two_results();
    let aside = abandon(&place, "b");
    rename(&place, "older", &format!("{aside}/old"));
    sweep(&place);
    assert_eq!(place.list("out"), ["history.csv", "notes.txt", "report.html", "summary.json"]);
    assert_eq!(place.json("out/summary.json")["effects"][0]["name"], "viscoelasticity");
}

/// The process was killed after moving the user's files, before moving the new result.
#[test]
fn recovery_completes_an_interrupted_replacement() {
    let place = two_results();
    let staging = abandon(&place, "a");
    let aside = abandon(&place, "b");
    place.write("newer/more.txt", "mine too");
    for name in place.list("newer") {
        rename(&place, &format!("newer/{name}"), &format!("{staging}/{name}"));
    }
    rename(&place, "older", &format!("{aside}/old"));
    let new = place.read(format!("{staging}/summary.json"));
    sweep(&place);
    assert_eq!(
        place.list("out"),
        ["history.csv", "more.txt", "notes.txt", "report.html", "summary.json"]
    );
    assert_eq!(place.read("out/summary.json"), new);
}

/// The process was killed after moving the new result, while it deleted the old one.
#[test]
fn recovery_deletes_the_old_result_after_its_replacement() {
    let place = two_results();
    let aside = abandon(&place, "b");
    rename(&place, "older", &format!("{aside}/old"));
    fs::remove_file(place.path(format!("{aside}/old/history.csv"))).unwrap();
    rename(&place, "newer", "out");
    let new = place.read("out/summary.json");
    sweep(&place);
    assert_eq!(place.list("out"), ["history.csv", "notes.txt", "report.html", "summary.json"]);
    assert_eq!(place.read("out/summary.json"), new);
}

/// Without a lock file, a folder may belong to someone else.
#[test]
fn recovery_keeps_hidden_folders_without_a_lock_file() {
    let place = Place::new();
    fs::create_dir(place.path(".fem-run-mine")).unwrap();
    place.write(".fem-run-mine/notes.txt", "mine");
    place.write(".fem-run-notes.tmp", "mine");
    place.succeed(["case.toml", "--set", "model.ting={}", "--out", "out"]);
    assert_eq!(hidden(&place), [".fem-run-mine", ".fem-run-notes.tmp"]);
    assert_eq!(place.list(".fem-run-mine"), ["notes.txt"]);
}

/// Members of a sweep that was killed.
#[test]
fn sweep_deletes_folders_of_killed_members() {
    let place = Place::new();
    let text = "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = [0.1, 0.2]\n";
    place.write("sweep.toml", text);
    let sweep = ["sweep", "sweep.toml", "--set", "model.ting={}", "--quiet"];
    place.succeed(sweep);
    let folder = "runs/sweep/members/.fem-run-a";
    fs::create_dir(place.path(folder)).unwrap();
    place.write(&format!("{folder}/{LOCK}"), "0123456789abcdef");
    place.succeed(sweep);
    assert_eq!(place.list("runs/sweep/members").len(), 2);
}
