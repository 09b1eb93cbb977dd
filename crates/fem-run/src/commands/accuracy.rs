//! `fem-run accuracy CASE`: errors and run times of all models and many settings.

use std::io::{Write, stderr};

use fem::accuracy::{Study, Variants};
use fem::{Identity, Simulation};
use fem_case::engineering::show;
use indicatif::HumanCount;

use crate::accuracy::{Climb, Findings, climb, json, markdown, picture, report, write_csv};
use crate::arguments::case::{CaseArguments, ToleranceArguments};
use crate::progress::interrupt::Interrupt;
use crate::result_folder::command_output::OutputArguments;
use crate::text::failure::Failure;
use crate::text::standard_output::{self, one_line};

/// Compare models and settings by their errors and run times
///
/// Computes the collision of a case with closed forms, condensed bodies and explicit elements, over the
/// element size and other settings that cost time. Prints the error of each against the extrapolated limit,
/// the fastest at each accuracy, the sources of error, and what to choose. Writes a table (accuracy.csv), a
/// page (accuracy.md) and a figure (accuracy.svg).
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    #[command(flatten)]
    within: ToleranceArguments,
    /// Time budget in seconds; what is running then is abandoned
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    budget: f64,
    #[command(flatten)]
    output: OutputArguments,
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|s| *s > 0.0 && s.is_finite());
    seconds.ok_or_else(|| "give seconds, greater than 0".to_string())
}

/// Runs the study of a case.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let interrupt = Interrupt::listen();
    let case = arguments.input.load_within(&arguments.within)?;
    let variants = Variants::of(&case)?;
    let identity = Identity::of(&case)?;
    let stem = arguments.input.stem();
    let mut output = arguments.output.claim(&stem, "accuracy", &[&identity.case])?;
    if !arguments.output.quiet {
        announce(&arguments.input.name(), &variants, arguments.budget);
    }

    let climbed = climb(&variants, arguments.budget, &interrupt, arguments.output.quiet)?;
    if interrupt.is_requested() {
        return Err(Failure::interrupted("interrupted: nothing was written")
            .with_help("--budget SECONDS ends the study after a time and keeps its results"));
    }
    let Climb { measured, left_out } = climbed;
    let study = Study::of(&variants, &measured, &case.scene().accuracy());
    let resolved = Simulation::resolve(&case)?;
    let findings = Findings {
        title: case.scene().title(),
        default: resolved,
        accuracy: case.scene().accuracy(),
        variants: &variants,
        measured: &measured,
        study: &study,
        left_out,
        budget: arguments.budget,
    };
    write_csv(&mut output, &findings)?;
    let svg = picture(&findings);
    let has_picture = svg.is_some();
    if let Some(svg) = svg {
        output.write("accuracy.svg", svg)?;
    }
    output.write("accuracy.md", markdown(&findings, has_picture))?;
    let place = output.publish(&json(&findings))?;
    if arguments.output.quiet {
        return Ok(());
    }
    standard_output::print(&format!("{}\nResult: {place}\n", report(&findings)))
}

/// Prints one line on stderr about the study.
fn announce(case: &str, variants: &Variants, budget: f64) {
    let updates = variants.all.iter().fold(0u64, |sum, variant| sum.saturating_add(variant.price));
    let _ = writeln!(
        stderr(),
        "{}: {} variants, {} element updates in all, the cheapest first; ends after {}",
        one_line(case),
        variants.all.len(),
        HumanCount(updates),
        show(budget, "s")
    );
}
