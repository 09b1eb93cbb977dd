//! `fem-run export CASE`: snippets for DEM codes from a sweep's restitutions, or Ting's.

use std::path::PathBuf;

use comfy_table::CellAlignment::{Left, Right};
use fem::case_identity;
use fem::laws::{DemExport, FittedLaw, ImpactCurve};
use fem::measured::{Restitutions, Table};
use fem_case::Case;
use fem_case::engineering::{Unit, show};
use fem_figure::{Axis, COLOURS, Chart, Curve, Mark};
use fem_fit::FitError;
use fem_fit::dem::{Export, Snippet};
use fem_laws::Family;
use serde_json::Value;

use crate::case_arguments::CaseArguments;
use crate::data_file::ColumnArguments;
use crate::failure::Failure;
use crate::jobs::value_of;
use crate::law_arguments::parse_speed;
use crate::output::OutputArguments;
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
    #[command(flatten)]
    columns: ColumnArguments,
    /// Speeds that are computed, such as '5 cm/s..2 m/s' [default: a decade around that of the case]
    #[arg(long, value_name = "LOW..HIGH", value_parser = parse_speeds)]
    speeds: Option<(f64, f64)>,
    /// Error of the restitution up to which a snippet is called good
    #[arg(long, value_name = "E", default_value_t = 0.01)]
    tolerance: f64,
    #[command(flatten)]
    output: OutputArguments,
}

/// Fits and writes.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load()?;
    let table = arguments.data.as_deref().map(|path| arguments.columns.read(path)).transpose()?;
    let (fitted, snippets) = fitted(arguments, &case, table.as_ref())?;
    let mut output =
        arguments.output.claim(&arguments.input.stem(), "export", &[&case_identity(&case)])?;
    for snippet in &snippets {
        output.write(snippet.name, &snippet.text)?;
    }
    output.write("export.svg", picture(&fitted))?;
    let name = arguments.input.name();
    let place = output.publish(&fitted.numbers(&name, &snippets))?;
    if arguments.output.quiet {
        return Ok(());
    }
    let mut note = String::new();
    if fitted.curve.has_hertz_times {
        note +=
            "\nThe data have no contact times: Hertz' stand in for them in the linear models.\n";
    }
    if fitted.export.spheres.len() < 2 {
        note += "\nA wall is written for LAMMPS only: LIGGGHTS and YADE give it a material or a radius \
                 of its own.\n";
    }
    standard_output::print(&format!("{}{note}\nResult: {place}\n", text(&fitted.export, &snippets)))
}

/// Fits to a table in place of the file that the arguments name, and gives the numbers, each snippet with its
/// text.
pub fn numbers(
    arguments: &Arguments,
    case: &Case,
    table: Option<&Table>,
) -> Result<Value, Failure> {
    let table = table.cloned().map(|table| arguments.columns.name_columns(table)).transpose()?;
    let (fitted, snippets) = fitted(arguments, case, table.as_ref())?;
    let mut numbers = value_of(&fitted.numbers(&arguments.input.name(), &snippets))?;
    let texts =
        snippets.iter().map(|snippet| (snippet.name.to_string(), snippet.text.clone().into()));
    numbers["texts"] = Value::Object(texts.collect());
    Ok(numbers)
}

fn fitted(
    arguments: &Arguments,
    case: &Case,
    table: Option<&Table>,
) -> Result<(DemExport, Vec<Snippet>), Failure> {
    if !(arguments.tolerance > 0.0 && arguments.tolerance < 1.0) {
        let message = format!("--tolerance is {:?}", arguments.tolerance);
        return Err(Failure::bad_input(message).with_help("it must be between 0 and 1"));
    }
    let curve = match table {
        None => ImpactCurve::computed(case, arguments.speeds)?,
        Some(table) => {
            let data = Restitutions::read_with_contact_times(table, case.scene())?;
            ImpactCurve::measured(case.scene(), &data)?
        }
    };
    let fitted = DemExport::of(case, curve, arguments.tolerance).map_err(|error| {
        let is_lossless = matches!(error, FitError::Insensitive { .. });
        let failure = Failure::from(error);
        if is_lossless {
            failure.with_help(
                "an elastic contact needs no fit, its restitution is 1; if there is a loss, narrow \
                 the range of speeds",
            )
        } else {
            failure
        }
    })?;
    let snippets = fitted.snippets()?;
    Ok((fitted, snippets))
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

/// e(v) and T(v): data and the three kinds of law.
fn picture(fitted: &DemExport) -> String {
    let (curve, fastest) = (&fitted.curve, fitted.curve.speeds().1);
    let longest = curve.points.iter().filter_map(|point| point.contact_time).fold(0.0, f64::max);
    let (speed, time) = (Unit::fitting(fastest, "m/s"), Unit::fitting(longest, "s"));
    let panel =
        |y_label: String, data: Vec<(f64, f64)>, y: &dyn Fn(&FittedLaw, f64) -> Option<f64>| {
            // The linear law hides the other constant one.
            let mark = |law: &FittedLaw| match law.model.family() {
                Family::Linear => Mark::Dashed,
                _ => Mark::Line,
            };
            let law = |(law, colour): (&FittedLaw, &'static str)| {
                let points = curve
                    .points
                    .iter()
                    .filter_map(|point| Some((speed.scaled(point.speed), y(law, point.speed)?)));
                Curve::new(law.name, mark(law), points.collect()).coloured(colour)
            };
            let axis = Axis::new(format!("approach speed [{}]", speed.symbol())).logarithmic();
            let colours = [COLOURS[0], COLOURS[2], COLOURS[3]];
            let laws = fitted.laws.iter().zip(colours).map(law);
            laws.fold(Chart::new(axis, Axis::new(y_label)), Chart::with)
                .with(Curve::points("data", data).like_curve(1))
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
