//! `calibrate.svg`: restitutions with what a series can do, and the weights with their ranges.

use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};
use fem_fit::FitError;
use fem_material::PronyTerm;

use super::{Calibrated, Experiment};
use crate::engineering::Unit;

/// Points of a curve.
const N: usize = 33;
/// Space beside a single speed.
const BESIDE: f64 = 2.0;

/// Restitutions over speed (over the contact time where there are several pairs: in linear bodies
/// nothing else counts but for the small ratio of contact to sphere), and weights over relaxation
/// time.
///
/// # Errors
/// A collision that cannot be computed.
pub fn calibration_picture(found: &Calibrated<'_>) -> Result<String, FitError> {
    let charts = [restitution_chart(found)?, weight_chart(found)];
    Ok(fem_figure::svg(&charts).unwrap_or_default())
}

/// How a point is placed: its speed, or its contact time.
fn place(experiments: &[Experiment], experiment: &Experiment, speed: f64) -> f64 {
    match experiments {
        [_] => speed,
        _ => experiment.contact_times[0] * (speed / experiment.speeds[0]).powf(-0.2),
    }
}

fn restitution_chart(found: &Calibrated<'_>) -> Result<Chart, FitError> {
    let experiments = found.experiments;
    let is_one = experiments.len() == 1;
    let (symbol, name, power) =
        if is_one { ("m/s", "approach speed", 0.2) } else { ("s", "elastic contact time", 1.0) };
    let mut data = vec![(0.0, 0.0); found.measured.data.points.len()];
    for experiment in experiments {
        for (point, speed) in experiment.points.iter().zip(&experiment.speeds) {
            let restitution = found.measured.data.points[*point].restitution;
            data[*point] = (place(experiments, experiment, *speed), restitution);
        }
    }
    let (low, high) = super::ends(data.iter().map(|(x, _)| x));
    let (low, high) = if low < high { (low, high) } else { (low / BESIDE, high * BESIDE) };
    let unit = Unit::fitting(high, symbol);
    let grid = |k: usize| low * (high / low).powf(k as f64 / (N - 1) as f64);
    let mut samples: Vec<(f64, &Experiment, f64)> = match experiments {
        [only] => (0..N).map(|k| (grid(k), only, grid(k))).collect(),
        several => several
            .iter()
            .flat_map(|one| one.speeds.iter().map(move |v| (one, *v)))
            .map(|(one, speed)| (place(several, one, speed), one, speed))
            .collect(),
    };
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let curve = |terms: &[PronyTerm]| -> Result<Vec<(f64, f64)>, FitError> {
        let point = |(x, experiment, speed): &(f64, &Experiment, f64)| {
            Ok((unit.scaled(*x), experiment.restitution(terms, *speed)?))
        };
        samples.iter().map(point).collect()
    };
    let best = curve(&found.terms())?;
    let (middle, level) = best[best.len() / 2];
    let limit = |sign: f64| -> Vec<(f64, f64)> {
        let at = |x: f64| 1.0 - (1.0 - level) * (x / middle).powf(sign * power);
        best.iter().map(|(x, _)| (*x, at(*x).max(0.0))).collect()
    };
    let band = limit(1.0).into_iter().zip(limit(-1.0)).map(|((x, a), (_, b))| (x, a, b));
    let points = data.iter().map(|(x, e)| (unit.scaled(*x), *e)).collect();
    let errors = found.measured.data.points.iter();
    let errors = errors.filter_map(|point| point.restitution_uncertainty).collect();
    let axis = Axis::new(format!("{name} [{}]", unit.symbol())).logarithmic();
    Ok(Chart::new(axis, Axis::new("restitution"))
        .with_band("slopes of any Prony series", band.collect(), GREY)
        .with(Curve::dashed("single Maxwell term", curve(&[found.maxwell.term()])?).like_curve(2))
        .with(Curve::line("best fit", best).like_curve(0))
        .with(Curve::points("data", points).with_errors(errors).like_curve(1)))
}

fn weight_chart(found: &Calibrated<'_>) -> Chart {
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
