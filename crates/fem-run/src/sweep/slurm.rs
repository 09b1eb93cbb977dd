//! `sweep.sbatch`: the shards of a sweep as a job array of Slurm, followed by a job that merges them.
//!
//! The same script plays all parts. Run by a shell, it submits itself twice: as the array, and as the merge
//! that waits for its end. A task computes its shard only and skips members that are done, so that a task
//! that was killed, preempted or out of time continues when it is queued again. The program owns the list
//! of work; the scheduler only starts tasks.

use std::collections::HashSet;
use std::env::{current_dir, current_exe};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use fem::sweep::Checked;
use fem_case::{Keep, Sweep};

use super::cost_estimate::SweepCost;
use super::folder::SweepFolder;
use super::report::member_file_size;
use crate::arguments::case::{parse_count, stem_of};
use crate::forecast::estimated_time;
use crate::text::{Failure, one_line, shown};

const SCRIPT_FILE: &str = "sweep.sbatch";
/// Target time of a task, s: long for a scheduler, short enough to be lost.
const TASK_SECONDS: f64 = 300.0;
/// Most tasks of an array: Slurm's MaxArraySize is 1001 by default.
const MAX_TASKS: usize = 1000;
/// Options of sbatch that the script sets itself.
const OWN_OPTIONS: [&str; 5] = ["--array", "-a", "--dependency", "-d", "--wrap"];

/// Options for Slurm.
#[derive(clap::Args, Clone, Debug)]
pub struct SlurmOptions {
    /// Write sweep.sbatch, a job array over shards, with these options of sbatch: --slurm='--time=10
    /// --mem=1G'
    ///
    /// Nothing is computed here. `sh sweep.sbatch` submits the array and a job that merges its results.
    #[arg(long, value_name = "OPTIONS", allow_hyphen_values = true, num_args = 1,
        conflicts_with_all = ["shard", "merge", "dry_run", "threads"])]
    slurm: Option<String>,
    /// Also submit the script
    #[arg(long, requires = "slurm")]
    pub submit: bool,
    /// Number of shards, each a task of the array [default: tasks of about five minutes]
    #[arg(long, value_name = "N", requires = "slurm", allow_negative_numbers = true, value_parser = parse_count)]
    shards: Option<NonZeroUsize>,
}

impl SlurmOptions {
    pub fn options(&self) -> Option<&Self> {
        self.slurm.is_some().then_some(self)
    }
}

pub struct SlurmBatch {
    options: String,
    n_shards: usize,
    n_left: usize,
    seconds: f64,
    is_packed: bool,
}

impl SlurmBatch {
    pub fn of(
        sweep: &Sweep,
        checked: &Checked,
        expected: &SweepCost,
        options: &SlurmOptions,
    ) -> Result<Self, Failure> {
        let text = options.slurm.clone().unwrap_or_default().trim().to_string();
        let refuse = |found: String, help: &str| Err(Failure::bad_input(found).with_help(help));
        if text.contains(char::is_control) {
            return refuse(
                "--slurm: the options contain a line break".into(),
                "separate them by spaces",
            );
        }
        let names: HashSet<&str> =
            text.split_whitespace().map(|word| word.split('=').next().unwrap_or(word)).collect();
        if let Some(own) = OWN_OPTIONS.iter().find(|own| names.contains(**own)) {
            let help = "the array runs over the shards: set their number with --shards N";
            return refuse(format!("--slurm: {own} is set by the sweep itself"), help);
        }
        let most = MAX_TASKS.min(sweep.n_members());
        let threads = cpus_per_task(&text) as f64;
        let wanted = (expected.all.seconds / (TASK_SECONDS * threads)).ceil() as usize;
        let n_shards = match options.shards.map(NonZeroUsize::get) {
            Some(n) if n > most => {
                let help = format!(
                    "the sweep has {} members, and an array at most {MAX_TASKS} tasks",
                    sweep.n_members()
                );
                return refuse(format!("--shards {n}"), &help);
            }
            Some(n) => n,
            None => wanted.clamp(1, most),
        };
        let seconds = expected.all.on(n_shards * threads as usize);
        Ok(Self {
            options: text,
            n_shards,
            n_left: checked.left.len(),
            seconds,
            is_packed: sweep.keep == Keep::Packed,
        })
    }

    pub fn write(
        &self,
        sweep: &Path,
        set: &[String],
        folder: &SweepFolder,
    ) -> Result<PathBuf, Failure> {
        let fault = |error: std::io::Error| Failure::failed(format!("{SCRIPT_FILE}: {error}"));
        let here = current_dir().map_err(fault)?;
        let place = here.join(folder.path()).join(SCRIPT_FILE);
        let text = self.script(sweep, set, folder.path(), &here);
        folder.write(SCRIPT_FILE, |file| file.write_all(text.as_bytes())).map_err(fault)?;
        Ok(place)
    }

    fn script(&self, sweep: &Path, set: &[String], out: &Path, here: &Path) -> String {
        let text = |path: &Path| path.display().to_string();
        let mut command = vec![text(&program()), "sweep".into(), text(sweep)];
        command.extend(set.iter().flat_map(|set| ["--set".to_string(), set.clone()]));
        command.extend(["--out".to_string(), text(out), "--quiet".to_string()]);
        let command: Vec<String> = command.iter().map(|word| quoted(word)).collect();
        let name = stem_of(sweep).replace(|c: char| !c.is_ascii_alphanumeric(), "_");
        let logs = here.join(out).join("slurm-%A_%a.log");
        let options = match self.options.as_str() {
            "" => String::new(),
            options => format!("#SBATCH {options}\n"),
        };
        include_str!("sweep.sbatch")
            .replace("@NAME@", &name)
            .replace("@SHARDS@", &self.n_shards.to_string())
            .replace("@HERE@", &in_quotes(&text(here)))
            .replace("@LOGS@", &in_quotes(&text(&logs)))
            .replace("#SBATCH @OPTIONS@\n", &options)
            .replace("@SCRIPT@", &quoted(&text(&here.join(out).join(SCRIPT_FILE))))
            .replace("@COMMAND@", &command.join(" "))
    }

    pub fn submit(&self, script: &Path) -> Result<String, Failure> {
        let path = quoted(&script.display().to_string());
        let help = format!("the script is kept; submit it with: sh {path}");
        let fault = |found: String| Failure::failed(format!("--submit: {found}")).with_help(&help);
        let ran = Command::new("sh").arg(script).stdin(Stdio::null()).output();
        let ran = ran.map_err(|error| fault(format!("sh: {error}")))?;
        match ran.status.success() {
            true => Ok(one_line_output(&ran.stdout)),
            false => Err(fault(one_line_output(&ran.stderr))),
        }
    }

    /// Returns what was written, and what to do with it.
    pub fn report(&self, script: &Path, submitted: Option<&str>) -> String {
        let script = shown(script);
        let Self { n_shards, n_left, seconds, .. } = self;
        let files = match self.is_packed {
            true => {
                format!(
                    "each with a file of about {}, ",
                    member_file_size(n_left.div_ceil(*n_shards))
                )
            }
            false => String::new(),
        };
        let task = if *n_shards == 1 { "1 task" } else { &format!("{n_shards} tasks") };
        let next = match submitted {
            Some(said) => format!("Submitted: {said}"),
            None => format!("Submit it with: sh {}", quoted(&script)),
        };
        format!(
            "{n_left} members in {task} of about {}, {files}and a task that merges them.\n{next}\n\nResult: {script}\n",
            estimated_time(*seconds)
        )
    }
}

/// Returns the path of this program, or its name if another program, such as Python, runs it.
fn program() -> PathBuf {
    let own =
        current_exe().ok().filter(|path| path.file_stem().is_some_and(|stem| stem == "fem-run"));
    own.unwrap_or_else(|| PathBuf::from("fem-run"))
}

fn cpus_per_task(options: &str) -> usize {
    let words: Vec<&str> = options.split_whitespace().collect();
    let given = words.iter().enumerate().find_map(|(k, word)| {
        let attached = word.strip_prefix("--cpus-per-task=").or(word.strip_prefix("-c"));
        let apart = ["--cpus-per-task", "-c"].contains(word).then(|| words.get(k + 1).copied());
        apart.flatten().or(attached)?.parse::<usize>().ok()
    });
    given.unwrap_or(1).max(1)
}

fn one_line_output(output: &[u8]) -> String {
    let text = String::from_utf8_lossy(output);
    let lines: Vec<String> =
        text.lines().map(str::trim).filter(|line| !line.is_empty()).map(one_line).collect();
    lines.join("; ")
}

/// Quotes a word for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+%@".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.to_string(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

/// Quotes a path for an option line of sbatch.
fn in_quotes(path: &str) -> String {
    if path.contains(char::is_whitespace) { format!("\"{path}\"") } else { path.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quoted_words_survive_the_shell() {
        for word in ["a b", "it's", "body.0.name='\"x\"'", "", "$HOME `id` \\", "ünï/10 %"] {
            let ran =
                Command::new("sh").args(["-c", &format!("printf %s {}", quoted(word))]).output();
            assert_eq!(String::from_utf8_lossy(&ran.unwrap().stdout), word);
        }
    }

    #[test]
    fn slurm_output_is_shown_as_one_sanitised_line() {
        assert_eq!(
            one_line_output(b" sbatch: error: no host\r\n\nsbatch: fatal: \x1b[2J\n"),
            "sbatch: error: no host; sbatch: fatal: \u{fffd}[2J"
        );
    }

    #[test]
    fn processors_are_read_from_the_options() {
        let all = ["--cpus-per-task=4", "-c 4", "--time=10 -c4 --mem=1G", "--cpus-per-task 4"];
        assert_eq!(all.map(cpus_per_task), [4; 4]);
        assert_eq!(["", "--time=10", "-c 0"].map(cpus_per_task), [1; 3]);
    }
}
