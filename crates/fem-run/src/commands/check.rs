//! `fem-run check CASE`: what a run would do, without running it.

use std::time::{Duration, Instant};

use comfy_table::CellAlignment::Left;
use fem::effects::percent;
use fem::{Cost, ErrorEstimator, RefinedBeforeRun, Simulation, divided_radius};
use fem_case::Case;
use fem_case::EffectsTable;
use fem_case::engineering::{number, show};
use fem_collision::QuantityOfInterest;
use fem_laws::laws::ContactLaw;

use crate::{
    arguments::case::{CaseArguments, ToleranceArguments},
    forecast::{Forecast, closed_form_time, estimated, estimated_count, estimated_time},
    progress::stopwatch::peak_memory_with,
    text::{
        Failure, headed, mesh_table, pairs, run_report, run_report::Detail, standard_output, table,
    },
};

/// Time for the reference runs that decide whether the mesh is fine enough.
const PATIENCE_WITH_REFERENCE_RUNS: Duration = Duration::from_secs(2);

/// Check a case and print its warnings, its cost and its effects
///
/// With --resolved the output is a case file with all defaults filled in, which gives the same result; its
/// comments describe the expected run.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    #[command(flatten)]
    within: ToleranceArguments,
    /// Print the case with all defaults filled in, as TOML
    #[arg(long)]
    resolved: bool,
    /// Print everything: meshes, all models, and each effect with its reason and the error of leaving it out
    #[arg(long, short, conflicts_with_all = ["quiet", "resolved"])]
    verbose: bool,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load_within(&arguments.within)?;
    // A resolved case describes the expected run in its comments.
    let detail = if arguments.verbose || arguments.resolved { Detail::All } else { Detail::Short };
    let checked = Checked::of(case, &arguments.input.name(), detail)?;
    if arguments.quiet {
        standard_output::warn(checked.simulation.warnings_before());
    }
    match (arguments.resolved, arguments.quiet) {
        (true, _) => standard_output::print(&checked.resolved()?),
        (false, true) => Ok(()),
        (false, false) => standard_output::print(&checked.expectation),
    }
}

/// Returns the resolved case as TOML, with comments on the expected run.
pub fn text(case: Case, name: &str) -> Result<String, Failure> {
    Checked::of(case, name, Detail::All)?.resolved()
}

struct Checked {
    simulation: Simulation,
    /// The warnings and the expected run.
    expectation: String,
}

impl Checked {
    fn of(case: Case, name: &str, detail: Detail) -> Result<Self, Failure> {
        let begin = Instant::now();
        let simulation = Simulation::new(case)?;
        let making = begin.elapsed().as_secs_f64();
        let mut estimator = ErrorEstimator::default();
        let RefinedBeforeRun { simulation, is_open } = estimator
            .refine_before_run(simulation, || begin.elapsed() < PATIENCE_WITH_REFERENCE_RUNS);
        let setup = begin.elapsed().as_secs_f64();
        let forecast = Forecast::of(&simulation, &mut estimator, making, is_open);
        let scene = simulation.case().scene();
        let notes = [scene.large_spheres(), scene.reference_temperatures()].into_iter().flatten();
        let large: String = notes.map(|note| format!(", with {note}")).collect();
        let (warnings, none) = match simulation.warnings_before() {
            none if none.is_empty() => (String::new(), ", without warnings"),
            some => (run_report::warnings(&some) + "\n", ""),
        };
        let heading = format!("{name} is valid{large}{none}. Expected of a run:");
        let expected = expect(&simulation, &estimator, setup, &forecast, detail);
        let heading = standard_output::one_line(&heading);
        let expectation = format!("{warnings}{heading}\n\n{expected}");
        Ok(Self { simulation, expectation })
    }

    fn resolved(&self) -> Result<String, Failure> {
        let resolved = self.simulation.case().toml_of(self.simulation.resolved());
        let resolved = resolved.map_err(|error| {
            Failure::failed(format!("the resolved case cannot be written as TOML: {error}"))
        })?;
        Ok(format!("{}\n{resolved}", as_comment(&self.expectation)))
    }
}

fn expect(
    simulation: &Simulation,
    estimator: &ErrorEstimator,
    spent: f64,
    forecast: &Forecast,
    detail: Detail,
) -> String {
    let setup = simulation.setup();
    let hertz = &setup.estimate.hertz;
    let hertz = pairs([
        ("contact time", show(hertz.contact_time(), "s")),
        ("peak force", show(hertz.peak_force(), "N")),
        ("largest approach", show(hertz.max_approach(), "m")),
        ("largest contact radius", show(hertz.max_contact_radius(), "m")),
        ("peak pressure", show(hertz.peak_pressure(), "Pa")),
    ]);
    let costs = costs(simulation, estimator, Some(forecast), time(simulation, spent, forecast));
    let model = match &setup.cost {
        Cost::Steps { .. } | Cost::Factors { .. } => {
            let scene = simulation.case().scene();
            let meshes = match detail {
                Detail::Short => String::new(),
                Detail::All => format!(
                    "Mesh\n{}{}\n",
                    mesh_table(scene, simulation.model().meshes()),
                    by_tolerance(simulation)
                ),
            };
            format!("{meshes}Cost{}\n{costs}", of_contacts(simulation))
        }
        Cost::ClosedForm { law } => {
            one_degree_of_freedom(&setup.description, law.as_ref(), closed_form_time(simulation))
        }
    };
    let hertz = format!("\nHertz, instantaneous moduli\n{hertz}");
    let decisions = &setup.decisions.all;
    if detail == Detail::Short {
        let (case, considered) = (simulation.resolved(), simulation.considered());
        let effects = run_report::effects_in_short(Vec::new(), decisions.iter(), case, considered);
        return format!("{model}{hertz}\n{effects}");
    }
    format!(
        "{}{model}{}{hertz}\nEffects\n{}\nErrors of leaving effects out (?: not known)\n{}",
        models(simulation),
        unforced(simulation),
        run_report::effects(decisions.iter()),
        neglect_errors(simulation),
    )
}

/// Returns the models that were considered; empty if the case names its model.
fn models(simulation: &Simulation) -> String {
    match simulation.considered() {
        [] => String::new(),
        considered => {
            format!("Models and their expected errors\n{}\n", run_report::models(considered))
        }
    }
}

/// Returns the changes of the results without each effect.
fn neglect_errors(simulation: &Simulation) -> String {
    let setup = simulation.setup();
    let rows = setup.decisions.all.iter().map(|decision| {
        let neglect_error = simulation.neglect_error(decision, &setup.estimate).unwrap_or_default();
        let [restitution, time, force] = run_report::changes(&neglect_error);
        [decision.name.to_string(), restitution, time, force]
    });
    headed("|>restitution|>contact time|>peak force", rows)
}

/// Returns the cost with the default effects; empty if the case does not override them.
fn unforced(simulation: &Simulation) -> String {
    let forced = simulation.case().scene().effects();
    let is_forced = forced.filled() != EffectsTable::default().filled();
    let planned = is_forced.then(|| simulation.case().edited(|file| file.effects = None));
    match planned.and_then(Result::ok).map(Simulation::new) {
        Some(Ok(planned)) if planned.setup().cost != simulation.setup().cost => {
            let costs = costs(&planned, &ErrorEstimator::default(), None, Vec::new());
            format!("\nCost with the default [effects]\n{costs}")
        }
        _ => String::new(),
    }
}

/// Returns the keys that follow from the tolerance, and their values; empty if the case gives all.
fn by_tolerance(simulation: &Simulation) -> String {
    let Some(elements) = &simulation.setup().elements else { return String::new() };
    let plan = &elements.plan;
    let open = |key: &str| !simulation.case().gives(key);
    let mut rows = Vec::new();
    if plan.makes_meshes && open("mesh.contact_element_size") {
        let across = divided_radius(&simulation.setup().estimate) / plan.contact_element_size;
        let staggered =
            if plan.finer_body.is_some() { ", meshes offset by half an element" } else { "" };
        let size = show(plan.contact_element_size, "m");
        let text = format!("{size}, {across:.2} elements across the contact{staggered}");
        rows.push(["mesh.contact_element_size".to_string(), text]);
    }
    let has_steps = matches!(simulation.setup().cost, Cost::Steps { .. });
    if has_steps && open("time.mass_scaling") {
        let text = format!("{} of the lighter body's mass", percent(plan.mass_scaling));
        rows.push(["time.mass_scaling".to_string(), text]);
    }
    if rows.is_empty() {
        return String::new();
    }
    let (quantity, tolerance) = plan.limiting_quantity;
    let tolerance = match quantity {
        QuantityOfInterest::Restitution => number(tolerance, 3),
        _ => format!("{} %", number(100.0 * tolerance, 3)),
    };
    let (table, name) = (table(&[Left, Left], rows), quantity.name());
    format!("\nChosen by accuracy.tolerance = {tolerance}: the {name} decides\n{table}")
}

/// Returns which contact the cost refers to, if there may be several.
fn of_contacts(simulation: &Simulation) -> String {
    match simulation.case().scene().gravity().map_or(1, |gravity| gravity.bounces) {
        1 => String::new(),
        n => format!(" of the first contact, of up to {n}"),
    }
}

/// Returns the time of a run after its setup, and the mesh refinements that may follow.
fn time(simulation: &Simulation, setup: f64, forecast: &Forecast) -> Vec<[String; 2]> {
    let mut rows = Vec::new();
    if let Some(why) = simulation.refined_because() {
        rows.push(["finer mesh".to_string(), why]);
    }
    rows.extend(
        forecast
            .whole(setup)
            .map(|seconds| ["time".to_string(), format!("about {} here", estimated_time(seconds))]),
    );
    rows.extend(forecast.finer.map(|finer| {
        let when = "if the result misses accuracy.tolerance";
        ["mesh refinement".to_string(), format!("{when}: {}", finer.in_words())]
    }));
    rows
}

fn costs(
    simulation: &Simulation,
    estimator: &ErrorEstimator,
    forecast: Option<&Forecast>,
    time: Vec<[String; 2]>,
) -> String {
    let mut rows: Vec<[String; 2]> = Vec::new();
    let mut row = |name: &str, value: String| rows.push([name.to_string(), value]);
    match simulation.setup().cost {
        Cost::Steps { steps, element_updates, time_step, plain_time_step, .. } => {
            let longer = time_step / plain_time_step;
            let step = show(time_step, "s");
            row("time step", format!("{step} ({longer:.2} times that without mass scaling)"));
            let longer = forecast.map_or(1.0, |forecast| forecast.updates_over_expected);
            row("steps", format!("about {}", estimated_count(longer * steps as f64)));
            let element_updates = longer * element_updates as f64;
            let all = forecast.map(|forecast| forecast.element_updates);
            let all = all.filter(|all| *all > 1.05 * element_updates);
            let all = all.map_or(String::new(), |all| format!(", {all:.1e} with reference runs"));
            row("element updates", format!("about {element_updates:.1e}{all}"));
        }
        Cost::Factors { contact_points, steps, factor_bytes, .. } => {
            row("contact points", format!("{contact_points} condensed"));
            row("steps", format!("about {}", estimated_count(steps as f64)));
            if factor_bytes > 0 {
                row("factors", estimated(factor_bytes as f64, "B"));
            }
        }
        Cost::ClosedForm { .. } => {}
    }
    if let Some(bytes) = peak_memory_with(simulation, estimator) {
        row("memory", format!("about {}", estimated(bytes as f64, "B")));
    }
    rows.extend(time);
    table(&[Left, Left], rows)
}

/// Returns model and cost of a model with one degree of freedom.
fn one_degree_of_freedom(description: &str, law: Option<&ContactLaw>, time: &str) -> String {
    let force = law.filter(|law| law.elastic_plastic().is_none()).map(|law| {
        format!(
            "F = K x^{} + C x^{} dx/dt, K = {:.5e} and C = {:.5e} SI",
            law.elastic_exponent(),
            law.damping_exponent(),
            law.stiffness(),
            law.damping()
        )
    });
    let mut rows = vec![["computes", description].map(String::from)];
    rows.extend(force.map(|force| ["force".to_string(), force]));
    rows.push(["cost", time].map(String::from));
    format!("Model\n{}", table(&[Left, Left], rows))
}

fn as_comment(text: &str) -> String {
    let comment = |line: &str| format!("# {line}").trim_end().to_string() + "\n";
    text.lines().map(comment).collect()
}
