//! `fem-run export CASE`: snippets for DEM codes from a sweep's restitutions, or Ting's.

use std::path::PathBuf;

use comfy_table::CellAlignment::{Left, Right};
use fem::Reduced;
use fem::measured::Restitutions;
use fem_case::{Case, ModelChoice};
use fem_figure::{Axis, COLOURS, Chart, Curve as Line, Mark};
use fem_fit::dem::{Export, Snippet, Sphere, lammps_snippets, liggghts_snippets, yade_snippets};
use fem_fit::{FitError, Point};
use fem_laws::{EndRule, Family, Ting};
use serde_json::{Value, json};

use crate::case_arguments::CaseArguments;
use crate::data_file::read_table;
use crate::engineering::{Unit, show};
use crate::failure::Failure;
use crate::reduced::{
    Curve, Drawn, OutputArguments, fit_export, from_fit_error, model_of, parse_speed, spheres_of,
};
use crate::standard_output;
use crate::tables::table;

/// Write input for LAMMPS, LIGGGHTS and YADE that makes the same restitutions
///
/// They come from the sweep.csv of a sweep over speeds, from a measurement, or, without --data,
/// from the case's model: a law, ting, or in place of finite elements ting. Each snippet says at which speeds it is good.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Restitutions, and contact times if it has them: a CSV file, such as a sweep's sweep.csv
    #[arg(long, value_name = "FILE", conflicts_with = "speeds")]
    data: Option<PathBuf>,
    /// Speeds that are computed, such as '5 cm/s..2 m/s' [default: a decade around that of the case]
    #[arg(long, value_name = "LOW..HIGH", value_parser = parse_speeds)]
    speeds: Option<(f64, f64)>,
    /// Error of the restitution up to which a snippet is called good
    #[arg(long, value_name = "E", default_value_t = 0.01)]
    tolerance: f64,
    #[command(flatten)]
    output: OutputArguments,
}

/// Speeds at which a reduced model is computed.
const N_SPEEDS: usize = 13;

/// Fits and writes.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    if !(arguments.tolerance > 0.0 && arguments.tolerance < 1.0) {
        let message = format!("--tolerance is {:?}", arguments.tolerance);
        return Err(Failure::bad_input(message).with_help("it must be between 0 and 1"));
    }
    let case = Case::load(&arguments.input.case, &arguments.input.set)?;
    let curve = curve(arguments, &case)?;
    let fitted = fit_export(&case, spheres_of(&case), &curve, arguments.tolerance);
    let (export, drawn) = fitted.map_err(|error| {
        let is_lossless = matches!(error, FitError::Insensitive { .. });
        let failure = from_fit_error(error);
        if is_lossless {
            failure.with_help(
                "an elastic contact needs no fit, its restitution is 1; if there is a loss, narrow \
                 the range of speeds",
            )
        } else {
            failure
        }
    })?;
    let failed = |error: fem_laws::LawError| from_fit_error(error.into());
    let mut snippets = lammps_snippets(&export).map_err(failed)?;
    snippets.extend(liggghts_snippets(&export).map_err(failed)?);
    snippets.extend(yade_snippets(&export).map_err(failed)?);
    let mut output = arguments.output.claim(&arguments.input.stem(), "export")?;
    for snippet in &snippets {
        output.write(snippet.name, &snippet.text)?;
    }
    output.write("export.svg", picture(&curve, &drawn))?;
    let place = output.publish(numbers(&arguments.input, &export, &curve, &drawn, &snippets))?;
    if arguments.output.quiet {
        return Ok(());
    }
    let mut note = String::new();
    if curve.has_hertz_times {
        note +=
            "\nThe data have no contact times: Hertz' stand in for them in the linear models.\n";
    }
    if export.spheres.len() < 2 {
        note += "\nA wall is written for LAMMPS only: LIGGGHTS and YADE give it a material or a radius \
                 of its own.\n";
    }
    standard_output::print(&format!("{}{note}\nResult: {place}\n", text(&export, &snippets)))
}

fn curve(arguments: &Arguments, case: &Case) -> Result<Curve, Failure> {
    if let Some(path) = &arguments.data {
        let data = Restitutions::read_with_contact_times(&read_table(path)?, &case.scene)?;
        if data.points.len() < 2 {
            return Err(Failure::bad_input(format!("{}: one speed only", data.name))
                .with_help("a range of validity needs two speeds or more"));
        }
        let pair = case.scene.pair().map_err(|error| from_fit_error(error.into()))?;
        return Curve::of(&pair, data.points).map_err(from_fit_error);
    }
    let reduced = reduced(case)?;
    let middle = case.scene.approach_speed();
    let decade = 10f64.sqrt();
    let (low, high) = arguments.speeds.unwrap_or((middle / decade, middle * decade));
    let speed = |k: usize| low * (high / low).powf(k as f64 / (N_SPEEDS - 1) as f64);
    let speeds: Vec<f64> = (0..N_SPEEDS).map(speed).collect();
    Curve::computed(&reduced, &speeds).map_err(from_fit_error)
}

/// The case's own model; Ting's in place of one with elements.
fn reduced(case: &Case) -> Result<Reduced, Failure> {
    let mut case = case.clone();
    let is_reduced = !matches!(case.scene.model, ModelChoice::Fem | ModelChoice::Condensed(_));
    if !is_reduced {
        model_of(&case, Family::Ting, EndRule::ZeroForce).map_err(|error| {
            from_fit_error(error).with_help(
                "give a material a [material.NAME.relaxation] table, a law in [model], or \
                 restitutions with --data",
            )
        })?;
        let tolerance = Ting::DEFAULT_TOLERANCE;
        case.scene.model = ModelChoice::Ting { finite_size: false, tolerance };
    }
    Ok(Reduced::new(&case.scene).map_err(|refusal| refusal.in_case(&case))?)
}

fn parse_speeds(text: &str) -> Result<(f64, f64), String> {
    let (low, high) = text.split_once("..").ok_or("write LOW..HIGH, such as '5 cm/s..2 m/s'")?;
    let (low, high) = (parse_speed(low)?, parse_speed(high)?);
    if low < high { Ok((low, high)) } else { Err("the range is empty".to_string()) }
}

fn text(export: &Export, snippets: &[Snippet]) -> String {
    let header = ["code", "model", "enter", "makes e", "good to tolerance", "worst error", "file"];
    let row = |snippet: &Snippet| {
        let [from, to, worst] = snippet.validity;
        let entries = snippet.entries.iter().map(|(key, value)| format!("{key} {}", entry(*value)));
        [
            snippet.code.to_string(),
            snippet.model.to_string(),
            entries.collect::<Vec<_>>().join(", "),
            snippet.restitution.map_or("falls with v".to_string(), |e| format!("{e:.4}")),
            if from <= to {
                format!("{} to {}", show(from, "m/s"), show(to, "m/s"))
            } else {
                "nowhere".to_string()
            },
            format!("{worst:.4}"),
            snippet.name.to_string(),
        ]
    };
    let rows = std::iter::once(header.map(String::from)).chain(snippets.iter().map(row));
    format!(
        "{}, {} to {}; a snippet is good where its restitution is right to {}\n\n{}",
        standard_output::one_line(&export.title),
        show(export.speeds.0, "m/s"),
        show(export.speeds.1, "m/s"),
        export.tolerance,
        table(&[Left, Left, Left, Right, Left, Right, Left], rows)
    )
}

fn entry(value: f64) -> String {
    if (0.001..1e4).contains(&value) { format!("{value:.4}") } else { format!("{value:.4e}") }
}

fn numbers(
    input: &CaseArguments,
    export: &Export,
    curve: &Curve,
    drawn: &[Drawn],
    snippets: &[Snippet],
) -> Value {
    let snippet = |snippet: &Snippet| {
        let [from, to, worst] = snippet.validity;
        let entries = snippet.entries.iter().map(|(key, value)| (key.to_string(), json!(value)));
        // What depends on speed is the viscoelastic damping.
        let viscoelastic = drawn.iter().find(|law| law.model.family() == Family::KuwabaraKono);
        let at_speed = |point: &Point| match (snippet.restitution, viscoelastic) {
            (Some(restitution), _) => Some(restitution),
            (None, Some(law)) => law.outcome(point.speed).map(|outcome| outcome.restitution),
            (None, None) => None,
        };
        json!({
            "file": snippet.name,
            "code": snippet.code,
            "model": snippet.model,
            "entries": Value::Object(entries.collect()),
            "restitution": snippet.restitution,
            "valid_from_m_s": (from <= to).then_some(from),
            "valid_to_m_s": (from <= to).then_some(to),
            "worst_error": worst,
            "restitutions_at_data": curve.points.iter().map(at_speed).collect::<Vec<_>>(),
        })
    };
    let sphere = |sphere: &Sphere| {
        json!({ "diameter_m": sphere.diameter, "density_kg_m3": sphere.density,
            "youngs_modulus_pa": sphere.youngs_modulus, "poissons_ratio": sphere.poissons_ratio })
    };
    let point = |point: &Point| {
        json!({ "speed_m_s": point.speed, "restitution": point.restitution,
            "contact_time_s": point.contact_time })
    };
    json!({
        "case": input.case.display().to_string(),
        "wall": export.spheres.len() < 2,
        "spheres": export.spheres.iter().map(sphere).collect::<Vec<_>>(),
        "tolerance": export.tolerance,
        "speeds_m_s": export.speeds,
        "effective_mass_kg": export.pair.effective_mass(),
        "effective_radius_m": export.pair.effective_radius(),
        "contact_modulus_pa": export.pair.contact_modulus(),
        "dissipation_time_s": export.dissipation_time.0,
        "linear_contact_time_s": export.linear.contact_time,
        "has_hertz_times": curve.has_hertz_times,
        "data": curve.points.iter().map(point).collect::<Vec<_>>(),
        "snippets": snippets.iter().map(snippet).collect::<Vec<_>>(),
    })
}

/// e(v) and T(v): data and the three kinds of law.
fn picture(curve: &Curve, drawn: &[Drawn]) -> String {
    let fastest = curve.points[curve.points.len() - 1].speed;
    let longest = curve.points.iter().filter_map(|point| point.contact_time).fold(0.0, f64::max);
    let (speed, time) = (Unit::fitting(fastest, "m/s"), Unit::fitting(longest, "s"));
    let panel = |y_label: String, data: Vec<(f64, f64)>, y: &dyn Fn(&Drawn, f64) -> Option<f64>| {
        // The linear law hides the other constant one.
        let mark = |law: &Drawn| match law.model.family() {
            Family::Linear => Mark::Dashed,
            _ => Mark::Line,
        };
        let law = |(law, colour): (&Drawn, &'static str)| {
            let points = curve
                .points
                .iter()
                .filter_map(|point| Some((speed.scaled(point.speed), y(law, point.speed)?)));
            Line::new(law.name, mark(law), points.collect()).coloured(colour)
        };
        let axis = Axis::new(format!("approach speed [{}]", speed.symbol())).logarithmic();
        let colours = [COLOURS[0], COLOURS[2], COLOURS[3]];
        let laws = drawn.iter().zip(colours).map(law);
        laws.fold(Chart::new(axis, Axis::new(y_label)), Chart::with)
            .with(Line::points("data", data).like_curve(1))
    };
    let points = || curve.points.iter();
    let e_data = points().map(|point| (speed.scaled(point.speed), point.restitution)).collect();
    let t_data = points()
        .filter_map(|point| Some((speed.scaled(point.speed), time.scaled(point.contact_time?))))
        .collect();
    let charts = [
        panel("restitution".to_string(), e_data, &|law, speed| {
            law.outcome(speed).map(|outcome| outcome.restitution)
        }),
        panel(format!("contact time [{}]", time.symbol()), t_data, &|law, speed| {
            law.outcome(speed)?.contact_time.map(|contact| time.scaled(contact))
        }),
    ];
    fem_figure::svg(&charts).unwrap_or_default()
}
