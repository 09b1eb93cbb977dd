//! Checks that docs/results.md names the keys, columns and files of a result folder.

use std::collections::BTreeSet;

use fem::results::energy_key;
use fem::sweep::COLUMNS;
use fem_collision::{Account, ShownIn};

use crate::common::Place;
use crate::pages::Page;

fn keys(summary: &serde_json::Value, pointer: &str) -> BTreeSet<String> {
    summary.pointer(pointer).and_then(|value| value.as_object()).unwrap().keys().cloned().collect()
}

#[test]
fn results_page_has_the_keys_columns_and_arrays_of_a_result() {
    let (page, place) = (Page::load("docs/results.md"), Place::new());
    place.succeed("case.toml --quiet");
    keys_of_a_summary_are_those_of_the_page(&page, &place);
    energies_are_those_of_the_accounts(&page, &place);
    columns_of_a_history_are_those_of_the_page(&page, &place);
    snapshots_have_the_arrays_and_names_of_the_page(&page, &place);
}

fn keys_of_a_summary_are_those_of_the_page(page: &Page, place: &Place) {
    let summary = place.json("runs/case/summary.json");
    let (_, listed) = page.first_columns("key").remove(0);
    assert_eq!(BTreeSet::from_iter(listed), keys(&summary, ""));
    // The second cell of a row names exactly the keys of an object.
    for (row, pointer) in [("bodies", "/bodies/0"), ("cost", "/cost")] {
        let named = named_in_row(page, row);
        assert_eq!(BTreeSet::from_iter(named), keys(&summary, pointer), "{pointer}");
    }
}

/// Returns the code in the second cell of the row of a key.
fn named_in_row(page: &Page, key: &str) -> Vec<String> {
    let mut rows = page.text.lines().filter(|line| line.starts_with(&format!("| `{key}` |")));
    let row = rows.next().unwrap().splitn(3, '|').nth(2).unwrap();
    row.split('`').skip(1).step_by(2).map(String::from).collect()
}

/// Page and summary have every account of energy in the order of the table of accounts; a summary omits optional
/// accounts that its run does not use.
fn energies_are_those_of_the_accounts(page: &Page, place: &Place) {
    let named = named_in_row(page, "energy");
    let accounts = Account::all().map(energy_key);
    let of_table = ["initial_j".to_string()].into_iter().chain(accounts);
    let of_table: Vec<_> = of_table
        .chain(["locked_in_j", "residual_j", "residual_relative"].map(String::from))
        .collect();
    assert_eq!(named, of_table);
    let is_optional = |key: &String| {
        key == "locked_in_j"
            || Account::all()
                .any(|one| energy_key(one) == *key && one.shown() == ShownIn::WhereFilled)
    };
    let summary = place.json("runs/case/summary.json");
    let written: Vec<&String> = summary["energy"].as_object().unwrap().keys().collect();
    let expected: Vec<&String> =
        named.iter().filter(|key| !is_optional(key) || written.contains(key)).collect();
    assert_eq!(written, expected);
    // Sweeps have one column per account.
    let sweeps = Page::load("docs/sweeps.md");
    for key in of_table {
        assert!(sweeps.code().iter().any(|code| code.text == key), "docs/sweeps.md has no {key}");
        assert!(COLUMNS.contains(&format!("energy_{key}")), "sweep.csv has no {key}");
    }
}

fn columns_of_a_history_are_those_of_the_page(page: &Page, place: &Place) {
    let history = place.text("runs/case/history.csv");
    let code = page.code();
    let listed = code.iter().find(|code| code.text.starts_with("time_s, ")).unwrap();
    let velocities = "velocity_striker_m_s, velocity_target_m_s";
    let listed = listed.text.replace("velocity_<body>_m_s …", velocities).replace(", ", ",");
    assert_eq!(history.lines().next(), Some(listed.as_str()));
}

fn snapshots_have_the_arrays_and_names_of_the_page(page: &Page, place: &Place) {
    let files = place.list("runs/case");
    for ending in ["case.pvd", "case.vtu.series", "case_0_mid-compression.vtu"] {
        assert!(files.iter().any(|file| file == ending), "{ending} is not in {files:?}");
    }
    let grid = place.read("runs/case/case_0_mid-compression.vtu");
    let grid = String::from_utf8_lossy(&grid);
    let arrays: BTreeSet<&str> =
        grid.split("Name=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let code: Vec<String> = page.code().into_iter().map(|code| code.text).collect();
    let named = |array: &str| code.iter().any(|code| code.split(", ").any(|name| name == array));
    let of_the_grid = ["Points", "TimeValue", "connectivity", "offsets", "types"];
    for array in arrays.iter().filter(|array| !of_the_grid.contains(array)) {
        assert!(named(array), "docs/results.md has no {array}");
    }
    for array in ["displacement", "velocity", "sigma_rr", "von_mises", "body"] {
        assert!(arrays.contains(array), "there is no array {array}");
    }
}
