//! Sweeps whose summaries are lines of a few files give the same table, also after kills.

use std::fs;

use crate::common::{Place, Words};

const SWEEP: &str = "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = { from = '0.1 m/s', to = 1.0, n = 30 }\n";
const TING: [&str; 2] = ["--set", "model.ting={}"];

fn place() -> Place {
    let place = Place::new();
    place.write("folders.toml", SWEEP);
    place.write("packed.toml", &format!("keep = 'packed'\n{SWEEP}"));
    place
}

fn sweep(place: &Place, words: impl Words) -> String {
    place.succeed(("sweep", words, TING)).stderr
}

#[track_caller]
fn same_table(place: &Place) {
    for name in ["sweep.csv", "sweep.svg"] {
        assert!(place.read(format!("folders/{name}")) == place.read(format!("packed/{name}")));
    }
}

#[test]
fn a_packed_sweep_has_one_file_the_same_table_and_survives_a_kill() {
    let place = place();
    sweep(&place, "folders.toml --out folders");
    sweep(&place, "packed.toml --out packed");
    same_table(&place);
    let packs = place.list("packed/members");
    assert!(packs.len() == 1 && packs[0].starts_with("1-of-1."), "{packs:?}");
    // A line is the member's summary.
    let text = place.text(format!("packed/members/{}", packs[0]));
    let line: serde_json::Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
    let alone = format!("folders/members/{}/summary.json", line["member"].as_str().unwrap());
    let mut summaries = [line["summary"].clone(), place.json(&alone)];
    for summary in &mut summaries {
        let summary = summary.as_object_mut().unwrap();
        summary.retain(|key, _| !["cost", "files"].contains(&key.as_str()));
    }
    assert_eq!(summaries[0], summaries[1]);
    assert_eq!(text.lines().count(), 30);
    // A killed process leaves an incomplete line; complete lines are used.
    let pack = format!("packed/members/{}", packs[0]);
    let kept: Vec<&str> = text.split_inclusive('\n').take(12).collect();
    fs::write(place.path(&pack), &kept.concat()[..kept.concat().len() - 40]).unwrap();
    let said = sweep(&place, "packed.toml --out packed");
    assert!(said.contains("30 members; 11 already done, 19 to run"), "{said}");
    assert_eq!(place.list("packed/members").len(), 2);
    same_table(&place);
    // Results in folders are used too, and the other way round.
    for file in ["packed.toml", "folders.toml"] {
        for out in ["packed", "folders"] {
            let said = sweep(&place, [file, "--force", "--out", out]);
            assert!(said.contains("30 already done, 0 to run"), "{said}");
        }
    }
}

/// Each shard has its file, and another sharding reuses their results.
#[test]
fn shards_have_a_file_each() {
    let place = place();
    sweep(&place, "folders.toml --out folders");
    for shard in ["2/3", "3/3"] {
        sweep(&place, ["packed.toml", "--out", "packed", "--no-merge", "--shard", shard]);
    }
    let packs = place.list("packed/members");
    assert!(packs.len() == 2 && packs[1].starts_with("3-of-3."), "{packs:?}");
    let done = place.succeed("sweep --status packed").stdout;
    let left = |n: &str| done.lines().any(|line| line.starts_with("left ") && line.ends_with(n));
    // The first process has written a sweep.json with what it knows.
    assert!(left(" 0"), "{done}");
    let said = sweep(&place, "packed.toml --out packed --shard 1/2");
    assert!(said.contains("15 in this shard; 10 already done, 5 to run"), "{said}");
    let said = sweep(&place, "packed.toml --out packed --no-merge --shard 2/2");
    assert!(said.contains("15 in this shard; 10 already done, 5 to run"), "{said}");
    sweep(&place, "packed.toml --out packed --merge");
    same_table(&place);
}

/// More members than file systems can hold as folders are packed by default.
#[test]
fn sweeps_above_10000_members_are_packed_by_default() {
    let place = place();
    for (n, packs) in [(10_000, false), (10_001, true)] {
        let lines =
            format!("max_members = 20000\n{}", SWEEP.replace("n = 30", &format!("n = {n}")));
        place.write("many.toml", &lines);
        let out = n.to_string();
        let shard = format!("{n}/{n}");
        let words = ["many.toml", "--out", &out, "--no-merge", "--shard", &shard];
        sweep(&place, words);
        let list = place.list(&format!("{out}/members"));
        assert!(list.len() == 1 && list[0].ends_with(".jsonl") == packs, "{list:?}");
    }
}
