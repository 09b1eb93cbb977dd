//! `fem-run check CASE`: what a run would do, without running it.

use comfy_table::CellAlignment::Left;
use fem_case::{Case, Condensed, Problem, Reduced, Simulation};
use indicatif::{DecimalBytes, HumanCount};

use crate::arguments::CaseArguments;
use crate::engineering::show;
use crate::failure::Failure;
use crate::report;
use crate::standard_output;
use crate::tables::{mesh_table, pairs, table};

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
    let simulation = Simulation::new(Case::load(&arguments.input.case, &arguments.input.set)?)?;
    let resolved = simulation.resolved().to_toml();
    let resolved = resolved.map_err(|error| {
        Failure::failed(format!("the resolved case cannot be written as TOML: {error}"))
    })?;
    if arguments.quiet {
        return Ok(());
    }
    let case = arguments.input.case.display().to_string();
    let heading = format!("{case} is sound. What to expect of a run:");
    let expectation = format!("{}\n\n{}", standard_output::one_line(&heading), expect(&simulation));
    standard_output::print(&format!("{}\n{resolved}", as_comment(&expectation)))
}

/// What to expect of a run.
fn expect(simulation: &Simulation) -> String {
    let hertz = simulation.hertz();
    let closed_form = pairs([
        ("contact time", show(hertz.contact_time(), "s")),
        ("peak force", show(hertz.peak_force(), "N")),
        ("largest approach", show(hertz.max_approach(), "m")),
        ("largest contact radius", show(hertz.max_contact_radius(), "m")),
        ("peak pressure", show(hertz.peak_pressure(), "Pa")),
    ]);
    let model = match simulation {
        Simulation::Fem(problem) => elements(problem),
        Simulation::Condensed(condensed) => contact_nodes(condensed),
        Simulation::Reduced(reduced) => one_degree_of_freedom(reduced),
    };
    format!(
        "{model}\nHertz, instantaneous moduli\n{closed_form}\nEffects\n{}\n{}",
        report::effects(&simulation.effects()),
        report::warnings(simulation.warnings()),
    )
}

/// Mesh and cost of finite elements.
fn elements(problem: &Problem) -> String {
    let (cost, model) = (&problem.cost, &problem.model);
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
    let meshes = model.bodies().each_ref().map(|body| body.mesh());
    format!("Mesh\n{}\nCost\n{costs}", mesh_table(&problem.case.scene, meshes))
}

/// Mesh and cost of condensed bodies.
fn contact_nodes(condensed: &Condensed) -> String {
    let pair = &condensed.pair;
    let costs = pairs([
        ("contact points", format!("{} condensed", pair.n_points())),
        ("steps", format!("about {}", HumanCount(condensed.options().steps as u64))),
        ("factors", DecimalBytes(pair.factor_bytes() as u64).to_string()),
    ]);
    format!("Mesh\n{}\nCost\n{costs}", mesh_table(&condensed.case.scene, condensed.meshes()))
}

/// Model and cost of a reduced one.
fn one_degree_of_freedom(reduced: &Reduced) -> String {
    let force = reduced.law().map(|law| {
        format!(
            "F = K x^{} + C x^{} dx/dt, K = {:.5e} and C = {:.5e} SI",
            law.elastic_exponent(),
            law.damping_exponent(),
            law.stiffness(),
            law.damping()
        )
    });
    let mut rows = vec![["computes", reduced.describe().as_str()].map(String::from)];
    rows.extend(force.map(|force| ["force".to_string(), force]));
    rows.push(["cost", "milliseconds"].map(String::from));
    format!("Model\n{}", table(&[Left, Left], rows))
}

/// The same as TOML comments.
fn as_comment(text: &str) -> String {
    let comment = |line: &str| format!("# {line}").trim_end().to_string() + "\n";
    text.lines().map(comment).collect()
}
