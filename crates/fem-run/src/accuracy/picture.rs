//! `accuracy.svg`: errors over run time on logarithmic axes, and the best variant for each time.

use fem::accuracy::Series;
use fem_collision::QuantityOfInterest;
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};

use super::findings::{Findings, Line};

/// Smaller errors are drawn here; no limit is known better.
const LEAST: f64 = 1e-6;
/// Series that are drawn with a line, over the element size.
const DRAWN: [Series; 7] = [
    Series::Condensed,
    Series::CondensedVibrating,
    Series::Explicit,
    Series::ExplicitScaled,
    Series::ExplicitGrown,
    Series::Penalty,
    Series::NodeToSurface,
];

/// Returns the figure; `None` without any variant.
pub fn picture(findings: &Findings<'_>) -> Option<String> {
    let uncertain = |quantity: QuantityOfInterest| {
        let limit = findings.study.limits[quantity as usize]?;
        Some((limit.uncertainty / quantity.scale(limit.value)).max(LEAST))
    };
    let three = [
        QuantityOfInterest::Restitution,
        QuantityOfInterest::ContactTime,
        QuantityOfInterest::PeakForce,
    ];
    let worst = three.into_iter().filter_map(uncertain).fold(LEAST, f64::max);
    let of = |quantity: QuantityOfInterest, label: &str| {
        let known = uncertain(quantity).unwrap_or(LEAST);
        panel(findings, label, known, |line| line.judged.sure[quantity as usize])
    };
    let panels = [
        panel(findings, "worst error of e, T and F", worst, |line| line.judged.worst),
        of(QuantityOfInterest::PeakPressure, "error of the peak pressure"),
        of(QuantityOfInterest::MaxContactRadius, "error of the contact radius"),
        panel(findings, "error of the stress field", LEAST, |line| line.judged.sure_stress_error),
    ];
    fem_figure::svg(&panels)
}

/// Returns the panel of an error over run time; the limit is uncertain by `known`.
fn panel(
    findings: &Findings<'_>,
    label: &str,
    known: f64,
    error: impl Fn(&Line<'_>) -> Option<f64>,
) -> Chart {
    let lines: Vec<Line<'_>> = findings.lines().collect();
    let point = |line: &Line<'_>| Some((line.seconds, error(line)?.max(LEAST)));
    let of = |series| -> Vec<(f64, f64)> {
        lines.iter().filter(|line| line.variant.series == series).filter_map(point).collect()
    };
    let axis = |label: &str| Axis::new(label).logarithmic();
    let mut chart = Chart::new(axis("time of a run [s]"), axis(label));
    for (k, series) in DRAWN.into_iter().enumerate() {
        let points = of(series);
        if !points.is_empty() {
            chart = chart.with(Curve::points_on_line(series.name(), points).like_curve(k));
        }
    }
    for (k, series) in [Series::Hertz, Series::Ting, Series::AsWritten].into_iter().enumerate() {
        let points = of(series);
        if !points.is_empty() {
            // In the last colour, with markers that no line has.
            let like = (k + 2) * COLOURS.len() - 1;
            chart = chart.with(Curve::points(series.name(), points).like_curve(like));
        }
    }
    let seconds = lines.iter().map(|line| line.seconds);
    let (from, to) =
        seconds.fold((f64::INFINITY, 0.0), |(from, to): (f64, f64), s| (from.min(s), to.max(s)));
    if known > LEAST && from < to {
        let limit = vec![(from, known), (to, known)];
        chart = chart.with(Curve::dashed("uncertainty of the limit", limit).coloured(GREY));
    }
    let choices = lines.iter().filter(|line| line.variant.series.is_choice());
    let mut frontier: Vec<(f64, f64)> = choices.filter_map(point).collect();
    frontier.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut nearest = f64::INFINITY;
    frontier.retain(|(_, error)| {
        // Errors below the uncertainty of the limit are chance.
        let is_nearer = *error < nearest && nearest > known;
        nearest = nearest.min(*error);
        is_nearer
    });
    chart.with(Curve::dashed("frontier", frontier).like_curve(2 * DRAWN.len() - 1))
}
