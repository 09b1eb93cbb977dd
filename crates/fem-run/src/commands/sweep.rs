//! `fem-run sweep SWEEP.toml`: computes the members of a sweep, all or a shard of them.

use std::collections::HashSet;
use std::io::{Write, stderr};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use comfy_table::CellAlignment::{Left, Right};
use fem::results::PROGRAM;
use fem::sweep::{Member, Row, SWEEP_FILE, advice, identify, left_to_do};
use fem_case::Sweep;
use fem_case::engineering::show;
use serde_json::{Value, json};

use crate::case_arguments::stem_of;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::standard_output::{self, one_line};
use crate::sweep::{Checking, Choice, Job, SweepFolder, collect, run_members};
use crate::tables::table;

/// Compute many members of a case: lists of values for some of its keys
///
/// Writes sweep.csv, sweep.svg and a summary of each member into a folder. The same command on
/// the folder of a stopped sweep goes on where it was; members that are done are taken.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// The sweep file, TOML: a case, and under vary dotted keys with lists of values
    #[arg(value_name = "SWEEP")]
    sweep: PathBuf,
    /// Folder for the results [default: runs/<the sweep file's stem>]
    ///
    /// An existing folder must be empty or that of a sweep, which then goes on.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Override a key of the base case by its dotted path; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Members that run at the same time [default: one a processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    threads: Option<NonZeroUsize>,
    /// Run only the K-th of N shards: every N-th member, from the K-th
    ///
    /// Shards may run at any time, on several machines, into the same folder; the last one leaves
    /// the same files as the whole sweep.
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Print nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// `K/N`: members K − 1, K − 1 + N, …
#[derive(Clone, Copy, Debug)]
struct Shard {
    first: usize,
    step: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(k, n)| (k.parse::<usize>(), n.parse::<usize>()));
        match numbers {
            Some((Ok(k), Ok(n))) if 1 <= k && k <= n => Ok(Self { first: k - 1, step: n }),
            _ => Err("a shard is K/N with K from 1 to N, such as 3/10".to_string()),
        }
    }
}

/// Rows that are shown on stdout; all are in the table.
const MOST_ROWS: usize = 40;

/// Computes a sweep.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let sweep = Sweep::load(&arguments.sweep, &arguments.set)?;
    let members = identify(&sweep)?;
    let choice = Choice::of(&sweep, &members)?;
    let stem = stem_of(&arguments.sweep);
    let out = arguments.out.clone().unwrap_or_else(|| Path::new("runs").join(stem));
    let shard = arguments.shard.unwrap_or(Shard { first: 0, step: 1 });
    let own: Vec<&Member> = members.iter().skip(shard.first).step_by(shard.step).collect();
    let there = SweepFolder::at(&out);
    let checking = Checking::new(own.len(), arguments.quiet);
    let is_done = |member: &Member| {
        checking.tick();
        there.has(&member.identity, sweep.keep)
    };
    let left = left_to_do(&sweep, own.iter().copied(), is_done)?;
    let folder = SweepFolder::claim(&out, &mark(&sweep, &members, arguments))?;
    if !arguments.quiet {
        announce(arguments, members.len(), own.len(), left.len());
        if let Some(advice) = advice(&sweep, &left)? {
            let _ = writeln!(stderr(), "hint: {advice}");
        }
    }

    let job = Job {
        sweep: &sweep,
        members: &members,
        folder: &folder,
        threads: arguments.threads,
        quiet: arguments.quiet,
        interrupt: interrupt.clone(),
    };
    let ran = run_members(&job, &left);
    let rows = collect(&sweep, &members, &folder, &choice)?;
    ran?;
    if !arguments.quiet {
        standard_output::print(&report(&sweep, &rows, members.len(), folder.path()))?;
    }
    conclude(&sweep, &rows, &own, interrupt.is_requested())
}

/// `sweep.json`: which sweep the folder holds, and which member is where.
fn mark(sweep: &Sweep, members: &[Member], arguments: &Arguments) -> String {
    let lists = sweep.axes.iter().map(|axis| {
        let values = axis.elements.iter().map(|element| element.text.as_str()).collect();
        (axis.key.clone(), values)
    });
    let member = |member: &Member| {
        let values = sweep.values(member.index).into_iter().map(Value::from);
        let keys = sweep.axes.iter().map(|axis| axis.key.clone());
        json!({ "member": member.identity, "values": Value::Object(keys.zip(values).collect()) })
    };
    let mark = json!({
        "program": PROGRAM,
        "version": env!("CARGO_PKG_VERSION"),
        "case": sweep.base_path().display().to_string(),
        "set": arguments.set,
        "combine": sweep.combine.word(),
        "keep": sweep.keep.word(),
        "vary": Value::Object(lists.collect()),
        "members": members.iter().map(member).collect::<Vec<_>>(),
    });
    format!("{mark:#}\n")
}

/// One line on stderr about what begins.
fn announce(arguments: &Arguments, n_members: usize, n_own: usize, n_left: usize) {
    let shard = if n_own == n_members { String::new() } else { format!(", {n_own} in this shard") };
    let name = one_line(&arguments.sweep.display().to_string());
    let _ = writeln!(
        stderr(),
        "{name}: {n_members} members{shard}; {} done before, {n_left} to run",
        n_own - n_left
    );
}

/// The main results of each member, and where the rest is.
fn report(sweep: &Sweep, rows: &[Row], n_members: usize, folder: &Path) -> String {
    let keys = sweep.axes.iter().map(|axis| axis.key.as_str());
    let quantities = ["restitution", "contact time", "/ Hertz", "peak force", "/ Hertz"];
    let header: Vec<String> = keys.chain(quantities).map(one_line).collect();
    let row = |row: &Row| {
        let mut cells: Vec<String> = row.values.iter().map(|value| one_line(value)).collect();
        cells.extend(result_cells(row));
        cells
    };
    let mut alignment = vec![Left; sweep.axes.len()];
    alignment.extend([Right; 5]);
    let shown = rows.iter().take(MOST_ROWS).map(row);
    let mut text = table(&alignment, std::iter::once(header).chain(shown));
    if rows.len() > MOST_ROWS {
        text += &format!("… and {} more\n", rows.len() - MOST_ROWS);
    }
    if rows.len() < n_members {
        text += &format!("\n{} of {n_members} members are done.\n", rows.len());
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
fn conclude(
    sweep: &Sweep,
    rows: &[Row],
    own: &[&Member],
    is_interrupted: bool,
) -> Result<(), Failure> {
    let own_indices: HashSet<usize> = own.iter().map(|member| member.index).collect();
    let done: Vec<&Row> = rows.iter().filter(|row| own_indices.contains(&row.index)).collect();
    if is_interrupted && done.len() < own.len() {
        let message = format!("interrupted: {} of {} members are done", done.len(), own.len());
        return Err(Failure::interrupted(message)
            .with_help("they are kept; the same command goes on with the others"));
    }
    let failed = done.iter().filter(|row| !row.is_complete());
    let lines: Vec<String> = failed
        .map(|row| {
            let reason = row.summary["stopped_because"].as_str().unwrap_or("unknown");
            one_line(&format!("{}: {reason}", sweep.describe(row.index)))
        })
        .collect();
    if lines.is_empty() {
        return Ok(());
    }
    let message = format!("{} of {} members failed", lines.len(), own.len());
    Err(Failure::failed(message).with_help(format!(
        "{}\nthe others are done; run a failed one alone with --set for the cause and remedy, or \
         change its value: the same command then computes what is new",
        lines.join("\n")
    )))
}
