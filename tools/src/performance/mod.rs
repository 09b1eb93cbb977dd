//! The cost of runs: element updates with all laws, whole processes, and the phases of a run by time. Writes the tables
//! of docs/performance.md.
//!
//! `cargo build --release && cargo run --release -p fem-tools -- performance docs/performance.md`
//!
//! Times are medians of turns that alternate, so that other work of the machine affects all alike. They are compared
//! with plain code on the same elements in the same run.

#[path = "../../../crates/fem-explicit/benches/bodies/mod.rs"]
mod bodies;
mod elements;
#[path = "../../../crates/fem-explicit/benches/plain/mod.rs"]
mod plain;
mod processes;
mod profile;

use crate::{Error, page, timing};

/// Writes the tables into a page, or prints them.
pub fn run(words: &[String]) -> Result<(), Error> {
    let put = |name: &str, table: &str| page::put_or_print(words.first(), name, table);
    put("machine", &format!("{}.", timing::machine()))?;
    put("elements", &elements::table()?)?;
    put("processes", &processes::table()?)?;
    put("profile", &profile::table()?)?;
    Ok(())
}
