//! The cost of effects: time of a step, work and bytes of state, with the effect off and on. Writes the table of
//! docs/effects.md.
//!
//! `cargo run --release -p fem-tools -- effects docs/effects.md`
//!
//! Times are medians of runs that take turns, so that other work of the machine affects both alike. Updates and bytes
//! are counters, the same on every machine.

mod rows;

use std::fmt::Write;
use std::time::Instant;

use crate::timing::median;
use crate::{Error, page, timing};
use rows::{Kept, ROWS, Row, Side, n_bytes};

/// Runs with and without the effect.
const N_RUNS: usize = 9;

/// The cost of a run.
struct Cost {
    /// Solution time, ns per element update.
    time: f64,
    element_updates: u64,
    bytes: usize,
}

/// Writes the table into a page, or prints it.
pub fn run(words: &[String]) -> Result<(), Error> {
    let table = ROWS.iter().map(line).collect::<String>();
    let machine = timing::machine();
    let table = format!(
        "{machine}: medians of {N_RUNS} runs of each side, which take turns.\n\n{HEAD}{table}"
    );
    page::put_or_print(words.first(), "table", &table)
}

const HEAD: &str = "\
| effect | kind | ns per update, off | on | ratio | element updates, off | on | bytes of state, off | on |
|---|---|---|---|---|---|---|---|---|
";

/// Returns a row of the table.
fn line(row: &Row) -> String {
    let sides: Vec<Side> = row.off.into_iter().chain([row.on]).collect();
    let simulations: Vec<_> = sides.iter().map(Side::simulation).collect();
    let mut costs: Vec<Vec<Cost>> = sides.iter().map(|_| Vec::new()).collect();
    for _ in 0..N_RUNS {
        for ((side, simulation), costs) in sides.iter().zip(&simulations).zip(&mut costs) {
            costs.push(cost(side, simulation));
        }
    }
    let times: Vec<f64> =
        costs.iter().map(|costs| median(costs.iter().map(|cost| cost.time).collect())).collect();
    let first: Vec<&Cost> = costs.iter().map(|costs| &costs[0]).collect();
    let mut line = format!("| `{}` | {} |", row.name, row.kind);
    let (on_time, on) = (times[times.len() - 1], first[first.len() - 1]);
    let _ = match row.off {
        None => writeln!(
            line,
            " – | {on_time:.1} | – | – | {} | – | {} |",
            on.element_updates, on.bytes
        ),
        Some(_) => {
            let ratios = costs[0].iter().zip(&costs[1]).map(|(off, on)| on.time / off.time);
            writeln!(
                line,
                " {:.1} | {on_time:.1} | {:.2} | {} | {} | {} | {} |",
                times[0],
                median(ratios.collect()),
                first[0].element_updates,
                on.element_updates,
                first[0].bytes,
                on.bytes
            )
        }
    };
    eprint!("{line}");
    line
}

/// Returns the cost of a run from first touch to its end.
fn cost(side: &Side, simulation: &fem::Simulation) -> Cost {
    let contact = side.contact();
    let begin = Instant::now();
    let mut stepper = side.start(contact.as_ref(), simulation);
    let mut spent = begin.elapsed();
    // The instants of the force pulse are recorded with any effects; they do not count.
    let bytes = n_bytes(stepper.as_ref());
    let begin = Instant::now();
    while stepper.advance(&mut ()) {}
    spent += begin.elapsed();
    let begin = Instant::now();
    let collision = stepper.finish();
    if side.kept == Kept::Stress {
        for snapshot in &collision.snapshots {
            for side in 0..2 {
                let stress = simulation.stress(snapshot, side);
                std::hint::black_box(stress.is_some());
            }
        }
    }
    spent += begin.elapsed();
    let element_updates = collision.element_updates.expect("explicit elements");
    Cost { time: 1e9 * spent.as_secs_f64() / element_updates as f64, element_updates, bytes }
}
