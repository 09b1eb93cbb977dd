//! What each way to keep surfaces apart does to a collision, and what it costs. Writes the table of
//! docs/contact.md.
//!
//! `cargo run --release -p fem-run --example contact -- docs/contact.md`
//!
//! There are no times in it: a run gives the same table on every machine.

#![allow(clippy::disallowed_macros, reason = "a study prints what it found")]

#[path = "contact/rows.rs"]
mod rows;

use rows::rows;

/// Between these lines of the page stands the table.
const MARKS: [&str; 2] = ["<!-- table -->\n", "<!-- end of table -->\n"];

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
