//! What each way to keep surfaces apart does to a collision, and what it costs. Writes the table of
//! docs/contact.md.
//!
//! `cargo run --release -p fem-run --example contact -- docs/contact.md`
//!
//! A run gives the same table on every machine, but for its last column.

#![allow(clippy::disallowed_macros, reason = "a study prints what it found")]

#[path = "contact/rows.rs"]
mod rows;

use rows::rows;

/// Between these lines of the page stands the table.
const MARKS: [&str; 2] = ["<!-- table -->\n", "<!-- end of table -->\n"];

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
    let Some(path) = std::env::args().nth(1) else {
        print!("{table}");
        return Ok(());
    };
    let page = std::fs::read_to_string(&path)?;
    let parts = page
        .split_once(MARKS[0])
        .and_then(|(before, rest)| rest.split_once(MARKS[1]).map(|(_, after)| [before, after]));
    let [before, after] = parts.ok_or("the page has no place for the table")?;
    let [begin, end] = MARKS;
    Ok(std::fs::write(path, format!("{before}{begin}\n{table}\n{end}{after}"))?)
}

/// What this thread has had of a core, as Linux counts it.
fn seconds_on_core() -> Result<f64, Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    Ok(1e-9 * text.split(' ').next().unwrap_or_default().parse::<f64>()?)
}
