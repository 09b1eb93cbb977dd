//! `fem-run accuracy`: its files, its time budget, and the input that it rejects.

use crate::common::{CASE, Place};

/// The elastic pair of the tests; its limits leave only coarse meshes, on any machine.
fn elastic() -> Place {
    let (head, tail) = CASE.split_once("[material.glass.relaxation]").unwrap();
    let (_, tail) = tail.split_once("[[body]]").unwrap();
    Place::with(&format!("{head}[[body]]{tail}[limits]\nelements = 2000\nelement_updates = 4e6\n"))
}

#[test]
fn a_table_a_page_and_a_picture_are_written() {
    let place = elastic();
    place.fails(0, "accuracy case.toml --out out");
    assert_eq!(place.list("out"), ["accuracy.csv", "accuracy.json", "accuracy.md", "accuracy.svg"]);
    let csv = place.text("out/accuracy.csv");
    let header: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    for column in ["settings", "element_updates", "seconds", "restitution", "peak_pressure_error"] {
        assert!(header.contains(&column), "{column}: {header:?}");
    }
    for series in ["Hertz", "condensed", "the case as written"] {
        assert!(csv.lines().any(|line| line.starts_with(series)), "{series}:\n{csv}");
    }
    let page = place.text("out/accuracy.md");
    assert!(page.contains("![errors over seconds](accuracy.svg)"), "{page}");
    // The suggested setting is valid input.
    let advised = page.split("--set '").nth(1).and_then(|rest| rest.split('\'').next()).unwrap();
    place.succeed(["case.toml", "--set", advised, "--out", "advised", "--quiet"]);
    // A repeated study replaces the result.
    place.succeed("accuracy case.toml --budget 1e-3 --out out --quiet");
    let page = place.text("out/accuracy.md");
    assert!(page.contains("were left out"), "{page}");
}

/// The tolerance decides which variants are suggested.
#[test]
fn accuracy_suggests_variants_for_the_given_tolerance() {
    let place = elastic();
    for (tolerance, begins) in [
        ("1 %", "Within 1 % in e, T and F and 3 % in the peak pressure: "),
        ("0.000001", "No variant that was computed is within 0.0001 % in e, T and F"),
    ] {
        let ran = place.fails(
            0,
            ["accuracy", "case.toml", "--tolerance", tolerance, "--out", "out", "--force"],
        );
        assert!(ran.stdout.lines().any(|line| line.starts_with(begins)), "{}", ran.stdout);
    }
}

#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let place = elastic();
    for (arguments, said) in [
        (&["--budget", "0"][..], "give seconds, greater than 0"),
        (&["--budget", "soon"], "give seconds, greater than 0"),
        (&["--tolerance", "2"], "at most 0.5"),
        (&["--tolerance", "much"], "accuracy.tolerance"),
        (&["--set", "mesh.contact_element_size=-1"], "greater than 0"),
        (&["--set", "limits.elements=10"], "at most 10 are allowed"),
    ] {
        let all = [&["accuracy", "case.toml"], arguments].concat();
        place.fails(2, &all).tells(said);
        assert_eq!(place.list("."), ["case.toml"]);
    }
}
