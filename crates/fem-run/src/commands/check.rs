//! `fem-run check CASE`: what a run would do, without running it.

use fem_case::{Case, Problem};
use indicatif::{DecimalBytes, HumanCount};

use crate::arguments::CaseArguments;
use crate::engineering::show;
use crate::failure::Failure;
use crate::report;
use crate::standard_output;
use crate::tables::{mesh_table, pairs};

/// Check a case and print it with all defaults filled in
///
/// The output is a case file that gives the same result; comments say what to expect of a run.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Print nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// Checks a case.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let problem = Problem::new(Case::load(&arguments.input.case, &arguments.input.set)?)?;
    let resolved = problem.plan.resolve(&problem.case).to_toml();
    let resolved = resolved.map_err(|error| {
        Failure::failed(format!("the resolved case cannot be written as TOML: {error}"))
    })?;
    if arguments.quiet {
        return Ok(());
    }
    let case = arguments.input.case.display().to_string();
    let heading = format!("{case} is sound. What to expect of a run:");
    let expectation = format!("{}\n\n{}", standard_output::one_line(&heading), expect(&problem));
    standard_output::print(&format!("{}\n{resolved}", as_comment(&expectation)))
}

/// What to expect of a run.
fn expect(problem: &Problem) -> String {
    let (cost, model) = (&problem.cost, &problem.model);
    let hertz = &problem.plan.estimate.hertz;
    let longer = model.time_step() / model.plain_time_step();
    let costs = pairs([
        (
            "time step",
            format!(
                "{} ({longer:.2} times that without mass scaling)",
                show(model.time_step(), "s")
            ),
        ),
        ("steps", format!("about {}", HumanCount(cost.steps))),
        ("element updates", format!("about {:.1e}", cost.element_updates as f64)),
        ("memory", format!("about {}", DecimalBytes(cost.memory))),
    ]);
    let closed_form = pairs([
        ("contact time", show(hertz.contact_time(), "s")),
        ("peak force", show(hertz.peak_force(), "N")),
        ("largest approach", show(hertz.max_approach(), "m")),
        ("largest contact radius", show(hertz.max_contact_radius(), "m")),
        ("peak pressure", show(hertz.peak_pressure(), "Pa")),
    ]);
    format!(
        "Mesh\n{}\nCost\n{costs}\nHertz, instantaneous moduli\n{closed_form}\nEffects\n{}\n{}",
        mesh_table(&problem.case.scene, model.bodies().each_ref().map(|body| body.mesh())),
        report::effects(&problem.effects()),
        report::warnings(&problem.plan.warnings),
    )
}

/// The same as TOML comments.
fn as_comment(text: &str) -> String {
    let comment = |line: &str| format!("# {line}").trim_end().to_string() + "\n";
    text.lines().map(comment).collect()
}
