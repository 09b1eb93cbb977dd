//! The cost estimates of `fem-run check` and of runs, and the cost that runs report.

use crate::common::Place;

/// Rubber for which the first mesh misses 1 %.
const RUBBER: &str = "
material.rubber = { density = 1100, youngs_modulus = '1 MPa', poissons_ratio = 0.45, hyperelastic = 'neo-hooke' }
body = [{ name = 'wall', wall = {} },
        { name = 'ball', sphere.diameter = '3 cm', material = 'rubber', approach_speed = '3 m/s' }]
output.snapshots = []
";
/// Glass with a much larger shear modulus than bulk modulus.
const AUXETIC: &str = "
material.glass = { density = 2500, youngs_modulus = '60 GPa', poissons_ratio = -0.99 }
body = [{ name = 'lower', sphere.diameter = '1 cm', material = 'glass' },
        { name = 'upper', sphere.diameter = '1 cm', material = 'glass', approach_speed = '1 m/s' }]
output.snapshots = []
";

/// Runs on meshes that were refined later are counted separately; if the first mesh suffices, there are
/// none.
#[test]
fn summary_separates_trial_time_from_solve_time() {
    let place = Place::new();
    place.write("rubber.toml", RUBBER);
    place.write("auxetic.toml", AUXETIC);
    for (case, has_trials) in [("rubber.toml", true), ("auxetic.toml", false)] {
        let ran = place.succeed([case, "--verbose", "--out", case.trim_end_matches(".toml")]);
        let summary = place.json(&format!("{}/summary.json", case.trim_end_matches(".toml")));
        let seconds = |key: &str| summary["cost"][key].as_f64().unwrap();
        assert_eq!(seconds("trials_s") > 0.0, has_trials, "{case}: {}", summary["cost"]);
        assert!(seconds("setup_s") + seconds("trials_s") + seconds("solve_s") <= seconds("wall_s"));
        // Both had a mesh that was too coarse; only one of these meshes was run.
        assert!(!summary["coarser_meshes"].as_array().unwrap().is_empty());
        let first = &summary["coarser_meshes"][0];
        assert_eq!(first["element_updates"].is_null(), !has_trials, "{first}");
        assert_eq!(ran.stdout.contains(" of trial runs"), has_trials, "{}", ran.stdout);
        assert_eq!(ran.stderr.contains("adaptive refinement may add at most "), has_trials);
    }
}

/// A run and its check each announce one time, with one digit. A short report states no other time. The time depends on the
/// machine and its load; the element updates of the first mesh, from which it follows, are those of the run.
#[test]
fn run_and_check_announce_one_time() {
    let place = Place::new();
    place.write("rubber.toml", RUBBER);
    let time = |text: &str| {
        let (_, after) = text.split_once("about ").unwrap_or_else(|| panic!("no time: {text}"));
        let (time, _) = after.split_once(" s").unwrap_or_else(|| panic!("not in seconds: {text}"));
        assert_eq!(time.trim_start_matches(['0', '.']).trim_end_matches('0').len(), 1, "{time}");
        assert!(time.parse::<f64>().unwrap() > 0.0, "{time}");
    };
    let ran = place.succeed("rubber.toml --out out");
    let checked = place.succeed("check rubber.toml").stdout;
    let row = |name: &str| checked.lines().find(|line| line.starts_with(name)).unwrap();
    time(&ran.stderr);
    time(row("time  "));
    let told = row("element updates  ").split_once("about ").unwrap().1;
    let told = told.split(',').next().unwrap().trim().parse::<f64>().unwrap();
    let first = &place.json("out/summary.json")["coarser_meshes"][0]["element_updates"];
    let ratio = told / first.as_f64().unwrap();
    assert!((0.8..1.25).contains(&ratio), "{told} {first}");
    assert_eq!(ran.stderr.matches(" s,").count(), 1, "{}", ran.stderr);
    assert!(!ran.stdout.contains("cost"), "{}", ran.stdout);
}

/// `check` names the refined mesh if it is known before the run, and else the upper bound of refinement;
/// also for condensed bodies.
#[test]
fn check_states_the_refined_mesh_or_the_refinement_bound() {
    let place = Place::new();
    place.write("rubber.toml", RUBBER);
    place.write("auxetic.toml", AUXETIC);
    let open = place.succeed("check rubber.toml").stdout;
    let finer = open.lines().find(|line| line.starts_with("mesh refinement  ")).unwrap();
    for words in
        ["misses accuracy.tolerance: at most ", " finer meshes, ", " element updates more, "]
    {
        assert!(finer.contains(words), "{finer}");
    }
    let told = place.succeed("check auxetic.toml").stdout;
    assert!(told.contains("finer mesh  ") && !told.contains("misses accuracy.tolerance"), "{told}");
    let resolved = place.succeed("check auxetic.toml --resolved").stdout;
    place.write("resolved.toml", &resolved);
    let again = place.succeed("resolved.toml --out again");
    assert!(!again.stderr.contains("refined"), "{}", again.stderr);
    place.succeed("auxetic.toml --out out");
    for key in ["restitution", "peak_force_n"] {
        assert_eq!(place.json("again/summary.json")[key], place.json("out/summary.json")[key]);
    }
    let condensed = place.succeed(["check", "case.toml", "--set", "model.condensed={}"]).stdout;
    assert!(condensed.lines().count() <= 24 && !condensed.contains("aspect ratio"), "{condensed}");
    let time = condensed.lines().find(|line| line.starts_with("time  ")).unwrap();
    assert!(time.contains("about ") && time.ends_with(" here"), "{time}");
    // Small mass scaling is not rounded to zero.
    let tight = ["accuracy.tolerance=1e-5", "mesh.contact_element_size='50 um'"];
    let told =
        place.succeed(["check", "case.toml", "-v", "--set", tight[0], "--set", tight[1]]).stdout;
    let row = told.lines().find(|line| line.starts_with("time.mass_scaling")).unwrap();
    assert!(row.contains("e-") && !row.contains("0.00"), "{row}");
    // The case gives its element size.
    assert!(!condensed.contains("mesh refinement"), "{condensed}");
    let open = place.succeed(["check", "auxetic.toml", "--set", "model.condensed={}"]).stdout;
    let most = "misses accuracy.tolerance: at most 4 finer meshes, ";
    assert!(open.contains(most) && open.contains("s more\n"), "{open}");
}

/// Spheres of metres may be intended: their sizes are printed with the unit, without a warning.
#[test]
fn check_prints_the_size_of_metre_spheres_without_a_warning() {
    let place = Place::new();
    let run = |command: &str, value: &str| {
        let sizes = [0, 1].map(|k| format!("--set body.{k}.sphere.diameter={value}"));
        let sizes: Vec<&str> = sizes.iter().flat_map(|set| set.splitn(2, ' ')).collect();
        place.succeed((command, "case.toml --set model=hertz", &sizes))
    };
    for (value, is_told) in
        [("22.2m", true), ("'2 m'", true), ("'99 cm'", false), ("0.0222", false)]
    {
        let words = "(bare numbers are in metres)";
        let checked = run("check", value);
        assert_eq!(checked.stdout.contains(words), is_told, "{value}: {}", checked.stdout);
        let ran = run("--force --out out", value);
        assert_eq!(ran.stderr.contains(words), is_told, "{value}: {}", ran.stderr);
        assert!(!ran.stderr.contains("warning: the diameter"), "{}", ran.stderr);
    }
}

/// A sweep's cost estimate includes the mesh refinement that some members need.
#[test]
fn sweep_cost_estimate_includes_mesh_refinement() {
    let place = Place::new();
    place.write("rubber.toml", RUBBER);
    let sweep = "case = 'rubber.toml'\nvary.'accuracy.tolerance' = ['1 %', '3 %']\n";
    place.write("sweep.toml", sweep);
    let told = |set: &str| {
        let ran = place.succeed(["sweep", "sweep.toml", "--dry-run", "--set", set]);
        ran.stderr.contains(" threads, up to ")
            && ran.stderr.contains("if meshes have to be refined")
    };
    assert!(told("model.fem={}"));
    assert!(!told("mesh.contact_element_size=8e-4"));
    assert!(!told("model.ting={}"));
}

/// The reference run for a given mesh follows the collision and may take ten times its memory. The estimate
/// is within a factor of 1.7, since bytes per element come from other scenes.
#[test]
fn memory_estimate_includes_the_reference_run() {
    let place = Place::new();
    place.write("polymer.toml", include_str!("../../../../cases/polymer_ten_terms.toml"));
    place.write("wall.toml", include_str!("../../../../cases/glass_on_wall.toml"));
    let announced = |text: &str| {
        let words: Vec<&str> = text.split(&[' ', ';', '\n']).collect();
        let unit = words.windows(3).position(|it| it[0] == "about" && it[2] == "MB").unwrap();
        1e6 * words[unit + 1].parse::<f64>().unwrap()
    };
    for (case, model, least) in [
        ("polymer.toml", "model.fem={}", 5e7),
        ("polymer.toml", "model.condensed={}", 0.0),
        ("wall.toml", "model.fem={}", 0.0),
    ] {
        let set = ["--set", model, "--set", "mesh.contact_element_size='26 um'"];
        let all = |first: &[&'static str]| [first, &set].concat();
        let ran = place.succeed(all(&[case, "--force", "--out", "out"]));
        let spent = place.json("out/summary.json")["cost"]["peak_memory_bytes"].as_f64().unwrap();
        let line = ran.stderr.lines().next().unwrap().to_string();
        for told in [line, place.succeed(all(&["check", case])).stdout] {
            let ratio = spent / announced(told.split("memory  ").last().unwrap());
            assert!((1.0 / 1.7..1.7).contains(&ratio), "{case} {model}: {spent} {told}");
        }
        assert!(spent > least, "{case} {model}: {spent}");
    }
}
