//! The same input in any form gives the same bits.

use crate::common::Place;

fn assert_same_files(place: &Place, a: &str, b: &str, names: &[&str]) {
    for name in names {
        let same = place.read(format!("{a}/{name}")) == place.read(format!("{b}/{name}"));
        assert!(same, "{name} differs between {a} and {b}");
    }
}

#[test]
fn two_runs_give_the_same_bytes() {
    let place = Place::new();
    place.succeed("case.toml --out a");
    place.succeed("case.toml --out b --threads 2");
    let files = place.list("a");
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    assert_eq!(place.list("b"), files);
    let without_cost: Vec<&str> = files
        .iter()
        .copied()
        .filter(|name| !["summary.json", "report.html"].contains(name))
        .collect();
    assert_same_files(&place, "a", "b", &without_cost);
    let [mut a, mut b] = ["a/summary.json", "b/summary.json"].map(|name| place.json(name));
    for summary in [&mut a, &mut b] {
        summary.as_object_mut().unwrap().remove("cost");
    }
    assert_eq!(a, b);
}

#[test]
fn printed_check_runs_to_the_same_bits() {
    let place = Place::new();
    let set = ["--set", "mesh.contact_element_size='80 um'", "--set", "start.gap=1e-6"];
    let quiet = place.succeed("check case.toml --quiet");
    assert_eq!(quiet.stdout, "");
    assert!(quiet.stderr.lines().all(|line| line.starts_with("warning: ")), "{}", quiet.stderr);
    let checked = place.succeed(("check case.toml --resolved", set)).stdout;
    assert_eq!(place.list("."), ["case.toml"]);
    let table: toml::Table = checked.parse().unwrap();
    assert_eq!(table["mesh"]["contact_element_size"].as_float(), Some(80e-6));
    assert_eq!(table["time"]["step_factor"].as_float(), Some(0.9));
    for expected in ["scaled Jacobian", "time step", "steps", "memory", "peak force", "off"] {
        assert!(checked.contains(expected), "{expected}: {checked}");
    }
    place.write("resolved.toml", &checked);
    place.succeed(("case.toml --out a", set));
    place.succeed("resolved.toml --out b");
    assert_same_files(&place, "a", "b", &["history.csv"]);
    // A resolved case resolves to itself.
    let again = place.succeed("check resolved.toml --resolved").stdout;
    assert_eq!(again.parse::<toml::Table>().unwrap(), table);
    assert_eq!(place.json("a/summary.json")["case"], place.json("b/summary.json")["case"]);
}

#[test]
fn exported_mesh_gives_the_bits_of_the_built_in_mesh() {
    let place = Place::new();
    place.succeed("mesh case.toml --out meshes").prints("scaled Jacobian");
    assert_eq!(place.list("meshes"), ["striker.vtu", "target.vtu"]);
    place.succeed("case.toml --out a");
    let with_meshes = [
        "--set",
        "body.0.sphere.mesh='meshes/striker.vtu'",
        "--set",
        "body.1.sphere.mesh='meshes/target.vtu'",
    ];
    place.succeed(("case.toml --out b", with_meshes));
    assert_same_files(&place, "a", "b", &["history.csv", "case_1_maximum.vtu"]);
    // The scene upside down. Both of the equal bodies are computed, as always for meshes from
    // files.
    place.succeed("mesh case.toml");
    let swapped = ["--set", "body.1.sphere={diameter='22.2 mm', mesh='meshes/case/striker.vtu'}"];
    let built_in =
        ["--set", "body.1.sphere={diameter='22.2 mm'}", "--set", "effects.mirror_symmetry='off'"];
    place.succeed(("case.toml --out c", swapped));
    place.succeed(("case.toml --out d", built_in));
    assert_same_files(&place, "c", "d", &["history.csv"]);
}

#[test]
fn a_mesh_replaces_only_a_mesh() {
    let place = Place::new();
    std::fs::create_dir(place.path("meshes")).unwrap();
    place.write("meshes/target.vtu", "mine");
    place.fails(2, "mesh case.toml --out meshes");
    assert_eq!(place.list("meshes"), ["target.vtu"]);
    assert_eq!(place.read("meshes/target.vtu"), b"mine");
    for size in ["60e-6", "70e-6"] {
        let set = format!("mesh.contact_element_size={size}");
        place.succeed(["mesh", "case.toml", "--set", &set]);
    }
}
