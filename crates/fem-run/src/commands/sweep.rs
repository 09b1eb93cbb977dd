//! `fem-run sweep SWEEP.toml`: computes the members of a sweep, all or a shard of them.

use std::io::{Write, stderr};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use comfy_table::CellAlignment::{Left, Right};
use fem::sweep::{Checked, KeyNumbers, Member, Row, SWEEP_FILE, check};
use fem_case::engineering::show;
use fem_case::{CaseFile, Sweep};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::case_arguments::stem_of;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::standard_output::{self, one_line};
use crate::sweep::{
    Checking, Choice, Collected, Collector, Job, Mark, SweepFolder, duration, run_members,
};
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
    /// Check all members and say how many are to run; compute and write nothing
    #[arg(long)]
    dry_run: bool,
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

impl Shard {
    fn has(&self, index: usize) -> bool {
        index % self.step == self.first
    }
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

/// Computes a sweep.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let sweep = Sweep::load(&arguments.sweep, &arguments.set)?;
    let out = match &arguments.out {
        Some(out) => out.clone(),
        None => Path::new("runs").join(stem_of(&arguments.sweep)),
    };
    let shard = arguments.shard.unwrap_or(Shard { first: 0, step: 1 });
    let pool = pool(arguments.threads)?;
    let there = SweepFolder::at(&out);
    let mut numbers = KeyNumbers::new(&sweep);
    let mut checking = Checking::new(sweep.n_members(), arguments.quiet);
    let is_done = |member: &Member| there.has(&member.identity(), sweep.keep);
    let see = |member: &Member, case: &CaseFile| {
        checking.tick();
        numbers.see(&sweep, member.index, case);
    };
    let checked = pool.install(|| check(&sweep, |index| shard.has(index), is_done, see))?;
    let Checked { members, left, .. } = &checked;
    let choice = Choice::of(&sweep, &numbers)?;
    let n_own = members.iter().filter(|member| shard.has(member.index)).count();
    let tell = || {
        if !arguments.quiet {
            announce(arguments, &checked, n_own, pool.current_num_threads());
        }
    };
    if arguments.dry_run {
        tell();
        return Ok(());
    }
    let mark = Mark { sweep: &sweep, members, set: &arguments.set };
    let folder = SweepFolder::claim(&out, |file| mark.write(file))?;
    tell();

    let job = Job {
        sweep: &sweep,
        members,
        folder: &folder,
        pool: &pool,
        quiet: arguments.quiet,
        interrupt: interrupt.clone(),
    };
    let ran = run_members(&job, left);
    let collector =
        Collector { sweep: &sweep, members, folder: &folder, numbers: &numbers, choice: &choice };
    let collected = collector.collect(|index| shard.has(index))?;
    ran?;
    if !arguments.quiet {
        standard_output::print(&report(&sweep, &collected, members.len(), folder.path()))?;
    }
    conclude(&collected, n_own, interrupt.is_requested())
}

fn pool(threads: Option<NonZeroUsize>) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZeroUsize::get)).build();
    pool.map_err(|error| Failure::failed(format!("no threads to run on: {error}")))
}

/// One line on stderr about what begins and what it takes.
fn announce(arguments: &Arguments, checked: &Checked, n_own: usize, n_threads: usize) {
    let (n_members, n_left) = (checked.members.len(), checked.left.len());
    let shard = if n_own == n_members { String::new() } else { format!(", {n_own} in this shard") };
    let name = one_line(&arguments.sweep.display().to_string());
    let time = match n_left {
        0 => String::new(),
        _ => format!(
            ", some {} on {n_threads} threads",
            duration(checked.seconds / n_threads as f64)
        ),
    };
    let _ = writeln!(
        stderr(),
        "{name}: {n_members} members{shard}; {} done before, {n_left} to run{time}",
        n_own - n_left
    );
    if let Some(advice) = checked.advice {
        let _ = writeln!(stderr(), "hint: {advice}");
    }
}

/// The main results of each member, and where the rest is.
fn report(sweep: &Sweep, collected: &Collected, n_members: usize, folder: &Path) -> String {
    let keys = sweep.keys().map(|swept| swept.key.as_str());
    let quantities = ["restitution", "contact time", "/ Hertz", "peak force", "/ Hertz"];
    let header: Vec<String> = keys.chain(quantities).map(one_line).collect();
    let row = |row: &Row| {
        let mut cells: Vec<String> = row.values.iter().map(|value| one_line(value)).collect();
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
fn conclude(collected: &Collected, n_own: usize, is_interrupted: bool) -> Result<(), Failure> {
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
