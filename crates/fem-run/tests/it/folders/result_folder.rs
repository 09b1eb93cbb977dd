//! The files that a run writes, and those that it leaves alone.

use crate::common::{FAILS, Place, set};
use fem_vtk::VtuFile;

/// The quantities of interest, which `hertz` and `uncertainty` have too.
const QUANTITIES: &str =
    "restitution contact_time_s peak_force_n max_approach_m max_contact_radius_m peak_pressure_pa";
const OTHERS: &str = "tangential_restitution contact_patch_rebound_deg impulse_ratio psi_before psi_after status peak_force_raw_n radius_and_pressure elastic_null stress_error measured_restitution contact_episodes hertz energy \
    momentum_residual_relative bounces adhesion plate relaxation_coverage dent rest bodies time_step_s steps element_updates cost effects uncertainty coarser_meshes \
    models_considered warnings complete stopped_because program version numerics made_from source case";

fn keys(value: &serde_json::Value) -> String {
    let keys = value.as_object().unwrap().keys().map(String::as_str);
    keys.filter(|key| *key != "files").collect::<Vec<_>>().join(" ")
}

#[test]
fn result_has_the_documented_keys_and_files() {
    let place = Place::new();
    place.succeed("case.toml");
    let summary = place.json("runs/case/summary.json");
    assert_eq!(keys(&summary), format!("{QUANTITIES} {OTHERS}"));
    for (object, expected) in [
        (&summary["hertz"], QUANTITIES),
        (&summary["status"], QUANTITIES),
        (&summary["uncertainty"], QUANTITIES),
        (
            &summary["energy"],
            "initial_j kinetic_j strain_j contact_j viscous_dissipation_j wall_work_j friction_j tangential_relaxation_j residual_j residual_relative",
        ),
        (
            &summary["bodies"][1],
            "name elements nodes mass_kg added_mass_kg velocity_before_m_s velocity_after_m_s velocity_tangential_after_m_s spin_after_rad_s vibration_energy_j",
        ),
        (
            &summary["cost"],
            "wall_s setup_s trials_s solve_s ns_per_element_update all_element_updates threads \
             peak_memory_bytes factor_bytes",
        ),
        (&summary["effects"][0], "name active reason matters error_if_left_out"),
    ] {
        assert_eq!(keys(object), expected);
    }
    for key in QUANTITIES.split(' ') {
        let parts = &summary["uncertainty"][key];
        assert_eq!(keys(parts), "discretisation model input");
        assert!(parts["model"].as_f64().unwrap() > 0.0, "{key}: the case names no law");
    }
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["cost"]["threads"], 1);
    assert!(summary["stopped_because"].is_null());
    // On such a coarse mesh the results are within a few per cent, and the pressure of so few
    // nodes is 15 % low.
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    for key in QUANTITIES.split(' ').skip(1) {
        let ratio = number(&summary[key]) / number(&summary["hertz"][key]);
        assert!((0.82..1.15).contains(&ratio), "{key}: {ratio}");
    }
    assert!((0.9..0.95).contains(&number(&summary["restitution"])));
    let spent = &summary["cost"];
    let expected = 1e9 * number(&spent["solve_s"]) / number(&summary["element_updates"]);
    assert!((number(&spent["ns_per_element_update"]) / expected - 1.0).abs() < 1e-9);
    assert_eq!(place.list("."), ["case.toml", "runs"]);
    assert_eq!(place.list("runs"), ["case"]);
    let files = "case.pvd case.vtu.series case_0_mid-compression.vtu case_1_maximum.vtu \
                 case_2_mid-separation.vtu case_3_last-contact.vtu contact.csv history.csv report.html \
                 summary.json";
    assert_eq!(place.list("runs/case").join(" "), files);

    let history = place.text("runs/case/history.csv");
    let header = "time_s,contact_force_n,contact_radius_m,approach_m,centre_pressure_pa,\
                  velocity_striker_m_s,velocity_target_m_s,kinetic_j,strain_j,contact_j,\
                  viscous_dissipation_j,residual_j";
    assert_eq!(history.lines().next(), Some(header));
    assert!((500..4100).contains(&history.lines().count()), "{}", history.lines().count());
    // The largest values of the columns are those of the summary, up to the time between two rows.
    let keys = ["peak_force_n", "max_contact_radius_m", "max_approach_m", "peak_pressure_pa"];
    for (column, key) in (1..).zip(keys) {
        let cells = history.lines().skip(1).map(|row| row.split(',').nth(column).unwrap());
        let largest = cells.filter_map(|cell| cell.parse::<f64>().ok()).fold(0.0, f64::max);
        assert!((largest / number(&summary[key]) - 1.0).abs() < 2e-3, "{key}: {largest}");
    }

    let maximum = VtuFile::open(place.path("runs/case/case_1_maximum.vtu")).unwrap();
    let mesh = maximum.quad_mesh().unwrap();
    let total = |key: &str| -> u64 {
        let bodies = summary["bodies"].as_array().unwrap();
        bodies.iter().map(|body| body[key].as_u64().unwrap()).sum()
    };
    assert_eq!(mesh.points.len() as u64, total("nodes"));
    assert_eq!(mesh.quads.len() as u64, total("elements"));
    for name in ["sigma_rr", "sigma_yy", "sigma_tt", "sigma_ry", "pressure", "von_mises"] {
        assert!(maximum.point_data(name).is_ok() && maximum.cell_data(name).is_ok(), "{name}");
    }
    for name in ["displacement", "velocity"] {
        assert_eq!(maximum.point_data(name).unwrap().components, 3);
    }
    let body = maximum.cell_data("body").unwrap();
    let body = body.as_integer().unwrap();
    assert_eq!(body.iter().sum::<i64>(), summary["bodies"][1]["elements"].as_i64().unwrap());
    // Below the middle of a Hertz contact the pressure is 2 (1 + ν) p_0 / 3 = 0.83 p_0; coarse
    // elements miss some of it.
    let pressure = maximum.point_data("pressure").unwrap();
    let largest = pressure.as_float().unwrap().iter().copied().fold(0.0, f64::max);
    let peak = summary["hertz"]["peak_pressure_pa"].as_f64().unwrap();
    assert!((0.4..1.2).contains(&(largest / peak)), "{}", largest / peak);
}

#[test]
fn a_wall_has_neither_elements_nor_mass() {
    let place = Place::new();
    let wall = "body.1={name='floor', wall={}}";
    place.succeed(["case.toml", "--set", wall, "--out", "out"]);
    let summary = place.json("out/summary.json");
    let floor = &summary["bodies"][1];
    assert_eq!((floor["elements"].as_u64(), floor["nodes"].as_u64()), (Some(0), Some(0)));
    for key in ["mass_kg", "added_mass_kg", "vibration_energy_j"] {
        assert!(floor[key].is_null(), "{key}");
    }
    let snapshot = VtuFile::open(place.path("out/case_1_maximum.vtu")).unwrap();
    assert_eq!(
        snapshot.quad_mesh().unwrap().points.len() as u64,
        summary["bodies"][0]["nodes"].as_u64().unwrap()
    );
    let history = place.text("out/history.csv");
    assert!(history.starts_with("time_s,") && history.contains("velocity_floor_m_s"));
    // A gap separates the bodies in a snapshot.
    place.succeed("case.toml --set start.gap=2e-6 --out out --force");
    let mesh = VtuFile::open(place.path("out/case_1_maximum.vtu")).unwrap().quad_mesh().unwrap();
    let below = mesh.points.iter().filter(|p| p[1] < 0.0).map(|p| p[1]).fold(-1.0, f64::max);
    let above = mesh.points.iter().filter(|p| p[1] > 0.0).map(|p| p[1]).fold(1.0, f64::min);
    assert_eq!((below, above), (-1e-6, 1e-6));
}

#[test]
fn snapshots_can_be_a_count_times_or_none() {
    let place = Place::new();
    let snapshots = |value: &str| {
        let set = format!("output.snapshots={value}");
        let ran = place.succeed(["case.toml", "--set", &set, "--out", "out"]);
        let names = place.list("out").into_iter().filter(|name| name.starts_with("case"));
        (names.collect::<Vec<_>>(), ran.stdout)
    };
    let (files, _) = snapshots("3");
    let even = ["case.pvd", "case.vtu.series", "case_0_even.vtu", "case_1_even.vtu"];
    assert_eq!(files[..4], even);
    let (files, report) = snapshots("['10 us', '1 s']");
    assert_eq!(files, ["case.pvd", "case.vtu.series", "case_0_time.vtu"]);
    assert!(report.contains("warning:"), "{report}");
    let (files, _) = snapshots("[]");
    assert!(files.is_empty(), "{files:?}");
}

/// One row per instant, eight columns per probe; no file without probes.
#[test]
fn probes_have_a_table() {
    let place = Place::new();
    place.succeed("case.toml --out none");
    assert!(!place.list("none").contains(&"probes.csv".to_string()));
    let probes = "output.probe=[{body='target', r=0, y=0}, {body='target', r='0.1 mm', y='1 mm'}]";
    place.succeed(["case.toml", "--set", probes, "--out", "out"]);
    let files = place.json("out/summary.json")["files"].clone();
    assert!(files.as_array().unwrap().contains(&"probes.csv".into()), "{files}");
    let text = place.text("out/probes.csv");
    let (head, rows) = text.split_once('\n').unwrap();
    let columns: Vec<&str> = head.split(',').collect();
    assert_eq!((columns.len(), columns[0], columns[9]), (17, "time_s", "probe_1_u_r_m"));
    assert_eq!(columns[8], "probe_0_sigma_ry_pa");
    let rows: Vec<Vec<f64>> = rows
        .lines()
        .map(|row| row.split(',').map(|number| number.parse().unwrap()).collect())
        .collect();
    assert!(rows.len() > 100 && rows.iter().all(|row| row.len() == 17), "{}", rows.len());
    // The axis stays where it is and is compressed.
    assert!(rows.iter().all(|row| row[1] == 0.0 && row[8] == 0.0));
    assert!(rows.iter().any(|row| row[6] < -1e6));
}

#[test]
fn an_older_result_is_replaced_and_the_users_files_in_it_are_kept() {
    let place = Place::new();
    place.succeed("case.toml --out out");
    place.write("out/notes.txt", "mine");
    std::fs::create_dir(place.path("out/plots")).unwrap();
    place.write("out/plots/force.svg", "mine too");
    place.write("other.toml", crate::common::CASE);
    place.succeed(["other.toml", "--out", "out", "--set", "output.snapshots=['maximum']"]);
    let files = "contact.csv history.csv notes.txt other.pvd other.vtu.series other_0_maximum.vtu plots \
                 report.html summary.json";
    assert_eq!(place.list("out").join(" "), files);
    assert_eq!(place.read("out/notes.txt"), b"mine");
    assert_eq!(place.read("out/plots/force.svg"), b"mine too");
    assert_eq!(place.list("."), ["case.toml", "other.toml", "out"]);
    // A file of the user with a name that the program now needs.
    place.write("out/case_0_maximum.vtu", "mine");
    place.succeed(["case.toml", "--out", "out", "--set", "output.snapshots=['maximum']"]);
    assert_eq!(place.read("out/case_0_maximum.vtu.kept"), b"mine");
}

#[test]
fn foreign_and_current_folders_are_rejected_as_result_folder() {
    let place = Place::new();
    for (name, text) in [("notes.txt", "mine"), ("summary.json", "{\"program\": \"other\"}")] {
        let folder = format!("folder of {name}");
        std::fs::create_dir(place.path(&folder)).unwrap();
        place.write(&format!("{folder}/{name}"), text);
        let ran = place.fails(2, ["case.toml", "--out", &folder]);
        assert!(
            ran.stderr.contains(&folder) && ran.stderr.contains("move this one"),
            "{}",
            ran.stderr
        );
        assert_eq!(place.list(&folder), [name]);
    }
    std::fs::create_dir(place.path("out")).unwrap();
    place.succeed("case.toml --set model=ting --out out");
    assert!(place.path("out/summary.json").exists());
    // Nor is the current folder replaced.
    let mut command = place.command("../case.toml --set model=ting --out .");
    let ran: crate::common::Ran = command.current_dir(place.path("out")).output().unwrap().into();
    assert_eq!(ran.code, Some(2));
    ran.tells("you are in");
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_stays_and_what_it_points_at_is_replaced() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    std::fs::create_dir_all(place.path("disk/real")).unwrap();
    symlink("disk/real", place.path("link")).unwrap();
    for _ in 0..2 {
        place.succeed("case.toml --set model=ting --out link");
        assert!(place.path("link").symlink_metadata().unwrap().is_symlink());
        assert!(place.path("disk/real/summary.json").exists());
        assert_eq!(place.list("disk"), ["real"]);
    }
    symlink("nowhere", place.path("dangling")).unwrap();
    place.fails(2, "case.toml --out dangling").tells("symbolic link");
}

#[test]
fn failed_run_writes_a_result_marked_incomplete() {
    let place = Place::new();
    place.succeed("case.toml --set model=ting --out out");
    // A run that is rejected leaves it alone.
    let before = place.read("out/summary.json");
    place.fails(2, "case.toml --out out --set body.0.approach_speed=-1");
    assert_eq!((place.read("out/summary.json"), place.list(".").len()), (before, 2));
    for out in ["out/", "fresh"] {
        place.fails(1, ("case.toml --force --out", [out], set(&FAILS))).tells("marked incomplete");
        let summary = place.json(&format!("{}/summary.json", out.trim_end_matches('/')));
        assert_eq!(summary["complete"], false);
        assert!(summary["stopped_because"].is_string());
    }
    assert_eq!(place.list("."), ["case.toml", "fresh", "out"]);
    place.succeed("case.toml --set model=ting --out out --force");
    assert_eq!(place.json("out/summary.json")["complete"], true);
}

#[test]
fn concurrent_runs_do_not_mix_their_files() {
    let place = Place::new();
    let labels = ["mid-compression", "maximum", "mid-separation"];
    for _ in 0..3 {
        let children = labels.map(|label| {
            let set = format!("output.snapshots=['{label}']");
            let arguments = ["case.toml", "--quiet", "--out", "out", "--set", &set];
            place.command(arguments).spawn().unwrap()
        });
        for mut child in children {
            assert_eq!(child.wait().unwrap().code(), Some(0));
        }
        let summary = place.json("out/summary.json");
        let mut listed: Vec<&str> = summary["files"]
            .as_array()
            .unwrap()
            .iter()
            .map(|name| name.as_str().unwrap())
            .collect();
        listed.sort_unstable();
        assert_eq!(place.list("out"), listed);
        assert_eq!(place.list("."), ["case.toml", "out"]);
    }
}
