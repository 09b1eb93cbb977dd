//! What each way to keep surfaces apart does to a collision, and what it costs. Writes the table of
//! docs/contact.md.
//!
//! `cargo run --release -p fem-run --example contact -- docs/contact.md`
//!
//! A run gives the same table on every machine, but for its last column.

#![allow(clippy::disallowed_macros, reason = "a study prints what it found")]

#[path = "page/mod.rs"]
mod page;
#[path = "contact/rows.rs"]
mod rows;

use std::path::Path;

use rows::rows;

const HEAD: &str = "\
| scene | method | factor | e, 1e-4 off | T, % off | F, % off | noise | imbalance | contacts | step, ns | \
element updates | time, ms |
|---|---|---|---|---|---|---|---|---|---|---|---|
";
/// Of which the shortest counts: others share the caches.
const RUNS: usize = 7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let simulations: Vec<_> = rows().iter().map(|row| (*row, row.simulation())).collect();
    let mut lines = vec![(f64::INFINITY, Vec::new()); simulations.len()];
    // By turns: a drift of the machine is shared by all.
    for _ in 0..RUNS {
        for ((row, simulation), (shortest, cells)) in simulations.iter().zip(&mut lines) {
            let begin = seconds_on_core()?;
            let run = simulation.run(&mut ());
            *shortest = f64::min(*shortest, seconds_on_core()? - begin);
            *cells = row.cells(&run);
        }
    }
    let mut table = HEAD.to_string();
    for (shortest, cells) in &lines {
        let line = format!("| {} | {:.0} |\n", cells.join(" | "), 1e3 * shortest);
        eprint!("{line}");
        table.push_str(&line);
    }
    match std::env::args().nth(1) {
        Some(path) => page::put(Path::new(&path), "table", &table)?,
        None => print!("{table}"),
    }
    Ok(())
}

/// What this thread has had of a core, as Linux counts it.
fn seconds_on_core() -> Result<f64, Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    Ok(1e-9 * text.split(' ').next().unwrap_or_default().parse::<f64>()?)
}
