//! `calibrate.svg`: restitutions with what a series can do, and the weights with their ranges.

use fem::calibrate::{Abscissa, Calibration};
use fem_case::engineering::Unit;
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};
use fem_fit::FitError;

/// Restitutions over speed or contact time, and weights over relaxation time.
///
/// # Errors
/// A collision that cannot be computed.
pub fn calibration_picture(found: &Calibration) -> Result<String, FitError> {
    let charts = [restitution_chart(found)?, weight_chart(found)];
    Ok(fem_figure::svg(&charts).unwrap_or_default())
}

fn restitution_chart(found: &Calibration) -> Result<Chart, FitError> {
    let curves = found.curves()?;
    let (symbol, name) = match curves.over {
        Abscissa::Speed => ("m/s", "approach speed"),
        Abscissa::ContactTime => ("s", "elastic contact time"),
    };
    let unit = Unit::fitting(curves.range.1, symbol);
    let scaled = |curve: Vec<(f64, f64)>| -> Vec<(f64, f64)> {
        curve.into_iter().map(|(x, e)| (unit.scaled(x), e)).collect()
    };
    let (best, power) = (scaled(curves.best), curves.over.steepest_loss());
    let (middle, level) = best[best.len() / 2];
    let limit =
        |x: f64, sign: f64| (1.0 - (1.0 - level) * (x / middle).powf(sign * power)).max(0.0);
    let band = best.iter().map(|&(x, _)| (x, limit(x, 1.0), limit(x, -1.0))).collect();
    let errors = found.measured.data.points.iter();
    let errors = errors.map(|point| point.restitution_uncertainty.unwrap_or(0.0)).collect();
    let axis = Axis::new(format!("{name} [{}]", unit.symbol())).logarithmic();
    Ok(Chart::new(axis, Axis::new("restitution"))
        .with_band("slopes of any Prony series", band, GREY)
        .with(Curve::dashed("single Maxwell term", scaled(curves.maxwell)).like_curve(2))
        .with(Curve::line("best fit", best).like_curve(0))
        .with(Curve::points("data", scaled(curves.data)).with_errors(errors).like_curve(1)))
}

fn weight_chart(found: &Calibration) -> Chart {
    let unit = Unit::fitting(found.contact_times().1, "s");
    let axis = Axis::new(format!("relaxation time [{}]", unit.symbol())).logarithmic();
    let mut chart = Chart::new(axis, Axis::new("weight").from_to(0.0, 1.0));
    let (first, last) = found.contact_times();
    for time in [first, last] {
        let line = vec![(unit.scaled(time), 0.0), (unit.scaled(time), 1.0)];
        chart = chart.with(Curve::dashed("contact times of the data", line).coloured(GREY));
    }
    let label = format!("{} % range, all others free", 100.0 * found.confidence);
    for (time, range) in found.times.iter().zip(&found.fit.weight_ranges) {
        let x = unit.scaled(*time);
        let line = vec![(x, range.low), (x, range.high)];
        chart = chart.with(Curve::line(label.clone(), line).coloured(COLOURS[3]));
    }
    let weights = found.times.iter().zip(&found.fit.weights);
    let weights = weights.map(|(time, weight)| (unit.scaled(*time), *weight)).collect();
    chart.with(Curve::points("weight found", weights).like_curve(0))
}
