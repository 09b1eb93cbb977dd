//! `fem-run accuracy CASE`: errors and run times of all models and many settings.

use std::io::{Write, stderr};
use std::time::{Duration, Instant};

use fem::accuracy::{Measurement, Study, Variant, Variants};
use fem::{CaseError, Identity, Monitor, Progress, Simulation, digest_of};
use fem_case::engineering::show;
use fem_report::accuracy::{
    AccuracyResult, Advice, advice, csv, figure, json, markdown, terminal_tables,
};
use indicatif::HumanCount;

use crate::{
    arguments::case::{CaseArguments, ToleranceArguments},
    progress::{ItemProgress, interrupt::Interrupt},
    result_folder::command_output::OutputArguments,
    text::{Failure, headed, one_line, standard_output, wrapped},
};

/// Shorter runs are timed three times, and the median is taken.
const TIMED_THRICE: Duration = Duration::from_millis(500);
const N_TIMES: usize = 3;
/// Time of an element update, s, until one is measured.
const UPDATE: f64 = 2e-8;
/// Fewest element updates from which their time is measured.
const MIN_UPDATES: u64 = 200_000;
/// Largest ratio of the times of condensed bodies on a mesh and on the next coarser one.
const NEXT_LEVEL: f64 = 4.0;

/// Compare models and settings by their errors and run times
///
/// Computes the collision of a case with closed forms, condensed bodies and explicit elements, over the
/// element size and other settings that cost time. Prints what to choose, the fastest variants at each
/// accuracy with their errors against the extrapolated limit and, with -v, the limit and the sources of error. Writes a table (accuracy.csv), a
/// page (accuracy.md) and a figure (accuracy.svg).
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    #[command(flatten)]
    within: ToleranceArguments,
    /// Time budget in seconds; the run in progress is stopped
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    budget: f64,
    /// Print everything: all errors, the limit and the sources of error
    #[arg(long, short, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    output: OutputArguments,
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|s| *s > 0.0 && s.is_finite());
    seconds.ok_or_else(|| "give seconds, greater than 0".to_string())
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let (budget, quiet) = (arguments.budget, arguments.output.quiet);
    let case = arguments.input.load_within(&arguments.within)?;
    let variants = Variants::of(&case)?;
    if case.scene().is_oblique() {
        standard_output::note(
            "the study is that of the impact along the axis, which friction does not alter, by models that have friction: run the case for its tangential results",
        );
    }
    let identity = Identity::of(&case)?;
    let stem = arguments.input.stem();
    let digest = digest_of(["accuracy".as_bytes(), identity.case.as_bytes()]);
    let origin = arguments.input.origin_within(&arguments.within, "accuracy", digest);
    let mut output = arguments.output.claim(&stem, "accuracy", origin)?;
    if !quiet {
        announce(&arguments.input.name(), &variants, budget);
    }
    let measured = measure(&variants, budget, &interrupt, quiet)?;
    if interrupt.is_requested() {
        return Err(Failure::interrupted("interrupted: nothing was written")
            .with_help("--budget SECONDS ends the study after a time and keeps its results"));
    }
    let accuracy = case.scene().accuracy();
    let result = AccuracyResult {
        title: case.scene().title(),
        case: Simulation::resolve(&case)?,
        accuracy,
        variants: &variants,
        study: &Study::of(&variants, &measured, &accuracy),
        left_out: measured.iter().filter(|result| result.is_none()).count(),
        budget,
    };
    let table_of_all = csv(&result)
        .map_err(|error| Failure::failed(format!("accuracy.csv cannot be written: {error}")))?;
    output.write("accuracy.csv", table_of_all);
    let svg = figure(&result);
    let page = markdown(&result, svg.is_some());
    if let Some(svg) = svg {
        output.write("accuracy.svg", svg);
    }
    output.write("accuracy.md", page);
    output.publish(&json(&result), |_| text(&result, arguments.verbose))
}

/// Returns the text on stdout: what to choose, and the tables.
fn text(result: &AccuracyResult<'_>, is_whole: bool) -> String {
    let mut text = format!("{}\n\n", one_line(result.title));
    for Advice { sentence, overrides } in advice(result) {
        text += &(wrapped(&sentence) + "\n");
        // As a shell reads it, also if it is copied whole.
        let mut length = 0;
        for option in overrides {
            length += option.len() + 1;
            text += match length == option.len() + 1 {
                true => "   ",
                false if length <= 72 => "",
                false => {
                    length = option.len() + 1;
                    " \\\n   "
                }
            };
            text += &format!(" {option}");
        }
        text += if length > 0 { "\n" } else { "" };
    }
    for part in terminal_tables(result, is_whole) {
        let [head, rows @ ..] = &part.rows[..] else { continue };
        let rows = headed(&head.join("|>"), rows);
        text += &format!("\n{}\n{}\n", part.heading, rows.trim_end());
    }
    text
}

fn announce(case: &str, variants: &Variants, budget: f64) {
    let updates =
        variants.all.iter().fold(0u64, |sum, variant| sum.saturating_add(variant.element_updates));
    let text = format!(
        "{case}: {} variants, {} element updates in all, the cheapest first; ends after {}",
        variants.all.len(),
        HumanCount(updates),
        show(budget, "s")
    );
    standard_output::tell("", &text);
}

/// Runs the variants, the cheapest first, until the budget (s) is spent. Returns the result and the run time
/// (s) of each; `None` if it was left out for lack of time.
fn measure(
    variants: &Variants,
    budget: f64,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<Vec<Option<(Measurement, f64)>>, CaseError> {
    let progress = ItemProgress::new(interrupt.clone(), "variants", variants.all.len(), quiet);
    let end = Duration::try_from_secs_f64(budget).unwrap_or(Duration::MAX / 4);
    let deadline = Deadline { end: Instant::now() + end, interrupt };
    let (mut measured, mut n_skipped) = (vec![None; variants.all.len()], 0);
    let mut forecast = Forecast { update: UPDATE, condensed: 0.0 };
    for index in variants.cheapest_first() {
        let variant = &variants.all[index];
        let left = deadline.end.saturating_duration_since(Instant::now()).as_secs_f64();
        let fits = left > 0.0 && !interrupt.is_requested() && forecast.seconds(variant) <= left;
        if !fits {
            n_skipped += 1;
            continue;
        }
        let ran = run(variant, variants.contact_radius, deadline)?;
        let (took, series) = (show(ran.1, "s"), variant.series.name());
        progress.finish_item(&format!("{took:>12}  {series}  {}", variant.describe()));
        forecast.learn(variant, &ran);
        measured[index] =
            Some(ran).filter(|(result, _)| result.is_complete || Instant::now() < deadline.end);
    }
    progress.finish();
    if n_skipped > 0 && !quiet {
        let _ = writeln!(stderr(), "{n_skipped} variants skipped: the budget is spent");
    }
    Ok(measured)
}

/// Returns the result of a variant and the median of its run times, with new meshes each time and without
/// writing files.
fn run(
    variant: &Variant,
    contact_radius: f64,
    mut deadline: Deadline<'_>,
) -> Result<(Measurement, f64), CaseError> {
    let mut seconds = Vec::new();
    loop {
        let begin = Instant::now();
        let measurement = Measurement::of(variant, contact_radius, &mut deadline)?;
        let spent = begin.elapsed();
        seconds.push(spent.as_secs_f64());
        if seconds.len() == N_TIMES || spent > TIMED_THRICE {
            seconds.sort_by(f64::total_cmp);
            return Ok((measurement, seconds[seconds.len() / 2]));
        }
    }
}

/// A monitor that ends a run when the budget is spent or the user interrupts.
#[derive(Clone, Copy)]
struct Deadline<'a> {
    end: Instant,
    interrupt: &'a Interrupt,
}

impl Monitor for Deadline<'_> {
    fn report(&mut self, _: Progress) -> bool {
        Instant::now() < self.end && !self.interrupt.is_requested()
    }
}

/// Forecast of run times from those of earlier variants.
struct Forecast {
    update: f64,
    /// Time of the last condensed variant, s.
    condensed: f64,
}

impl Forecast {
    fn seconds(&self, variant: &Variant) -> f64 {
        match variant.element_updates {
            0 => NEXT_LEVEL * self.condensed,
            price => price as f64 * self.update,
        }
    }

    fn learn(&mut self, variant: &Variant, (measurement, seconds): &(Measurement, f64)) {
        match measurement.element_updates {
            None => self.condensed = if variant.value.is_some() { *seconds } else { 0.0 },
            Some(updates) if updates > MIN_UPDATES => self.update = seconds / updates as f64,
            Some(_) => {}
        }
    }
}
