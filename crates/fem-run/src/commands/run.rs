//! `fem-run CASE.toml`: computes a collision and writes its result folder.

use std::io::{Write, stderr};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fem::results::Summary;
use fem::{Cost, Simulation, remedy_of};
use fem_case::{Case, Keep};
use fem_collision::Stop;
use indicatif::{DecimalBytes, HumanCount};

use crate::case_arguments::CaseArguments;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::progress::Watch;
use crate::report::report;
use crate::result_files::{longest_name, write_result};
use crate::result_folder::ResultFolder;
use crate::standard_output;
use crate::stopwatch::Timed;

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
    let simulation = Simulation::new(Case::load(&input.case, &input.set)?)?;
    let stem = input.stem();
    let out = options.out.clone().unwrap_or_else(|| Path::new("runs").join(&stem));
    let folder = ResultFolder::claim(&out, &longest_name(&stem))?;
    if !options.quiet {
        announce(&simulation, &input.case, &out);
    }

    let mut watch = Timed::since(started, Watch::new(interrupt, options.quiet));
    let collision = simulation.run(&mut watch);
    let (stopwatch, watch) = watch.stop();
    watch.finish();

    let summary =
        write_result(folder.path(), &stem, &simulation, &collision, &stopwatch, Keep::All)?;
    let place = folder.publish()?;
    if !options.quiet {
        standard_output::print(&report(&summary, &place))?;
    }
    match collision.stop() {
        None => Ok(()),
        Some(stop) => Err(stopped(stop, &summary, &place)),
    }
}

/// One line on stderr about what begins.
fn announce(simulation: &Simulation, case: &Path, out: &Path) {
    let line = format!("{}: {}; result: {}", case.display(), price(simulation), out.display());
    let _ = writeln!(stderr(), "{}", standard_output::one_line(&line));
}

/// The model and what it costs.
fn price(simulation: &Simulation) -> String {
    match simulation.setup().cost {
        Cost::Steps { elements, steps, memory, .. } => format!(
            "{} elements, about {} steps, about {}",
            HumanCount(elements),
            HumanCount(steps),
            DecimalBytes(memory)
        ),
        Cost::Factors { elements, contact_points, factor_bytes, .. } => format!(
            "{} elements condensed to {contact_points} contact points, factors of {}",
            HumanCount(elements),
            DecimalBytes(factor_bytes)
        ),
        Cost::Little { .. } => format!("{}, milliseconds", simulation.setup().description),
    }
}

fn stopped(stop: &Stop, summary: &Summary, place: &Path) -> Failure {
    let kept = format!(
        "what was computed so far is in {}, marked incomplete",
        standard_output::one_line(&place.display().to_string())
    );
    let Some(remedy) = remedy_of(stop) else {
        return Failure::interrupted(stop.to_string()).with_help(kept);
    };
    let between: Vec<&str> = summary.bodies.iter().map(|body| body.name.as_str()).collect();
    Failure::failed(format!("the run of {} failed: {stop}", between.join(" and ")))
        .with_help(format!("likely cause: {}\nremedy: {}\n{kept}", remedy.cause, remedy.remedy))
}
