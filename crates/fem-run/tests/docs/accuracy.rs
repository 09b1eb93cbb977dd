//! Checks the convergence table of the condensed model in docs/accuracy.md, except its times.

use crate::common::Place;
use crate::pages::{Page, root};

/// Case, summary key and unit in SI of each column.
const COLUMNS: [(&str, &str, f64); 4] = [
    ("glass_0.5ms_elastic", "contact_time_s", 1e-6),
    ("glass_0.5ms_elastic", "peak_force_n", 1.0),
    ("glass_0.5ms", "restitution", 1.0),
    ("glass_0.5ms_elastic_bulk", "restitution", 1.0),
];

#[test]
#[ignore = "8 s; .ci/run runs it"]
fn accuracy_page_table_equals_computed_results() {
    let (page, place) = (Page::load("docs/accuracy.md"), Place::new());
    let rows =
        page.text.lines().skip_while(|line| !line.starts_with("| elements at the contact |"));
    let rows = rows.skip(2).take_while(|line| line.starts_with('|') && !line.contains("limit"));
    let mut n_rows = 0;
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let size = format!("mesh.contact_element_size='{}'", cells[0]);
        let run = |case: &str| {
            let file = root().join(format!("cases/{case}.toml"));
            let set = [
                "--set",
                "model.condensed={}",
                "--set",
                &size,
                "--out",
                case,
                "--quiet",
                "--force",
            ];
            place.succeed(([file.to_str().unwrap()], set));
            place.json(&format!("{case}/summary.json"))
        };
        let elastic = run(COLUMNS[0].0);
        let summaries = [elastic.clone(), elastic, run(COLUMNS[2].0), run(COLUMNS[3].0)];
        for ((cell, (case, key, unit)), summary) in cells[1..].iter().zip(COLUMNS).zip(summaries) {
            let shown = cell.split(' ').next().unwrap();
            let n_decimals = shown.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let value = summary[key].as_f64().unwrap() / unit;
            assert_eq!(format!("{value:.n_decimals$}"), shown, "{size} of {case}: {key}");
        }
        n_rows += 1;
    }
    assert_eq!(n_rows, 4);
}
