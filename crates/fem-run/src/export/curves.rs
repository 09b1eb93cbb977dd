//! One pair as text and as a picture.

use comfy_table::CellAlignment::{Left, Right};
use fem::laws::{DemExport, FittedLaw};
use fem_case::engineering::{Unit, number, show};
use fem_figure::{Axis, COLOURS, Chart, Curve, Mark};
use fem_fit::dem::{Export, Snippet};
use fem_laws::LawFamily;

use crate::standard_output;
use crate::tables::table;

/// What is printed: a line a snippet.
pub fn export_text(export: &Export, snippets: &[Snippet]) -> String {
    let header = ["code", "model", "enter", "makes e", "good to tolerance", "worst error", "file"];
    let row = |snippet: &Snippet| {
        let [from, to, worst] = snippet.validity;
        let entries = snippet.entries.iter().map(|(key, value)| format!("{key} {}", entry(*value)));
        [
            snippet.code.to_string(),
            snippet.model.to_string(),
            entries.collect::<Vec<_>>().join(", "),
            snippet.restitution.map_or("falls with v".to_string(), |e| format!("{e:.4}")),
            good(Some(from).filter(|from| *from <= to), Some(to)),
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

/// Where a snippet is good, in words.
pub fn good(from: Option<f64>, to: Option<f64>) -> String {
    match (from, to) {
        (Some(from), Some(to)) if from == to => format!("at {} alone", show(from, "m/s")),
        (Some(from), Some(to)) => format!("{} to {}", show(from, "m/s"), show(to, "m/s")),
        _ => "nowhere".to_string(),
    }
}

/// A number without a unit in five digits.
fn entry(value: f64) -> String {
    number(value, 5)
}

/// e(v) and T(v): data and the three kinds of law.
pub fn export_picture(fitted: &DemExport) -> String {
    let (curve, fastest) = (&fitted.curve, fitted.curve.speeds().1);
    let longest = curve.points.iter().filter_map(|point| point.contact_time).fold(0.0, f64::max);
    let (speed, time) = (Unit::fitting(fastest, "m/s"), Unit::fitting(longest, "s"));
    let panel = |y_label: String,
                 (is_measured, data): (bool, Vec<(f64, f64)>),
                 y: &dyn Fn(&FittedLaw, f64) -> Option<f64>| {
        // The linear law hides the other constant one.
        let mark = |law: &FittedLaw| match law.model.family() {
            LawFamily::Linear => Mark::Dashed,
            _ => Mark::Line,
        };
        let law = |(law, colour): (&FittedLaw, &'static str)| {
            let points = curve
                .points
                .iter()
                .filter_map(|point| Some((speed.scaled(point.speed), y(law, point.speed)?)));
            Curve::new(law.name, mark(law), points.collect()).coloured(colour)
        };
        let axis = Axis::new(format!("impact speed v [{}]", speed.symbol())).logarithmic();
        let colours = [COLOURS[0], COLOURS[2], COLOURS[3]];
        let laws = fitted.laws.iter().zip(colours).map(law);
        laws.fold(Chart::new(axis, Axis::new(y_label)), Chart::with).with(
            Curve::points(if is_measured { "data" } else { "Hertz, in place of data" }, data)
                .like_curve(if is_measured { 1 } else { 6 }),
        )
    };
    let points = || curve.points.iter();
    let e_data = points().map(|point| (speed.scaled(point.speed), point.restitution)).collect();
    let t_data = points()
        .filter_map(|point| Some((speed.scaled(point.speed), time.scaled(point.contact_time?))))
        .collect();
    let charts = [
        panel("restitution e".to_string(), (true, e_data), &|law, speed| {
            law.outcome(speed).map(|outcome| outcome.restitution)
        }),
        panel(
            format!("contact time T [{}]", time.symbol()),
            (!curve.has_hertz_times, t_data),
            &|law, speed| law.outcome(speed)?.contact_time.map(|contact| time.scaled(contact)),
        ),
    ];
    fem_figure::svg(&charts).unwrap_or_default()
}
