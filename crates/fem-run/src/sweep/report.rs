//! What a sweep says: before it begins, when it is done, and how it ends.

use std::io::{Write, stderr};
use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::sweep::{Checked, Row, SWEEP_FILE};
use fem_case::engineering::show;
use fem_case::{Keep, Sweep};
use indicatif::DecimalBytes;

use super::collect::Collected;
use super::duration::duration;
use super::expected::{Expected, Total};
use super::packs::LINE_BYTES;
use crate::failure::Failure;
use crate::standard_output::one_line;
use crate::tables::table;

/// One line on stderr about what begins and what it takes.
pub fn announce(
    name: &str,
    sweep: &Sweep,
    checked: &Checked,
    expected: &Expected,
    n_own: usize,
    n_threads: usize,
) {
    let n_members = sweep.n_members();
    let n_left = checked.left.len();
    let shard = if n_own == n_members { String::new() } else { format!(", {n_own} in this shard") };
    let name = one_line(name);
    let time = match n_left {
        0 => String::new(),
        _ => {
            let on_threads = |total: Total| duration(total.on(n_threads));
            let most = expected.most.map_or(String::new(), |most| {
                format!(", up to {} if finer meshes have to follow", on_threads(most))
            });
            format!(", some {} on {n_threads} threads{most}", on_threads(expected.all))
        }
    };
    let kept = match sweep.keep {
        Keep::Packed if n_left > 0 => {
            format!("; one file of summaries, some {}", packed_bytes(n_left))
        }
        _ => String::new(),
    };
    let _ = writeln!(
        stderr(),
        "{name}: {n_members} members{shard}; {} done before, {n_left} to run{time}{kept}",
        n_own - n_left
    );
    if let Some(advice) = checked.advice {
        let _ = writeln!(stderr(), "hint: {advice}");
    }
}

/// What the summaries of so many members take, packed.
pub fn packed_bytes(n_members: usize) -> DecimalBytes {
    DecimalBytes(LINE_BYTES * n_members as u64)
}

/// The main results of each member, and where the rest is.
pub fn report(sweep: &Sweep, collected: &Collected, n_members: usize, folder: &Path) -> String {
    let keys = sweep.keys().map(|swept| swept.key.as_str());
    let quantities = ["restitution", "contact time", "/ Hertz", "peak force", "/ Hertz"];
    let header: Vec<String> = keys.chain(quantities).map(one_line).collect();
    let row = |row: &Row| {
        let said = sweep.said(row.index);
        let mut cells: Vec<String> = said.iter().map(|value| one_line(value)).collect();
        cells.extend(result_cells(row));
        cells
    };
    let mut alignment = vec![Left; sweep.keys().count()];
    alignment.extend([Right; 5]);
    let shown = collected.shown.iter().map(row);
    let mut text = table(&alignment, std::iter::once(header).chain(shown));
    let (n_done, n_shown) = (collected.n_done, collected.shown.len());
    if n_done > n_shown {
        text += &format!("… and {} more\n", n_done - n_shown);
    }
    if n_done < n_members {
        text += &format!("\n{n_done} of {n_members} members are done.\n");
    }
    text + &format!("\nResult: {}\n", one_line(&folder.join(SWEEP_FILE).display().to_string()))
}

fn result_cells(row: &Row) -> [String; 5] {
    const NONE: &str = "-";
    let summary = &row.summary;
    let number = |key: &str| summary[key].as_f64();
    let quantity = |key: &str, unit| number(key).map_or(NONE.into(), |value| show(value, unit));
    let ratio = |key: &str| {
        let both = number(key).zip(summary["hertz"][key].as_f64());
        both.map_or(NONE.into(), |(ours, hertz)| format!("{:.4}", ours / hertz))
    };
    if !row.is_complete() {
        return ["failed", NONE, NONE, NONE, NONE].map(String::from);
    }
    [
        number("restitution").map_or(NONE.into(), |value| format!("{value:.5}")),
        quantity("contact_time_s", "s"),
        ratio("contact_time_s"),
        quantity("peak_force_n", "N"),
        ratio("peak_force_n"),
    ]
}

/// Success, or which members failed, or how to go on.
///
/// # Errors
/// Members that are not done, or that failed.
pub fn conclude(collected: &Collected, n_own: usize, is_interrupted: bool) -> Result<(), Failure> {
    let Collected { n_own_done, n_failed, failed, .. } = collected;
    if is_interrupted && *n_own_done < n_own {
        let message = format!("interrupted: {n_own_done} of {n_own} members are done");
        return Err(Failure::interrupted(message)
            .with_help("they are kept; the same command goes on with the others"));
    }
    if *n_failed == 0 {
        return Ok(());
    }
    let mut lines = failed.join("\n");
    if failed.len() < *n_failed {
        lines += &format!("\n… and {} more", n_failed - failed.len());
    }
    Err(Failure::failed(format!("{n_failed} of {n_own} members failed")).with_help(format!(
        "{lines}\nthe others are done; run a failed one alone with --set for the cause and remedy, or \
         change its value: the same command then computes what is new"
    )))
}
