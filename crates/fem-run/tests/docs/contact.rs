//! Checks the table of docs/contact.md against the study's rows and against runs, except stiff penalty contact,
//! which takes too long.

use crate::pages::Page;

#[path = "../../../../tools/src/contact/rows.rs"]
mod rows;

/// Returns the cells of the table's lines.
fn lines() -> Vec<Vec<String>> {
    let page = Page::load("docs/contact.md");
    let lines = page.text.lines().skip_while(|line| !line.starts_with("| scene |")).skip(2);
    let lines = lines.take_while(|line| line.starts_with('|'));
    let cells = |line: &str| line.trim_matches('|').split('|').map(|c| c.trim().into()).collect();
    lines.map(cells).collect()
}

#[test]
#[ignore = "7 s; .ci/run runs it"]
fn contact_page_table_equals_computed_results() {
    let (rows, lines) = (rows::rows(), lines());
    assert_eq!(rows.len(), lines.len(), "cargo run --release -p fem-tools -- contact");
    for (row, line) in rows.iter().zip(lines) {
        let of_row = [row.scene.name.into(), format!("`{}`", row.method), row.factor.to_string()];
        assert_eq!(line[..3], of_row, "cargo run --release -p fem-tools -- contact");
        if row.factor == 1.0 || row.method == "massless" {
            let (time, line) = line.split_last().expect("cells");
            assert_eq!(line, row.cells(&row.simulation().run(&mut ())));
            assert!(time.parse::<u32>().is_ok_and(|ms| ms > 0), "{time}");
        }
    }
}
