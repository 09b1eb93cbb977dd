//! Checks the table of docs/effects.md: its rows are the existing effects, its bytes those of a run. Times are not
//! tested.

use std::collections::BTreeSet;

use fem::effects::{EFFECTS, Effect, Support};

use crate::pages::Page;

// The benchmark uses the whole module.
#[allow(dead_code)]
#[path = "../../../../tools/src/effects/rows.rs"]
mod rows;

use rows::ROWS;

/// Rows of optional records, which are no effects of a collision.
const KEPT: [&str; 3] = ["history", "snapshots", "stress recovery"];

/// Returns the cells of the table's lines.
fn lines() -> Vec<Vec<String>> {
    let page = Page::load("docs/effects.md");
    let lines = page.text.lines().skip_while(|line| !line.starts_with("| effect |")).skip(2);
    let lines = lines.take_while(|line| line.starts_with('|'));
    lines
        .map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().into()).collect())
        .collect()
}

#[test]
fn effects_page_has_the_rows_of_the_benchmark() {
    let shown: Vec<[String; 2]> =
        lines().iter().map(|cells| [cells[0].replace('`', ""), cells[1].clone()]).collect();
    let expected: Vec<[String; 2]> =
        ROWS.iter().map(|row| [row.name.into(), row.kind.into()]).collect();
    assert_eq!(shown, expected, "cargo run --release -p fem-tools -- effects writes the page");
}

/// Every effect that explicit elements compute in some scene of the table has a row, and nothing else has.
#[test]
fn every_effect_that_is_computed_has_a_row() {
    let mut computed = BTreeSet::new();
    for row in ROWS {
        let simulation = row.on.simulation();
        let estimate = &simulation.setup().estimate;
        let is_computed = |effect: &&dyn Effect| {
            let support = simulation.support(*effect, estimate);
            support.is_some_and(|support| support != Support::Lacks)
        };
        computed.extend(EFFECTS.into_iter().filter(is_computed).map(|effect| effect.name()));
    }
    let rows: BTreeSet<&str> = ROWS.iter().map(|row| row.name).collect();
    let kept = BTreeSet::from(KEPT);
    assert_eq!(rows, computed.union(&kept).copied().collect());
}

/// An effect is off on one side of its row and on on the other.
#[test]
fn effects_benchmark_compares_each_effect_off_and_on() {
    for row in ROWS.iter().filter(|row| !KEPT.contains(&row.name)) {
        let is_on = |side: &rows::Side| {
            let simulation = side.simulation();
            let decisions = &simulation.setup().decisions.all;
            decisions.iter().find(|decision| decision.name == row.name).unwrap().active
        };
        if let Some(off) = &row.off {
            assert!(!is_on(off) && is_on(&row.on), "{}: {}", row.name, row.kind);
        }
    }
}

/// The restart state at the start has the size of that at the end, except for a few numbers that grow.
#[test]
fn effects_page_restart_sizes_equal_those_of_runs() {
    for (row, cells) in ROWS.iter().zip(lines()) {
        let sides = [(row.off, &cells[7]), (Some(row.on), &cells[8])];
        for (side, shown) in sides {
            let Some(side) = side.filter(|side| side.kept == rows::Kept::Quantities) else {
                continue;
            };
            let simulation = side.simulation();
            let contact = side.contact();
            let start = rows::n_bytes(side.start(contact.as_ref(), &simulation).as_ref());
            let shown: usize = shown.parse().unwrap();
            // The number of steps, and data of a contact that exist only after it.
            assert!((start..start + 512).contains(&shown), "{}: {start} {shown}", row.name);
        }
    }
}
