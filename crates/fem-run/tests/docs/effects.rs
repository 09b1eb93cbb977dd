//! The table of what effects cost in docs/effects.md: its rows are the effects that there are, its
//! counters of a start are those of a run. Times are not tested.

use std::collections::BTreeSet;

use fem::effects::{Answer, EFFECTS};

use crate::pages::Page;

// The benchmark uses all of it.
#[allow(dead_code)]
#[path = "../../examples/effects/rows.rs"]
mod rows;

use rows::ROWS;

/// What a run keeps where it is asked to, and no effect of a collision.
const KEPT: [&str; 3] = ["history", "snapshots", "stress recovery"];

/// The cells of the table's lines.
fn lines() -> Vec<Vec<String>> {
    let page = Page::load("docs/effects.md");
    let lines = page.text.lines().skip_while(|line| !line.starts_with("| effect |")).skip(2);
    let lines = lines.take_while(|line| line.starts_with('|'));
    lines
        .map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().into()).collect())
        .collect()
}

#[test]
fn rows_are_those_of_the_benchmark() {
    let shown: Vec<[String; 2]> =
        lines().iter().map(|cells| [cells[0].replace('`', ""), cells[1].clone()]).collect();
    let expected: Vec<[String; 2]> =
        ROWS.iter().map(|row| [row.name.into(), row.kind.into()]).collect();
    assert_eq!(shown, expected, "cargo run --release -p fem-run --example effects writes the page");
}

/// Explicit elements have a row of each effect that they compute in some scene of the table, and there
/// is no row of anything else.
#[test]
fn every_effect_that_is_computed_has_a_row() {
    let mut computed = BTreeSet::new();
    for row in ROWS {
        let simulation = row.on.simulation();
        let estimate = &simulation.setup().estimate;
        let has = |name: &str| {
            let effect = EFFECTS.into_iter().find(|effect| effect.name() == name)?;
            simulation.model().has(effect, estimate).filter(|answer| *answer != Answer::Lacks)
        };
        computed
            .extend(EFFECTS.iter().map(|effect| effect.name()).filter(|name| has(name).is_some()));
    }
    let rows: BTreeSet<&str> = ROWS.iter().map(|row| row.name).collect();
    let kept = BTreeSet::from(KEPT);
    assert_eq!(rows, computed.union(&kept).copied().collect());
}

/// An effect is off on one side of its row and on on the other; steps that both do count its work.
#[test]
fn an_effect_is_off_on_one_side_and_on_on_the_other() {
    for row in ROWS.iter().filter(|row| !KEPT.contains(&row.name)) {
        let is_on = |side: &rows::Side| {
            let simulation = side.simulation();
            let verdicts = &simulation.setup().decisions.verdicts;
            verdicts.iter().find(|verdict| verdict.name == row.name).unwrap().active
        };
        if let Some(off) = &row.off {
            assert!(!is_on(off) && is_on(&row.on), "{}: {}", row.name, row.kind);
        }
    }
}

/// Counters of runs that keep nothing: the memory of a start has the size of the memory of an end, but
/// for the few numbers whose size grows with them.
#[test]
fn bytes_of_state_are_those_of_a_run() {
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
            // Numbers of steps, and what is known of a contact only once it was there.
            assert!((start..start + 512).contains(&shown), "{}: {start} {shown}", row.name);
        }
    }
}
