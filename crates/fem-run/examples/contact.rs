//! What each way to keep surfaces apart does to a collision, and what it costs. Writes the table of
//! docs/contact.md.
//!
//! `cargo run --release -p fem-run --example contact -- docs/contact.md`
//!
//! There are no times in it: a run gives the same table on every machine.

#![allow(clippy::disallowed_macros, reason = "a study prints what it found")]

#[path = "page/mod.rs"]
mod page;
#[path = "contact/rows.rs"]
mod rows;

use std::path::Path;

use rows::rows;

const HEAD: &str = "\
| scene | method | factor | e, 1e-4 off | T, % off | F, % off | noise | imbalance | contacts | step, ns | \
element updates |
|---|---|---|---|---|---|---|---|---|---|---|
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut table = HEAD.to_string();
    for row in rows() {
        let line = format!("| {} |\n", row.cells(&row.simulation().run(&mut ())).join(" | "));
        eprint!("{line}");
        table.push_str(&line);
    }
    match std::env::args().nth(1) {
        Some(path) => page::put(Path::new(&path), "table", &table)?,
        None => print!("{table}"),
    }
    Ok(())
}
