//! Compares the contact methods: results and cost. Writes the table of docs/contact.md.
//!
//! `cargo run --release -p fem-tools -- contact docs/contact.md`
//!
//! Apart from its last column the table is the same on every machine.

mod rows;

use crate::{Error, page};
use rows::rows;

const HEAD: &str = "\
| scene | method | factor | e, 1e-4 off | T, % off | F, % off | noise | imbalance | contacts | step, ns | \
element updates | time, ms |
|---|---|---|---|---|---|---|---|---|---|---|---|
";
/// Number of runs; the shortest counts, since other programs share the caches.
const RUNS: usize = 7;

/// Writes the table into a page, or prints it.
pub fn run(words: &[String]) -> Result<(), Error> {
    let simulations: Vec<_> = rows().iter().map(|row| (*row, row.simulation())).collect();
    let mut lines = vec![(f64::INFINITY, Vec::new()); simulations.len()];
    // Runs take turns, so a drift of the machine affects all alike.
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
    page::put_or_print(words.first(), "table", &table)
}

/// Returns the processor time of this thread, as Linux counts it.
fn seconds_on_core() -> Result<f64, Error> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    Ok(1e-9 * text.split(' ').next().unwrap_or_default().parse::<f64>()?)
}
