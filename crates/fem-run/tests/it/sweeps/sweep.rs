//! `fem-run sweep`: members, continuation, shards, failures, files.

use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

#[cfg(unix)]
use nix::sys::signal::Signal;

use crate::common::Place;
#[cfg(unix)]
use crate::folders::send;

/// Three speeds and two relaxation weights, in all combinations.
const SWEEP: &str = r#"case = "case.toml"

[vary]
"body.0.approach_speed" = ["0.3 m/s", "50 cm/s", 1.0]
material.glass.relaxation.terms.0.weight = [0.5, 1.0]
"#;

fn place(sweep: &str) -> Place {
    let place = Place::new();
    place.write("sweep.toml", sweep);
    place
}

/// Over the angle only tangential quantities change: the table and the lines of progress have them.
#[test]
fn oblique_sweeps_print_tangential_quantities() {
    let place = place(
        "case = 'ball.toml'\n[vary]\n'body.1.impact_angle' = ['10 deg', '20 deg', '60 deg']\n",
    );
    place.write("ball.toml", include_str!("../../../../../cases/oblique_glass.toml"));
    let ran = place.succeed("sweep sweep.toml");
    let lines: Vec<&str> = ran.stdout.lines().take(4).collect();
    assert!(lines[0].contains("e_t") && !lines[0].contains("contact time"), "{}", ran.stdout);
    assert!(lines[2].contains(" ± ") && lines[2].ends_with('°'), "{}", ran.stdout);
    assert!(lines.iter().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
    assert!(
        ran.stderr.contains("60 deg: restitution 0.97576 ± 0.00066, e_t 0.4"),
        "{}",
        ran.stderr
    );
}

/// Rows have error bars, or say what is not known or only estimated; the figure marks such points; and a warning is of all its
/// members.
#[test]
fn table_and_figure_say_what_is_not_known() {
    let place = place(
        "case = 'ball.toml'\n[vary]\n'body.1.material' = ['lib:pmma', 'lib:steel']\n\
         'body.1.approach_speed' = ['1 mm/s', '1 m/s', '5 m/s']\n",
    );
    place.write(
        "ball.toml",
        "model.hertz = {}\nbody = [{ name = 'floor', wall = {} },
         { name = 'ball', sphere.diameter = '10 mm', material = 'lib:pmma', approach_speed = '1 m/s' }]\n",
    );
    let ran = place.succeed("sweep sweep.toml");
    let lines: Vec<&str> = ran.stdout.lines().collect();
    let row = |material: &str, speed: &str| {
        let has = |line: &&&str| line.contains(material) && line.contains(&format!(" {speed} "));
        *lines.iter().find(has).unwrap()
    };
    assert!(row("lib:pmma", "1 m/s").contains("≤ 1."), "{}", ran.stdout);
    assert!(row("lib:steel", "5 m/s").contains("≤ 1."), "{}", ran.stdout);
    // A sweep over one key fits on 80 columns; the first of two keys takes eleven.
    assert!(lines.iter().all(|line| line.chars().count() <= 80 + 11), "{}", ran.stdout);
    ran.prints("±: discretisation error|≤: upper bound");
    assert!(ran.stderr.contains("5 m/s: restitution ≤ 1."), "{}", ran.stderr);
    // The members that yield have their numbers in one warning.
    let is_it = |line: &&str| line.contains(" yields ") && line.contains(" members, ");
    let yields: Vec<&str> = ran.stderr.lines().filter(is_it).collect();
    assert_eq!(yields.len(), 1, "{}", ran.stderr);
    assert!(yields[0].contains("first in") && yields[0].contains("last in"), "{}", yields[0]);
    assert!(place.text("runs/sweep/sweep.svg").contains(">bound<"));
    // The table has the status of each number.
    let rows = rows(&place, "runs/sweep/sweep.csv");
    let column = |name: &str| rows[0].iter().position(|key| key == name).unwrap();
    let of_restitution = column("restitution_status");
    assert!(rows[1..].iter().all(|row| row[of_restitution] == "bound"));
}

/// Returns the rows of a table, the header first.
fn rows(place: &Place, name: &str) -> Vec<Vec<String>> {
    let bytes = place.read(name);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes.as_slice());
    let rows = reader.records().map(|row| row.unwrap().iter().map(str::to_string).collect());
    rows.collect()
}

fn assert_same_result(place: &Place, a: &str, b: &str) {
    for name in ["sweep.csv", "sweep.svg"] {
        let same = place.read(format!("{a}/{name}")) == place.read(format!("{b}/{name}"));
        assert!(same, "{name} differs between {a} and {b}");
    }
    assert_eq!(place.list(&format!("{a}/members")), place.list(&format!("{b}/members")));
}

#[test]
fn all_lists_are_combined_in_order_and_every_column_is_there() {
    let place = place(SWEEP);
    let ran = place.succeed("sweep sweep.toml");
    assert_eq!(place.list("runs/sweep"), ["members", "sweep.csv", "sweep.json", "sweep.svg"]);
    let rows = rows(&place, "runs/sweep/sweep.csv");
    let weight = "material.glass.relaxation.terms.0.weight";
    let speed = "body.0.approach_speed";
    // A number without a unit has no second column.
    assert_eq!(rows[0][..4], [speed, weight, "body.0.approach_speed_m_s", "restitution"]);
    let numbers: Vec<_> = rows[1..].iter().map(|row| row[2].as_str()).collect();
    assert_eq!(numbers, ["0.3", "0.3", "0.5", "0.5", "1.0", "1.0"]);
    let values: Vec<_> = rows[1..].iter().map(|row| [row[0].as_str(), &row[1]]).collect();
    let speeds = ["0.3 m/s", "50 cm/s", "1.0"];
    let expected = speeds.map(|speed| [[speed, "0.5"], [speed, "1.0"]]);
    assert_eq!(values, expected.as_flattened());

    // The row is the member's summary, and the member equals the single case.
    let set = ["--set", "body.0.approach_speed='50 cm/s'", "--set", &format!("{weight}=0.5")];
    place.succeed(("case.toml --out alone --set 'title=\"A pair\"'", set));
    let alone = place.json("alone/summary.json");
    let member =
        place.json(&format!("runs/sweep/members/{}/summary.json", rows[3].last().unwrap()));
    assert_eq!(alone["case"], member["case"]);
    let cell = |name: &str| rows[3][rows[0].iter().position(|key| key == name).unwrap()].as_str();
    let mut n_checked = 0;
    let across = ["tangential", "contact_patch", "impulse_ratio", "psi", "energy_friction"];
    let mut check = |column: String, value: &serde_json::Value| {
        // Columns of oblique impacts stand in tables that have one.
        if across.iter().any(|name| column.contains(name)) {
            return assert!(value.is_null() && !rows[0].contains(&column), "{column}");
        }
        let expected = match value {
            serde_json::Value::Null => String::new(),
            serde_json::Value::String(text) => text.clone(),
            value => value.to_string(),
        };
        assert_eq!(cell(&column), expected, "{column}");
        n_checked += 1;
    };
    for (key, value) in alone.as_object().unwrap() {
        match key.as_str() {
            "cost"
            | "case"
            | "bodies"
            | "effects"
            | "files"
            | "program"
            | "version"
            | "numerics"
            | "made_from"
            | "source"
            | "models_considered"
            | "coarser_meshes"
            | "elastic_null"
            | "stress_error"
            | "measured_restitution" => {}
            "status" => value
                .as_object()
                .unwrap()
                .iter()
                .for_each(|(quantity, status)| check(format!("{quantity}_status"), status)),
            "uncertainty" => value.as_object().unwrap().iter().for_each(|(quantity, parts)| {
                let parts = parts.as_object().unwrap().iter();
                parts.filter(|(part, _)| *part != "input").for_each(|(part, value)| {
                    check(format!("uncertainty_{part}_{quantity}"), value)
                });
            }),
            "bounces" | "rest" | "adhesion" | "plate" | "dent" | "relaxation_coverage" => {
                assert!(value.is_null(), "{key} without its table")
            }
            "warnings" => check(key.clone(), &value.as_array().unwrap().len().into()),
            "hertz" | "energy" => value
                .as_object()
                .unwrap()
                .iter()
                .for_each(|(inner, value)| check(format!("{key}_{inner}"), value)),
            _ => check(key.clone(), value),
        }
    }
    assert!(n_checked > 20);
    let elements = alone["bodies"].as_array().unwrap().iter().map(|body| &body["elements"]);
    assert_eq!(cell("elements"), elements.map(|n| n.as_u64().unwrap()).sum::<u64>().to_string());
    ran.prints(
        "50 cm/s|approach_speed  weight |± |±: discretisation error|Result: runs/sweep/sweep.csv",
    );
    ran.tells("[6/6] body.0.approach_speed = ");
    let svg = place.text("runs/sweep/sweep.svg");
    for expected in ["[m/s]", "contact time [µs]", "Hertz", "g = 0.5"] {
        assert!(svg.contains(expected), "{expected}");
    }
}

/// `--dry-run` prints what is to run, also for a sweep that has begun, and writes nothing.
#[test]
fn a_dry_run_counts_and_writes_nothing() {
    let place = place(SWEEP);
    place.succeed("sweep sweep.toml --dry-run").tells("6 members; 0 already done, 6 to run");
    assert_eq!(place.list("."), ["case.toml", "sweep.toml"]);
    place.succeed("sweep sweep.toml --shard 1/3 --quiet");
    let table = place.read("runs/sweep/sweep.csv");
    place.succeed("sweep sweep.toml --dry-run").tells("6 members; 2 already done, 4 to run");
    assert_eq!(place.read("runs/sweep/sweep.csv"), table);
    // A member that would be rejected is rejected here.
    place.write("sweep.toml", "case = 'case.toml'\n[vary]\nbody.0.approach_speed = [0.3, -1.0]\n");
    assert_eq!(place.run("sweep sweep.toml --dry-run").code, Some(2));
}

/// Equal spheres at speeds of equal ratios, and pairs from a table.
#[test]
fn ranges_links_and_tables_make_the_members_that_lists_make() {
    let linked = "'body.0.sphere.diameter, body.1.sphere.diameter'";
    let speeds = "'body.0.approach_speed'";
    let place = place(&format!(
        "case = 'case.toml'\n[vary]\n{linked} = ['16 mm', '18 mm']\n\
         {speeds} = {{ from = '25 cm/s', to = '100 cm/s', n = 3, log = true }}\n"
    ));
    let ting = ["--set", "model.ting={}", "--quiet", "--out"];
    place.succeed(("sweep sweep.toml", ting, "range"));
    let range = rows(&place, "range/sweep.csv");
    assert_eq!(
        range[0][..6],
        [
            "body.0.sphere.diameter",
            "body.1.sphere.diameter",
            "body.0.approach_speed",
            "body.0.sphere.diameter_m",
            "body.1.sphere.diameter_m",
            "body.0.approach_speed_m_s"
        ]
    );
    assert_eq!(range[5][..6], ["18 mm", "18 mm", "50 cm/s", "0.018", "0.018", "0.5"]);
    // The same from a table, which also has columns of other names.
    let table: Vec<String> =
        range[1..].iter().map(|row| format!("x,{},{}\n", row[0], row[5])).collect();
    place.write("pairs.csv", &format!("# made\nnote,d,body.0.approach_speed\n{}", table.concat()));
    place.write(
        "sweep.toml",
        "case = 'case.toml'\n[vary]\n'body.0.sphere.diameter, body.1.sphere.diameter, \
         body.0.approach_speed' = { table = 'pairs.csv', columns = ['d', 'd', 'body.0.approach_speed'] }\n",
    );
    place.succeed(("sweep sweep.toml", ting, "table"));
    let table = rows(&place, "table/sweep.csv");
    assert_eq!(table.len(), 7);
    let results =
        |rows: &[Vec<String>]| rows.iter().map(|row| row[3..].to_vec()).collect::<Vec<_>>();
    assert_eq!(results(&table), results(&range));
    assert_eq!(place.list("range/members"), place.list("table/members"));
    // A range without log has equal steps.
    place.write(
        "sweep.toml",
        "case = 'case.toml'\n[vary]\nbody.0.approach_speed = { from = 0.25, to = 1, n = 4 }\n",
    );
    place.succeed(("sweep sweep.toml", ting, "even"));
    let even = rows(&place, "even/sweep.csv");
    assert_eq!(
        even.iter().map(|row| row[0].as_str()).collect::<Vec<_>>()[1..],
        ["0.25", "0.5", "0.75", "1.0"]
    );
}

#[test]
fn whole_results_are_kept_on_demand_and_those_without_are_computed_again() {
    let place = place("case = 'case.toml'\n[vary]\nbody.0.approach_speed = [0.3]\n");
    place.succeed("sweep sweep.toml");
    let member = place.list("runs/sweep/members").remove(0);
    let folder = format!("runs/sweep/members/{member}");
    assert_eq!(place.list(&folder), ["summary.json"]);
    place.write(
        "sweep.toml",
        "case = 'case.toml'\nkeep = 'all'\n[vary]\nbody.0.approach_speed = [0.3]\n",
    );
    place.succeed("sweep sweep.toml");
    let files = place.list(&folder);
    for expected in ["history.csv", "summary.json", &format!("{member}.pvd")] {
        assert!(files.iter().any(|name| name == expected), "{files:?}");
    }
}

#[test]
fn threads_and_shards_give_the_same_bytes() {
    let place = place(SWEEP);
    place.succeed("sweep sweep.toml --out one --threads 1");
    place.succeed("sweep sweep.toml --out two --threads 2");
    assert_same_result(&place, "one", "two");
    place.succeed("sweep sweep.toml --out shards --shard 3/4");
    let done: Vec<_> = rows(&place, "shards/sweep.csv").into_iter().skip(1).collect();
    assert_eq!(done.len(), 1);
    assert_eq!(done[0][..2], ["50 cm/s", "0.5"]);
    // The other shards run at the same time.
    let start = |shard| {
        let arguments = ["sweep", "sweep.toml", "--out", "shards", "--quiet", "--shard", shard];
        place.command(arguments).spawn().unwrap()
    };
    for mut child in ["1/4", "2/4", "4/4"].map(start) {
        assert_eq!(child.wait().unwrap().code(), Some(0));
    }
    assert_same_result(&place, "one", "shards");
}

/// So many members that one is done long before the last.
const LONG: &str = "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = [0.30, 0.31, 0.32, 0.33, \
                    0.34, 0.35, 0.36, 0.37, 0.38, 0.39, 0.40, 0.41]\n";
const FINE: [&str; 2] = ["--set", "mesh.contact_element_size=60e-6"];

/// Starts the long sweep and waits until a member is done.
fn start_long(place: &Place, out: &str) -> Child {
    let arguments = [&["sweep", "sweep.toml", "--threads", "1", "--out", out][..], &FINE].concat();
    let mut command = place.command(&arguments);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    #[allow(clippy::disallowed_methods, reason = "a test that waits for another process")]
    let began = Instant::now();
    while n_done(place, out) == 0 {
        assert!(began.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

/// Returns the number of members that are done; one in a hidden folder is still being written.
fn n_done(place: &Place, out: &str) -> usize {
    let members = fs::read_dir(place.path(format!("{out}/members"))).into_iter().flatten();
    let folders = members.map(|entry| entry.unwrap().path());
    let is_hidden = |folder: &Path| folder.file_name().unwrap().to_string_lossy().starts_with('.');
    folders.filter(|folder| !is_hidden(folder) && folder.join("summary.json").exists()).count()
}

#[test]
fn killed_sweep_resumes_with_the_members_left() {
    let place = place(LONG);
    let mut child = start_long(&place, "killed");
    child.kill().unwrap();
    child.wait().unwrap();
    let n_kept = n_done(&place, "killed");
    assert!((1..12).contains(&n_kept), "{n_kept}");
    let again = [&["sweep", "sweep.toml", "--out", "killed"][..], &FINE].concat();
    let ran = place.succeed(&again);
    let expected = format!("12 members; {n_kept} already done, {} to run", 12 - n_kept);
    ran.tells(&expected);
    place.succeed(("sweep sweep.toml --out whole", FINE));
    for name in ["sweep.csv", "sweep.svg"] {
        assert!(place.read(format!("killed/{name}")) == place.read(format!("whole/{name}")));
    }
    // A finished sweep has nothing to do; a changed list reuses what it can.
    place.succeed(&again).tells("12 already done, 0 to run");
    place.write("sweep.toml", &LONG.replace("0.30, 0.31,", "0.29,").replace("0.35", "'35 cm/s'"));
    place.succeed(&again).tells("11 members; 10 already done, 1 to run");
    assert_eq!(rows(&place, "killed/sweep.csv").len(), 12);
}

#[cfg(unix)]
#[test]
fn interrupted_sweep_keeps_its_members_and_explains_how_to_resume() {
    let place = place(LONG);
    let child = start_long(&place, "out");
    send(&child, Signal::SIGINT);
    let ran: crate::common::Ran = child.wait_with_output().unwrap().into();
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    ran.tells("of 12 members are done|the same command continues");
    let rows = rows(&place, "out/sweep.csv");
    assert!((2..13).contains(&rows.len()));
    assert_eq!(rows.len() - 1, n_done(&place, "out"));
    assert_eq!(place.list("out/members").len(), n_done(&place, "out"), "nothing half-done");
}

/// While a million members are checked, which takes seconds, nothing is written that an orderly end could keep.
#[cfg(unix)]
#[test]
fn a_signal_ends_a_check_at_once() {
    use std::os::unix::process::ExitStatusExt;
    let many = "case = 'case.toml'\nmax_members = 1000000\n[vary]\nbody.0.approach_speed = { from = 0.1, to = 1.0, n = 1000 }\n\
                start.gap = { from = 1e-6, to = 1e-5, n = 1000 }\n";
    let place = place(many);
    let mut child = place.command("sweep sweep.toml").spawn().unwrap();
    std::thread::sleep(Duration::from_secs(1));
    assert!(child.try_wait().unwrap().is_none());
    // Processes in the background of a script ignore SIGINT.
    send(&child, Signal::SIGTERM);
    assert_eq!(child.wait().unwrap().signal(), Some(Signal::SIGTERM as i32));
    assert!(!place.path("runs").exists());
}

#[test]
fn failing_sweep_member_is_named_and_the_others_are_run() {
    // Soft and fast: the sphere folds where it is pressed flat.
    let place = place(
        "case = 'case.toml'\ncombine = 'paired'\n[vary]\n'material.glass' = [\n\
         { density = 2390, youngs_modulus = 1e6, poissons_ratio = 0.244 },\n\
         { density = 2390, youngs_modulus = 63e9, poissons_ratio = 0.244 }]\n\
         'body.0.approach_speed' = [60, 0.5]\nmesh.contact_element_size = [0.5e-3, 90e-6]\n",
    );
    for _ in 0..2 {
        place
            .fails(1, "sweep sweep.toml")
            .tells("error: 1 of 2 members failed|body.0.approach_speed = 60");
        let rows = rows(&place, "runs/sweep/sweep.csv");
        let column = |name: &str| rows[0].iter().position(|key| key == name).unwrap();
        let complete = column("complete");
        assert_eq!((rows[1][complete].as_str(), rows[2][complete].as_str()), ("false", "true"));
        assert!(
            rows[1][column("stopped_because")].contains("folds at the radius"),
            "{:?}",
            rows[1]
        );
    }
}

#[test]
fn only_a_new_folder_or_a_sweep_is_written_into() {
    let place = place(SWEEP);
    place.succeed("case.toml --out result --quiet");
    place.write("file", "mine");
    fs::create_dir(place.path("mine")).unwrap();
    place.write("mine/notes.txt", "mine");
    for out in ["result", "file", "mine", "file/below", "."] {
        place.fails(2, ["sweep", "sweep.toml", "--out", out]).tells(format!("{out}: "));
    }
    assert_eq!(place.list("mine"), ["notes.txt"]);
    // The same message without a run.
    for more in [&["--dry-run"][..], &["--slurm="], &["--shard", "1/2", "--no-merge"]] {
        place.fails(2, ("sweep sweep.toml --out mine", more)).tells("something other than a sweep");
    }
    // Nor does a run replace a sweep.
    place.succeed("sweep sweep.toml --out out --shard 6/6 --quiet");
    assert_eq!(place.run("case.toml --out out").code, Some(2));
}

#[test]
fn shipped_sweep_case_runs() {
    let place = Place::new();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/sweep_speed.toml");
    // Only the first member: the slowest speed, on a coarse mesh.
    let arguments = ["sweep", file, "--shard", "1/12", "--set", "mesh.contact_element_size=20e-6"];
    place.succeed(arguments).prints("1 of 12 members are done");
}

#[test]
fn sweeps_page_examples_run_and_columns_are_documented() {
    let page = include_str!("../../../../../docs/sweeps.md");
    let place = Place::new();
    // An empty shard checks all members and computes none.
    let arguments = "sweep sweep.toml --out out --shard 9999/9999";
    let examples: Vec<_> = page.split("```toml\n").skip(1).collect();
    assert!(examples.len() > 1);
    for example in examples {
        let example = &example[..example.find("```").unwrap()];
        place.write("sweep.toml", &example.replace("glass_0.5ms.toml", "case.toml"));
        place.succeed(arguments);
    }
    for column in &rows(&place, "out/sweep.csv")[0] {
        let is_varied = column.contains('.');
        let starts = ["hertz_", "energy_", "uncertainty_discretisation_", "uncertainty_model_"];
        let bare = starts.iter().find_map(|start| column.strip_prefix(start)).unwrap_or(column);
        let bare = bare.strip_suffix("_status").unwrap_or(bare);
        assert!(is_varied || page.contains(bare), "{column} is not on the page");
    }
}

/// Condensed members share a factor if the case gives the mesh; otherwise a hint says so.
#[test]
fn condensed_sweep_hints_at_sharing_a_factor() {
    let vary = "[vary]\nbody.0.approach_speed = [0.2, 3]\n\
                material.glass.relaxation.terms.0.decay_rate = [1000, 2000]\n";
    let place = place(&format!("case = 'case.toml'\n{vary}"));
    let condensed = "--set model.condensed={}";
    let hint = "give mesh.contact_element_size and mesh.refined_radius";
    let stderr = place.succeed(("sweep sweep.toml --out open", condensed)).stderr;
    assert_eq!(stderr.matches(hint).count(), 1, "{stderr}");
    let given = ["--set", "mesh.refined_radius='0.4 mm'"];
    let stderr = place.succeed(("sweep sweep.toml --out given", condensed, given)).stderr;
    assert!(!stderr.contains(hint), "{stderr}");
    // A member equals the single case, apart from the files that are not kept.
    let rows = rows(&place, "given/sweep.csv");
    let member = format!("given/members/{}/summary.json", rows[4].last().unwrap());
    let speed = "case.toml --out alone --set 'title=\"A pair\"' --set body.0.approach_speed=3";
    let rate = "--set material.glass.relaxation.terms.0.decay_rate=2000";
    place.succeed((speed, rate, condensed, given));
    let [mut alone, mut member] = ["alone/summary.json", &member].map(|name| place.json(name));
    for summary in [&mut alone, &mut member] {
        let summary = summary.as_object_mut().unwrap();
        // Without snapshots there is no stress.
        summary
            .retain(|key, _| !["cost", "files", "source", "stress_error"].contains(&key.as_str()));
    }
    assert_eq!(alone, member);
}

/// Fifteen curves of two keys have a colour for one key, and dashes and markers for the other, each named once. More than
/// the dashes distinguish have a line that says how to choose.
#[test]
fn many_curves_of_two_keys_have_colours_and_dashes() {
    let sweep = |weights: &str| {
        format!(
            "case = \"case.toml\"\n[vary]\nmodel = [{{ hertz = {{}} }}]\nbody.0.approach_speed = [\"0.1 m/s\", \"1 m/s\"]\n\
             body.0.sphere.diameter = [\"5 mm\", \"6 mm\", \"7 mm\", \"8 mm\", \"9 mm\"]\n\
             material.glass.relaxation.terms.0.weight = {weights}\n[plot]\nx = \"body.0.approach_speed\"\n\
             y = [\"contact_time_s\"]\n"
        )
    };
    let place = Place::new();
    let drawn = |weights: &str| {
        place.write("many.toml", &sweep(weights));
        place.succeed("sweep many.toml");
        place.text("runs/many/sweep.svg")
    };
    // The only model is no key that distinguishes curves.
    let svg = drawn("[0.2, 0.5, 1.0]");
    for name in ["D = 5 mm", "D = 9 mm", "g = 0.2", "g = 1.0"] {
        assert_eq!(svg.matches(name).count(), 1, "{name}");
    }
    let dashes = svg.matches("stroke-dasharray=\"2 3\"").count();
    assert!(dashes >= 5 && !svg.contains("more"), "{dashes}");
    let svg = drawn("[0.2, 0.3, 0.4, 0.5, 0.6, 0.7]");
    assert!(svg.contains("plot.series chooses one key"), "{svg}");
}
