//! `accuracy.svg`: errors over run time on logarithmic axes, and the best variant for each time.

use fem::accuracy::{Series, Study, VariantErrors, VariantRun};
use fem_collision::QuantityOfInterest;
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};

use super::AccuracyResult;
use crate::quantity_axis::range;

/// Smaller errors are drawn here; no limit is known better.
const MIN_DRAWN_ERROR: f64 = 1e-6;
/// Series that are drawn with a line, over the element size.
const LINES: [Series; 7] = [
    Series::Condensed,
    Series::CondensedVibrating,
    Series::Explicit,
    Series::ExplicitScaled,
    Series::ExplicitGrown,
    Series::Penalty,
    Series::NodeToSurface,
];
/// Series that are drawn as points.
const POINTS: [Series; 3] = [Series::Hertz, Series::Ting, Series::AsWritten];

/// Returns the figure; `None` without any variant.
pub fn figure(result: &AccuracyResult<'_>) -> Option<String> {
    let uncertainty = |quantity: QuantityOfInterest| {
        let limit = result.study.limits[quantity as usize]?;
        Some((limit.uncertainty / quantity.scale(limit.value)).max(MIN_DRAWN_ERROR))
    };
    let main = Study::MAIN_QUANTITIES.into_iter();
    let worst = main.filter_map(uncertainty).fold(MIN_DRAWN_ERROR, f64::max);
    let runs = &result.study.runs;
    let of = |quantity: QuantityOfInterest, label: &str| {
        let known = uncertainty(quantity).unwrap_or(MIN_DRAWN_ERROR);
        panel(runs, label, known, |errors| errors.monotone[quantity as usize])
    };
    fem_figure::svg(&[
        panel(runs, "worst error of e, T and F", worst, |errors| errors.worst),
        of(QuantityOfInterest::PeakPressure, "error of the peak pressure"),
        of(QuantityOfInterest::MaxContactRadius, "error of the contact radius"),
        panel(runs, "error of the stress field", MIN_DRAWN_ERROR, |errors| errors.monotone_stress),
    ])
}

/// Returns the panel of an error over run time; the limit is uncertain by `known`.
fn panel(
    runs: &[VariantRun<'_>],
    label: &str,
    known: f64,
    error: impl Fn(&VariantErrors) -> Option<f64>,
) -> Chart {
    let point =
        |run: &VariantRun<'_>| Some((run.seconds, error(&run.errors)?.max(MIN_DRAWN_ERROR)));
    let of = |series| -> Vec<(f64, f64)> {
        runs.iter().filter(|run| run.variant.series == series).filter_map(point).collect()
    };
    let axis = |label: &str| Axis::new(label).logarithmic();
    let lines = LINES
        .into_iter()
        .enumerate()
        .map(|(k, series)| Curve::points_on_line(series.name(), of(series)).like_curve(k));
    let points = POINTS.into_iter().enumerate().map(|(k, series)| {
        // Points have the last colour, and markers that no line has.
        Curve::points(series.name(), of(series)).like_curve((k + 2) * COLOURS.len() - 1)
    });
    let drawn = LINES.into_iter().chain(POINTS).map(|series| !of(series).is_empty());
    let curves = lines.chain(points).zip(drawn).filter(|(_, is_drawn)| *is_drawn);
    let chart = Chart::new(axis("time of a run [s]"), axis(label));
    let mut chart = curves.fold(chart, |chart, (curve, _)| chart.with(curve));
    let (from, to) = range(runs.iter().map(|run| run.seconds));
    if known > MIN_DRAWN_ERROR && from < to {
        let limit = vec![(from, known), (to, known)];
        chart = chart.with(Curve::dashed("uncertainty of the limit", limit).coloured(GREY));
    }
    let choices = runs.iter().filter(|run| run.variant.series.is_choice());
    let mut frontier: Vec<(f64, f64)> = choices.filter_map(point).collect();
    frontier.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut nearest = f64::INFINITY;
    frontier.retain(|(_, error)| {
        // Errors below the uncertainty of the limit are coincidence.
        let is_nearer = *error < nearest && nearest > known;
        nearest = nearest.min(*error);
        is_nearer
    });
    chart.with(Curve::dashed("frontier", frontier).like_curve(2 * LINES.len() - 1))
}
