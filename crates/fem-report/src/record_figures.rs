//! Figures of measured records: the record with what was picked, the restitutions, and residuals.

use fem::records::{BounceTimes, FlightSpan, Impact, Record, Rig};
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};

use crate::quantity_axis::{QuantityAxis, chart_axes};

/// Points of a drawn flight.
const FLIGHT_POINTS: usize = 24;

/// Returns `measure.svg`: the record with what was picked, the restitutions, and residuals.
pub fn record_figure(record: &Record, rig: &Rig) -> String {
    let charts = match record {
        Record::BounceTimes(bounces) => bounce_charts(bounces, rig),
    };
    fem_figure::svg(&charts).unwrap_or_default()
}

/// Restitution over approach speed, with error bars of two standard uncertainties.
fn restitution_chart(impacts: &[Impact]) -> Chart {
    let speeds = impacts.iter().map(|impact| impact.speed.value);
    let x = QuantityAxis::fitting("approach speed", "m/s", speeds);
    let points = impacts.iter().map(|it| (x.scaled(it.speed.value), it.restitution.value));
    let bars = impacts.iter().map(|it| 2.0 * it.restitution.uncertainty);
    let curve = Curve::points("restitution ± 2 u", points.collect()).with_errors(bars.collect());
    Chart::new(x.axis(), Axis::new("restitution e")).with(curve.like_curve(0))
}

fn bounce_charts(bounces: &BounceTimes, rig: &Rig) -> Vec<Chart> {
    let instants = &bounces.instants.values;
    let gravity = rig.gravity().value;
    let end = instants.last().copied().unwrap_or(1.0);
    let time = QuantityAxis::linear("time", "s", end);
    let lasts = |span: &FlightSpan| instants[span.to] - instants[span.from];
    let longest = bounces.spans.iter().map(lasts).fold(0.0, f64::max);
    let height =
        QuantityAxis::linear("height by flight time", "m", gravity * longest.powi(2) / 8.0);
    let mut record = chart_axes(&time, &height);
    for span in &bounces.spans {
        let (start, duration) = (instants[span.from], lasts(span));
        let (label, colour) = match span.n_flights {
            1 => ("flight", COLOURS[0]),
            _ => ("an instant is missing", GREY),
        };
        let point = |k: usize| {
            let s = duration * k as f64 / FLIGHT_POINTS as f64;
            let high = 0.5 * gravity * s * (duration - s);
            (time.scaled(start + s), height.scaled(high))
        };
        let points = (0..=FLIGHT_POINTS).map(point).collect();
        record = match span.n_flights {
            1 => record.with(Curve::line(label, points).coloured(colour)),
            _ => record.with(Curve::dashed(label, points).coloured(colour)),
        };
    }
    let picked = |used: bool| -> Vec<(f64, f64)> {
        let is_used = |k: &usize| bounces.spans.iter().any(|span| [span.from, span.to].contains(k));
        let all = (0..instants.len()).filter(|k| is_used(k) == used);
        all.map(|k| (time.scaled(instants[k]), 0.0)).collect()
    };
    record = record
        .with(Curve::points("bounce", picked(true)).like_curve(1))
        .with(Curve::points("left out", picked(false)).like_curve(3));
    let mut charts = vec![record, restitution_chart(&bounces.impacts)];
    if let Some(scatter) = &bounces.scatter {
        let largest =
            scatter.residuals.iter().flatten().fold(0.0f64, |most, it| most.max(it.abs()));
        let residual = QuantityAxis::linear("flight time less a smooth series", "s", largest);
        let points =
            bounces.spans.iter().zip(&scatter.residuals).filter_map(|(span, residual_s)| {
                let middle = 0.5 * (instants[span.from] + instants[span.to]);
                Some((time.scaled(middle), residual.scaled((*residual_s)?)))
            });
        let points = Curve::points("residual", points.collect()).like_curve(2);
        let zero = vec![(time.scaled(instants[0]), 0.0), (time.scaled(end), 0.0)];
        let zero = Curve::dashed("", zero).coloured(GREY);
        charts.push(chart_axes(&time, &residual).with(zero).with(points));
    }
    charts
}
