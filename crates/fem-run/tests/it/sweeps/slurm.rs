//! Sweeps for a batch system: the script, its parts, merged shards, progress.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use crate::common::{CASE, Place};

const SWEEP: &str =
    "case = 'case.toml'\n[vary]\nbody.0.approach_speed = { from = 0.3, to = 0.5, n = 7 }\n";

fn place() -> Place {
    let place = Place::with(CASE);
    place.write("sweep.toml", SWEEP);
    place
}

/// Creates a command of Slurm that records its calls.
fn stand_in(place: &Place, name: &str, script: &str) {
    fs::create_dir_all(place.path("bin")).unwrap();
    let path = place.path(format!("bin/{name}"));
    fs::write(&path, format!("#!/bin/sh\necho {name} \"$@\" >> calls\n{script}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

fn path_with(place: &Place) -> String {
    format!("{}:{}", place.path("bin").display(), std::env::var("PATH").unwrap())
}

fn same(place: &Place, name: &str) {
    assert!(place.read(format!("whole/{name}")) == place.read(format!("out/{name}")), "{name}");
}

/// Runs each part of the script as Slurm would; the result is that of a sweep in one go.
#[test]
fn the_script_computes_the_sweep() {
    let place = place();
    let base = ["sweep", "sweep.toml", "--set", "title=\"it's\""];
    place.succeed((base, "--out whole --quiet"));
    let slurm = "--out out --slurm '--time=10 --mem=1G' --shards 3";
    place.succeed((base, slurm)).prints("7 members in 3 tasks|Submit it with: sh ");
    assert_eq!(place.list("out"), ["members", "sweep.json", "sweep.sbatch"]);
    assert!(place.list("out/members").is_empty());
    let script = place.text("out/sweep.sbatch");
    for line in ["#SBATCH --array=1-3", "#SBATCH --requeue", "#SBATCH --time=10 --mem=1G"] {
        assert!(script.lines().any(|known| known == line), "{line}\n{script}");
    }
    let run = |task: &str, part: &[&str]| {
        let mut command = std::process::Command::new("sh");
        command.arg(place.path("out/sweep.sbatch")).args(part).current_dir(place.path("."));
        let ran = command.env("SLURM_ARRAY_TASK_ID", task).output().unwrap();
        assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    };
    for task in ["2", "1", "3", "1"] {
        run(task, &[]);
        assert!(!place.path("out/sweep.csv").exists(), "a task leaves the table alone");
    }
    run("1", &["merge"]);
    for name in ["sweep.csv", "sweep.svg", "sweep.json"] {
        same(&place, name);
    }
}

#[test]
fn slurm_submits_array_and_merge_and_requeues_killed_tasks() {
    let place = place();
    stand_in(&place, "sbatch", "echo '42;cluster'");
    let slurm = "sweep sweep.toml --out out --slurm=--time=10 --submit";
    let ran = place.command(slurm).env("PATH", path_with(&place)).output().unwrap();
    let stdout = String::from_utf8(ran.stdout).unwrap();
    assert!(stdout.contains("Submitted: array 42, merge 42"), "{stdout}");
    let calls = place.text("calls");
    let calls: Vec<&str> = calls.lines().collect();
    assert!(calls.len() == 2 && calls[0].ends_with("sweep.sbatch"), "{calls:?}");
    assert!(calls[1].contains("--dependency=afterany:42") && calls[1].ends_with("merge"));

    // The program that the script starts is killed.
    stand_in(&place, "scontrol", "");
    let script = place.text("out/sweep.sbatch");
    let start = script.find("  exec ").unwrap();
    let end = start + script[start..].find('\n').unwrap();
    place.write(
        "killed",
        &format!("{}  exec sh -c 'kill -9 $$'{}", &script[..start], &script[end..]),
    );
    let mut command = std::process::Command::new("sh");
    command.arg(place.path("killed")).current_dir(place.path(".")).env("PATH", path_with(&place));
    command.env("SLURM_ARRAY_TASK_ID", "2").env("SLURM_ARRAY_JOB_ID", "42");
    assert_eq!(command.output().unwrap().status.code(), Some(137));
    let calls = place.text("calls");
    assert_eq!(calls.lines().last(), Some("scontrol requeue 42_2"));
    // Tasks are not requeued for ever.
    command.env("SLURM_RESTART_COUNT", "10").output().unwrap();
    assert_eq!(place.read("calls"), calls.as_bytes());
}

#[test]
fn missing_or_failing_sbatch_is_reported() {
    let place = place();
    let submit = ["sweep", "sweep.toml", "--slurm", "--time=10", "--submit"];
    stand_in(&place, "sbatch", "echo no partition >&2; exit 1");
    let ran = place.command(submit).env("PATH", path_with(&place)).output().unwrap();
    let stderr = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(1));
    assert!(stderr.contains("no partition") && stderr.contains("the script is kept"), "{stderr}");
    for (arguments, expected) in [
        (&["--slurm", "--time=10 --array=1-5"][..], "--array is set by the sweep itself"),
        (&["--slurm=--time=10\n--mem=1"], "contain a line break"),
        (&["--slurm=", "--shards", "8"], "--shards 8"),
        (&["--slurm=", "--shard", "1/2"], "--shard"),
        (&["--submit"], "--slurm"),
        (&["--no-merge"], "--shard"),
    ] {
        place.fails(2, ("sweep sweep.toml --out new", arguments)).tells(expected);
    }
    assert!(!place.path("new").exists());
}

#[test]
fn sweep_status_counts_done_and_failed_members() {
    let place = place();
    place.succeed("sweep sweep.toml --out out --shard 1/3 --quiet");
    let words = |text: &str| {
        let rows = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
        rows.collect::<Vec<_>>()
    };
    let ran = place.succeed("sweep --status out");
    let said = words(&ran.stdout);
    for expected in ["out: a sweep of case.toml", "members 7", "done 3", "failed 0", "left 4"] {
        assert!(said.iter().any(|line| line == expected), "{expected}\n{}", ran.stdout);
    }
    // A merge of an incomplete sweep says so.
    place.fails(1, "sweep sweep.toml --out out --merge").tells("3 of 7 members are done");
    fs::create_dir(place.path("mine")).unwrap();
    for folder in ["mine", "none"] {
        place.fails(2, ["sweep", "--status", folder]).tells("sweep.json");
    }
}
