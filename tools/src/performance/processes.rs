//! Whole processes: the command on cases, from start to end, with files.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
#[cfg(not(unix))]
use std::time::Instant;

use serde_json::Value;

use super::bodies::Error;
use super::elements::of_plain_code;
use crate::timing::median;

const RUNS: usize = 9;

/// Name, case, further arguments.
const ROWS: [(&str, &str, &[&str]); 9] = [
    ("default", "glass_0.5ms", &[]),
    ("default, elastic", "glass_0.5ms_elastic", &[]),
    ("default, on a wall", "glass_on_wall", &[]),
    ("mesh of 28 µm, elastic", "glass_0.5ms_elastic", &["--set=mesh.contact_element_size=28e-6"]),
    ("paper's mesh of 14 µm, elastic", "glass_0.5ms_14um", &[]),
    ("condensed", "glass_0.5ms", &["--set=model.condensed={}"]),
    (
        "condensed, no snapshots",
        "glass_0.5ms",
        &["--set=model.condensed={}", "--set=output.snapshots=[]"],
    ),
    ("Ting", "glass_0.5ms", &["--set=model.ting={}"]),
    ("`check`", "glass_0.5ms", &["check"]),
];

/// A command and the times of its runs.
struct Timed {
    arguments: Vec<String>,
    folder: PathBuf,
    seconds: Vec<f64>,
    /// Times in millions of element updates of plain code.
    ratios: Vec<f64>,
}

impl Timed {
    fn new(case: &str, rest: &[&str], scratch: &Path, number: usize) -> Self {
        let (commands, rest): (Vec<&str>, Vec<&str>) =
            rest.iter().partition(|word| !word.starts_with("--"));
        let folder = scratch.join(number.to_string());
        let case = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../cases/{case}.toml"));
        let out = ["--out".into(), folder.display().to_string()];
        let own = if commands.is_empty() { &out[..] } else { &[] };
        let arguments = (commands.iter().map(ToString::to_string))
            .chain([case.display().to_string()])
            .chain(rest.iter().map(ToString::to_string))
            .chain(own.iter().cloned())
            .collect();
        Self { arguments, folder, seconds: Vec::new(), ratios: Vec::new() }
    }

    fn take_turn(&mut self, command: &Path, plain: f64) -> Result<(), Error> {
        let start = spent()?;
        let status = Command::new(command)
            .args(&self.arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()?;
        let seconds = spent()? - start;
        if !status.success() {
            return Err(format!("{:?} failed", self.arguments).into());
        }
        self.seconds.push(seconds);
        // 1e6 updates of `plain` ns each.
        self.ratios.push(seconds / (1e-3 * plain));
        Ok(())
    }

    /// Returns the element updates of the last run, millions.
    fn updates(&self) -> Option<f64> {
        let summary = std::fs::read_to_string(self.folder.join("summary.json")).ok()?;
        let summary: Value = serde_json::from_str(&summary).ok()?;
        Some(1e-6 * summary.get("element_updates")?.as_f64()?)
    }
}

/// Returns the processor time of the ended children in seconds, which other work on the machine affects
/// little.
#[cfg(unix)]
fn spent() -> Result<f64, Error> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike;
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN)?;
    Ok(1e-6 * (usage.user_time() + usage.system_time()).num_microseconds() as f64)
}

/// Returns the wall time in seconds.
#[cfg(not(unix))]
fn spent() -> Result<f64, Error> {
    use std::sync::OnceLock;
    static START: OnceLock<Instant> = OnceLock::new();
    Ok(START.get_or_init(Instant::now).elapsed().as_secs_f64())
}

/// Returns the command next to this example.
pub fn command() -> Result<PathBuf, Error> {
    let example = std::env::current_exe()?;
    let folder = example.ancestors().nth(2).ok_or("an example lies in a folder of the build")?;
    let command = folder.join(format!("fem-run{}", std::env::consts::EXE_SUFFIX));
    match command.exists() {
        true => Ok(command),
        false => Err(format!("no {}: cargo build --release", command.display()).into()),
    }
}

/// Returns the table, one row per process.
pub fn table() -> Result<String, Error> {
    let (command, scratch) = (command()?, tempfile::tempdir()?);
    let mut plain = of_plain_code()?;
    let mut all: Vec<Timed> = (ROWS.iter().enumerate())
        .map(|(k, (_, case, rest))| Timed::new(case, rest, scratch.path(), k))
        .collect();
    for _ in 0..RUNS {
        for timed in &mut all {
            timed.take_turn(&command, plain())?;
        }
    }
    let mut table = String::from(
        "| process | case | CPU seconds | in plain updates, millions | element updates, millions |\n\
         |---|---|---|---|---|\n",
    );
    for ((name, case, _), timed) in ROWS.iter().zip(&all) {
        let updates = timed.updates().map_or("–".into(), |updates| format!("{updates:.1}"));
        let (seconds, ratio) = (median(timed.seconds.clone()), median(timed.ratios.clone()));
        writeln!(table, "| {name} | `{case}` | {seconds:.3} | {ratio:.1} | {updates} |")?;
    }
    Ok(table)
}
