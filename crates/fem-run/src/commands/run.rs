//! `fem-run CASE.toml`: computes a collision and writes its result folder.

use std::io::{Write, stderr};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fem_case::{Case, Halt, Keep, Outcome, Simulation};
use indicatif::{DecimalBytes, HumanCount};

use crate::arguments::CaseArguments;
use crate::assess::assess;
use crate::failure::Failure;
use crate::history_file::{HISTORY_FILE, write_history};
use crate::interrupt::Interrupt;
use crate::progress::Watch;
use crate::remedy::remedy_of;
use crate::report::report;
use crate::result_folder::ResultFolder;
use crate::snapshot_files::{Drawing, write_snapshots};
use crate::standard_output;
use crate::summarise::{Clock, summarise};
use crate::summary::{SUMMARY_FILE, Summary};

/// How to run a case.
#[derive(clap::Args, Debug)]
pub struct Options {
    /// Folder for the result [default: runs/<the case file's stem>]
    ///
    /// An existing folder is replaced only if it is empty or a result of fem-run. Files of your
    /// own in it are kept.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Most threads to use; a single run uses one, which is the fastest
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    threads: Option<NonZeroUsize>,
    /// Print nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// Runs a case.
pub fn execute(input: &CaseArguments, options: &Options, started: Instant) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let mut simulation = Simulation::new(Case::load(&input.case, &input.set)?)?;
    let stem = input.stem();
    let out = options.out.clone().unwrap_or_else(|| Path::new("runs").join(&stem));
    let folder = ResultFolder::claim(&out, &longest_name(&stem))?;
    if !options.quiet {
        announce(&simulation, &input.case, &out);
    }

    let mut watch = Watch::new(interrupt, options.quiet);
    let (outcome, clock) = Clock::run(started, &mut simulation, &mut watch);
    watch.finish();

    let summary = write_result(folder.path(), &stem, &simulation, &outcome, clock, Keep::All)?;
    let place = folder.publish()?;
    if !options.quiet {
        standard_output::print(&report(&summary, &place))?;
    }
    match &outcome.halt {
        None => Ok(()),
        Some(halt) => Err(stopped(halt, &summary, &place)),
    }
}

/// The longest name of a file to come, the writer's temporary ending included.
pub fn longest_name(stem: &str) -> String {
    format!(".{stem}_99999_mid-compression.vtu.XXXXXX.tmp")
}

/// One line on stderr about what begins.
fn announce(simulation: &Simulation, case: &Path, out: &Path) {
    let line = format!("{}: {}; result: {}", case.display(), price(simulation), out.display());
    let _ = writeln!(stderr(), "{}", standard_output::one_line(&line));
}

/// The model and what it costs.
fn price(simulation: &Simulation) -> String {
    match simulation {
        Simulation::Fem(problem) => {
            let cost = &problem.cost;
            format!(
                "{} elements, about {} steps, about {}",
                HumanCount(cost.elements),
                HumanCount(cost.steps),
                DecimalBytes(cost.memory)
            )
        }
        Simulation::Condensed(condensed) => format!(
            "{} elements condensed to {} contact points, factors of {}",
            HumanCount(condensed.n_elements() as u64),
            condensed.pair.n_points(),
            DecimalBytes(condensed.pair.factor_bytes() as u64)
        ),
        Simulation::Reduced(reduced) => format!("{}, milliseconds", reduced.describe()),
    }
}

/// Writes the files of a result that are to be kept, the summary last.
pub fn write_result(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    outcome: &Outcome,
    clock: Clock,
    keep: Keep,
) -> Result<Summary, Failure> {
    let fault = |error: &dyn std::error::Error| {
        Failure::failed(format!("the result cannot be written: {error}")).with_help(
            "nothing was kept of this run; is the disk full? An older result is where it was",
        )
    };
    let mut files = vec![SUMMARY_FILE.to_string()];
    let mut left_out = Vec::new();
    if keep == Keep::All {
        write_history(folder, simulation.case(), &outcome.history)
            .map_err(|error| fault(&error))?;
        files.push(HISTORY_FILE.to_string());
    }
    let mut warnings = simulation.warnings().to_vec();
    if let Some(drawing) = Drawing::of(simulation, outcome).filter(|_| keep == Keep::All) {
        let (vtk_files, missing) =
            write_snapshots(folder, stem, &drawing).map_err(|error| fault(&error))?;
        files.extend(vtk_files);
        left_out = missing;
    }
    warnings.extend(assess(simulation, outcome));
    warnings.extend(outcome.warnings.iter().cloned());
    warnings.extend(left_out);
    let summary = summarise(simulation, outcome, clock, warnings, files);
    let mut text = serde_json::to_string_pretty(&summary).map_err(|error| fault(&error))?;
    text.push('\n');
    std::fs::write(folder.join(SUMMARY_FILE), text).map_err(|error| fault(&error))?;
    Ok(summary)
}

fn stopped(halt: &Halt, summary: &Summary, place: &Path) -> Failure {
    let kept = format!(
        "what was computed so far is in {}, marked incomplete",
        standard_output::one_line(&place.display().to_string())
    );
    let Some(remedy) = remedy_of(halt) else {
        return Failure::interrupted(halt.to_string()).with_help(kept);
    };
    let between: Vec<&str> = summary.bodies.iter().map(|body| body.name.as_str()).collect();
    Failure::failed(format!("the run of {} failed: {halt}", between.join(" and ")))
        .with_help(format!("likely cause: {}\nremedy: {}\n{kept}", remedy.cause, remedy.remedy))
}
