//! The cost of runs: element updates with all laws, whole processes, and the phases of a run by time. Writes the tables
//! of docs/performance.md.
//!
//! `cargo build --release && cargo run --release -p fem-run --example performance -- docs/performance.md`
//!
//! Times are medians of turns that alternate, so that other work of the machine affects all alike. They are compared
//! with plain code on the same elements in the same run.

#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "a benchmark has the clock and prints what it found"
)]

#[path = "../../fem-explicit/benches/bodies/mod.rs"]
mod bodies;
#[path = "performance/elements.rs"]
mod elements;
#[path = "page/machine.rs"]
mod machine;
#[path = "page/mod.rs"]
mod page;
#[path = "../../fem-explicit/benches/plain/mod.rs"]
mod plain;
#[path = "performance/processes.rs"]
mod processes;
#[path = "performance/profile.rs"]
mod profile;

use std::path::Path;

use bodies::Error;

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1);
    let put = |name: &str, table: &str| -> Result<(), Error> {
        match &path {
            Some(path) => page::put(Path::new(path), name, table)?,
            None => println!("{table}"),
        }
        Ok(())
    };
    put("machine", &format!("{}.", machine::machine()))?;
    put("elements", &elements::table()?)?;
    put("processes", &processes::table()?)?;
    put("profile", &profile::table()?)?;
    Ok(())
}

/// Returns the median.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
