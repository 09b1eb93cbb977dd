//! `fem-run CASE.toml`: computes a collision and writes its result folder.

use std::io::{IsTerminal, Write, stderr, stdout};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Instant;

use fem::results::Summary;
use fem::{
    Cost, ErrorEstimator, Identity, RefinedBeforeRun, RestartState, Simulation, stop_advice,
};
use fem_case::Keep;
use fem_collision::{Collision, Monitor, Phase, Stop};
use indicatif::HumanCount;

use crate::arguments::case::{CaseArguments, ToleranceArguments, parse_count};
use crate::forecast::{Forecast, closed_form_time, estimated, estimated_count, estimated_time};
use crate::progress::RunProgress;
use crate::progress::interrupt::Interrupt;
use crate::progress::stopwatch::Timed;
use crate::progress::stopwatch::peak_memory_with;
use crate::result_folder::ResultFolder;
use crate::result_folder::ResultPath;
use crate::result_folder::restart::{
    RESTART_FILE, RestartArguments, RestartWriter, announce_restart, read_restart,
};
use crate::result_folder::run_files::{WrittenResult, longest_name, write_result};
use crate::text::run_report::{Detail, report};
use crate::text::{Failure, one_line, shown, standard_output};

/// How to run a case.
#[derive(clap::Args, Debug)]
pub struct Options {
    /// Folder for the result [default: runs/CASE, with the name of the case file]
    ///
    /// Values of --set that change the scene are appended to the default: runs/glass-approach_speed=1m_s.
    /// An existing folder is replaced only if it is empty or holds a result of the same case file and overrides,
    /// perhaps before the file was edited, or of an equal case; differences in [output] do not count. Other
    /// files in it are kept. Without --out another result is kept too, and the run writes to a new folder next
    /// to it.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace any other result
    #[arg(long)]
    force: bool,
    /// Maximum number of threads; without effect on a single run, which is fastest on one
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = parse_count)]
    threads: Option<NonZeroUsize>,
    /// The tolerance of the results.
    #[command(flatten)]
    within: ToleranceArguments,
    /// Compute on the finest mesh if no mesh meets the tolerance; without it this is an error
    #[arg(long)]
    best: bool,
    /// Whether to write or read a restart file.
    #[command(flatten)]
    restart: RestartArguments,
    /// Print only the summary on stdout, as in summary.json
    #[arg(long)]
    json: bool,
    /// Print everything: bodies, energies, cost, and each effect with the reason why it is on or off
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    /// Print nothing but errors and warnings, and the summary with --json
    #[arg(long, short)]
    quiet: bool,
}

impl Options {
    /// Rejects a tolerance that no mesh meets, unless the best mesh is asked for.
    fn check_tolerance(&self, simulation: &Simulation) -> Result<(), Failure> {
        let Some(why) = simulation.out_of_reach().filter(|_| !self.best) else { return Ok(()) };
        let error = simulation.case().error_at("accuracy.tolerance", why);
        let help = "raise the tolerance, or add --best to compute the best result that there is, on the finest mesh";
        Err(error.with_help(help).into())
    }

    fn detail(&self) -> Detail {
        if self.verbose { Detail::All } else { Detail::Short }
    }
}

pub fn execute(input: &CaseArguments, options: &Options, started: Instant) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let begin = Instant::now();
    let simulation = Simulation::new(input.load_within(&options.within)?)?;
    options.check_tolerance(&simulation)?;
    let making = begin.elapsed().as_secs_f64();
    let identity = simulation.identity()?;
    let stem = input.stem();
    let origin = input.origin_within(&options.within, "run", identity.case.clone());
    let name = simulation.case().folder_name(&stem);
    let place = ResultPath::choose(options.out.as_deref(), &name, &origin, options.force);
    let restart_state = match options.restart.restart {
        true => find_restart_state(&place, &identity)?,
        false => None,
    };
    let folder = ResultFolder::claim(&place.out, &longest_name(&stem), origin, options.force)?;
    let mut estimator = ErrorEstimator::default();
    let RefinedBeforeRun { simulation, is_open } = match &restart_state {
        Some(state) => {
            RefinedBeforeRun { simulation: simulation.on_mesh_of(state)?, is_open: false }
        }
        None => estimator.refine_before_run(simulation, || true),
    };
    check_memory(&simulation, &estimator)?;
    if !matches!(simulation.setup().cost, Cost::ClosedForm { .. }) {
        // Models that step have a state to write whenever they are asked to end.
        interrupt.watch();
    }
    if !options.quiet {
        let forecast = Forecast::of(&simulation, &mut estimator, making, is_open);
        let announced = Announced { simulation: &simulation, estimator: &estimator, forecast };
        announced.print(&input.name(), &place, started, options.detail());
        if options.restart.restart {
            announce_restart(restart_state.as_ref());
        }
    }

    let mut watch = Timed::since(started, RunProgress::new(interrupt, options.quiet));
    let mut writer = RestartWriter::new(&folder, &identity, options.restart);
    let mut restart_state = restart_state;
    let mut left: &[&str] = &[];
    let computed = estimator.within_tolerance(simulation, |_, simulation| {
        if restart_state.is_none() && !options.quiet {
            tell_finer(simulation, options.detail());
        }
        let (collision, kept) = compute(simulation, restart_state.take(), &mut writer, &mut watch)?;
        left = kept;
        Ok::<_, Failure>(collision)
    })?;
    let (stopwatch, watch) = watch.stop();
    watch.finish();

    let written = write_result(&folder, &stem, &computed, &stopwatch, Keep::All, left);
    conclude(written, folder, options, computed.collision.stop())
}

/// Publishes a result, prints it, and returns why it is not whole, if so.
fn conclude(
    WrittenResult { summary, text, fault }: WrittenResult,
    folder: ResultFolder,
    options: &Options,
    stop: Option<&Stop>,
) -> Result<(), Failure> {
    let published = match summary.files.is_empty() {
        true => Ok(None),
        false => folder.publish(fault.is_none()).map(Some),
    };
    let place = published.as_ref().ok().and_then(Option::as_deref);
    if options.quiet {
        standard_output::warn(summary.warnings.clone());
    }
    match (options.json, options.quiet) {
        (true, _) => standard_output::print(&text)?,
        (false, true) => {}
        (false, false) => {
            let text = report(&summary, place, options.detail());
            standard_output::print(&text)?;
        }
    }
    if let Some(fault) = fault {
        return Err(fault);
    }
    match (published?, stop) {
        (Some(place), Some(stop)) => {
            let kept =
                format!("what was computed so far is in {}, marked incomplete", shown(&place));
            Err(stopped(stop, &summary, &kept))
        }
        _ => Ok(()),
    }
}

/// Rejects a run that is expected to take more memory than the case allows, with its reference runs.
fn check_memory(simulation: &Simulation, estimator: &ErrorEstimator) -> Result<(), Failure> {
    let limit = simulation.case().scene().limits().memory;
    let expected = peak_memory_with(simulation, estimator);
    match expected.zip(limit).filter(|(expected, limit)| expected > limit) {
        None => Ok(()),
        Some((expected, _)) => {
            let expected = estimated(expected as f64, "B");
            let message =
                format!("the run takes about {expected} of memory, reference runs included");
            let error = simulation.case().error_at("limits.memory", message);
            let help = "raise limits.memory, or set a larger mesh.contact_element_size or accuracy.tolerance";
            Err(error.with_help(help).into())
        }
    }
}

/// Returns the restart state in the result folder. If the default folder belongs to another case, the state
/// is looked for in this case's own folder; if there is none either, the other case's file is rejected.
fn find_restart_state(
    place: &ResultPath,
    identity: &Identity,
) -> Result<Option<RestartState>, Failure> {
    let own = read_restart(&place.out, identity)?;
    match (&own, &place.taken) {
        (None, Some(taken)) => read_restart(taken, identity),
        _ => Ok(own),
    }
}

/// Returns the collision, and the names of files that the run has left in the folder.
fn compute(
    simulation: &Simulation,
    restart_state: Option<RestartState>,
    writer: &mut RestartWriter<'_>,
    monitor: &mut dyn Monitor,
) -> Result<(Collision, &'static [&'static str]), Failure> {
    let mut stepper = match restart_state {
        Some(state) => simulation.resume(state)?,
        None if !writer.is_on() => return Ok((simulation.run(monitor), &[])),
        None => simulation.start(),
    };
    writer.begin(stepper.as_ref());
    monitor.enter(Phase::Collision);
    loop {
        if !monitor.report(stepper.progress()) {
            let left: &[&str] =
                if writer.leave(simulation, stepper.as_ref()) { &[RESTART_FILE] } else { &[] };
            return Ok((stepper.finish(), left));
        }
        if !stepper.advance(monitor) {
            return Ok((stepper.finish(), &[]));
        }
        writer.update(simulation, stepper.as_ref());
    }
}

/// What is known before a run.
struct Announced<'a> {
    simulation: &'a Simulation,
    estimator: &'a ErrorEstimator,
    forecast: Forecast,
}

impl Announced<'_> {
    /// Prints it on stderr, with the time that a run takes which began at `started`, and the warnings unless the report
    /// soon has them on the same screen.
    fn print(&self, case: &str, place: &ResultPath, started: Instant, detail: Detail) {
        let Self { simulation, forecast, .. } = self;
        let scene = simulation.case().scene();
        let notes = [scene.large_spheres(), scene.reference_temperatures()];
        let large: String = notes.into_iter().flatten().map(|note| format!("{note}; ")).collect();
        let cost = self.cost(started.elapsed().as_secs_f64(), detail);
        let mut line = format!("{case}: {large}{cost}");
        // For condensed bodies the upper bound is seconds beside milliseconds, and few are refined.
        let has_steps = matches!(simulation.setup().cost, Cost::Steps { .. });
        if let Some(finer) = forecast.finer.filter(|_| has_steps && detail == Detail::All) {
            line += &format!("; adaptive refinement may add {}", finer.in_words());
        }
        let note = place.note();
        if detail == Detail::All || !note.is_empty() {
            line += &format!("; result: {}{note}", place.out.display());
        }
        standard_output::tell("", &line);
        let seconds = match simulation.setup().cost {
            Cost::ClosedForm { .. } => Some(0.0),
            Cost::Steps { seconds, .. } => forecast.whole(0.0).or(Some(seconds)),
            Cost::Factors { .. } => forecast.whole(0.0),
        };
        let is_screen = stdout().is_terminal() && stderr().is_terminal();
        if warns_before(is_screen, seconds) {
            standard_output::warn(simulation.warnings_before());
        }
    }

    /// Describes size, time and memory of a run after `spent` seconds.
    fn cost(&self, spent: f64, detail: Detail) -> String {
        let Self { simulation, estimator, forecast } = self;
        let setup = simulation.setup();
        let all = |text: String| if detail == Detail::All { text } else { String::new() };
        let size = match setup.cost {
            Cost::Steps { elements, steps, .. } => {
                let steps = estimated_count(forecast.updates_over_expected * steps as f64);
                format!(
                    "{} elements{}",
                    HumanCount(elements),
                    all(format!(", about {steps} steps"))
                )
            }
            Cost::Factors { elements, contact_points, factor_bytes, .. } => {
                let points = format!(" condensed to {contact_points} contact points");
                let factors = match factor_bytes {
                    0 => String::new(),
                    bytes => format!(", factors of {}", estimated(bytes as f64, "B")),
                };
                format!("{} elements{points}{}", HumanCount(elements), all(factors))
            }
            Cost::ClosedForm { .. } => {
                return format!("{}, {}", setup.description, closed_form_time(simulation));
            }
        };
        let contacts = simulation.case().scene().gravity().map_or(1, |gravity| gravity.bounces);
        let each = if contacts > 1 { " per contact" } else { "" };
        let time = match (forecast.whole(spent), &setup.cost) {
            (Some(seconds), _) | (None, &Cost::Steps { seconds, .. }) => {
                format!(", about {}{each}", estimated_time(seconds))
            }
            (None, _) => String::new(),
        };
        let memory = peak_memory_with(simulation, estimator);
        let memory = memory
            .map_or(String::new(), |bytes| format!(", about {}", estimated(bytes as f64, "B")));
        format!("{size}{time}{memory}")
    }
}

/// Returns whether the warnings are printed before a run that takes this many seconds. On a screen those of a short run
/// stand below its table alone, where they do not scroll away.
fn warns_before(is_screen: bool, seconds: Option<f64>) -> bool {
    const SHORT_RUN: f64 = 5.0;
    !is_screen || seconds.is_none_or(|seconds| seconds > SHORT_RUN)
}

/// Prints on stderr that the mesh is refined.
fn tell_finer(simulation: &Simulation, detail: Detail) {
    let Some(why) = simulation.refined_because() else { return };
    let line = match (detail, &simulation.setup().cost) {
        (Detail::Short, Cost::Steps { elements, .. } | Cost::Factors { elements, .. }) => {
            format!("finer mesh: {} elements", HumanCount(*elements))
        }
        _ => format!("finer mesh: {why}"),
    };
    let _ = writeln!(stderr(), "{}", one_line(&line));
}

/// Returns why a run stopped early; `kept` says where its results are.
pub fn stopped(stop: &Stop, summary: &Summary, kept: &str) -> Failure {
    let Some(remedy) = stop_advice(stop) else {
        return Failure::interrupted(stop.to_string()).with_help(kept);
    };
    let between: Vec<&str> = summary.bodies.iter().map(|body| body.name.as_str()).collect();
    Failure::failed(format!("the run of {} failed: {stop}", between.join(" and ")))
        .with_help(format!("likely cause: {}\nremedy: {}\n{kept}", remedy.cause, remedy.remedy))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_of_a_short_run_stand_below_its_table_alone() {
        assert!(warns_before(false, Some(0.0)), "a report in a file is not on the screen");
        assert!(warns_before(true, Some(60.0)) && warns_before(true, None));
        assert!(!warns_before(true, Some(0.1)));
    }
}
