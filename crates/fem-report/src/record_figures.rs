//! Figures of measured records: the record with what was picked, the restitutions, and residuals.

use fem::records::{
    BounceTimes, FlightSpan, ForceRecord, Impact, Pulse, Record, Rig, Sound, Track,
};
use fem_case::engineering::show;
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY};

use crate::quantity_axis::{DECADE, fitting_axis, quantity_axis};

/// Most points of a drawn record.
const MOST_POINTS: usize = 1500;
/// Most pulses that are drawn one over the other.
const MOST_PULSES: usize = 5;
/// Points of a drawn flight.
const FLIGHT_POINTS: usize = 24;

/// Returns `measure.svg`: the record with what was picked, the restitutions, and residuals.
pub fn record_figure(record: &Record, rig: &Rig) -> String {
    let charts = match record {
        Record::BounceTimes(bounces) => bounce_charts(bounces, rig),
        Record::Track(track) => track_charts(track),
        Record::Force(force) => force_charts(force),
        Record::Sound(sound) => sound_charts(sound, rig),
    };
    fem_figure::svg(&charts).unwrap_or_default()
}

/// Restitution over approach speed, with error bars of two standard uncertainties.
fn restitution_chart(impacts: &[Impact]) -> Chart {
    let speeds = impacts.iter().map(|impact| impact.speed.value);
    let x = fitting_axis("approach speed", "m/s", speeds, DECADE);
    let points = impacts.iter().map(|it| (it.speed.value, it.restitution.value));
    let bars = impacts.iter().map(|it| 2.0 * it.restitution.uncertainty);
    let curve = Curve::points("restitution ± 2 u", points.collect()).with_errors(bars.collect());
    Chart::new(x, Axis::new("restitution e")).with(curve.like_curve(0))
}

/// Adds points with a name like the k-th curve, if there are any.
fn with_marks(chart: Chart, name: &str, points: Vec<(f64, f64)>, k: usize) -> Chart {
    if points.is_empty() { chart } else { chart.with(Curve::points(name, points).like_curve(k)) }
}

fn bounce_charts(bounces: &BounceTimes, rig: &Rig) -> Vec<Chart> {
    let instants = &bounces.instants.values;
    let gravity = rig.gravity().value;
    let end = instants.last().copied().unwrap_or(1.0);
    let time = quantity_axis("time", "s", end);
    let lasts = |span: &FlightSpan| instants[span.to] - instants[span.from];
    let longest = bounces.spans.iter().map(lasts).fold(0.0, f64::max);
    let height = quantity_axis("height by flight time", "m", gravity * longest.powi(2) / 8.0);
    let mut record = Chart::new(time.clone(), height);
    for span in &bounces.spans {
        let (start, duration) = (instants[span.from], lasts(span));
        let point = |k: usize| {
            let s = duration * k as f64 / FLIGHT_POINTS as f64;
            (start + s, 0.5 * gravity * s * (duration - s))
        };
        let points = (0..=FLIGHT_POINTS).map(point).collect();
        record = record.with(match span.n_flights {
            1 => Curve::line("flight", points).coloured(COLOURS[0]),
            _ => Curve::dashed("an instant is missing", points).coloured(GREY),
        });
    }
    let picked = |used: bool| -> Vec<(f64, f64)> {
        let is_used = |k: &usize| bounces.spans.iter().any(|span| [span.from, span.to].contains(k));
        let all = (0..instants.len()).filter(|k| is_used(k) == used);
        all.map(|k| (instants[k], 0.0)).collect()
    };
    record = with_marks(record, "bounce", picked(true), 1);
    record = with_marks(record, "left out", picked(false), 3);
    let mut charts = vec![record, restitution_chart(&bounces.impacts)];
    if let Some(scatter) = &bounces.scatter {
        let largest =
            scatter.residuals.iter().flatten().fold(0.0f64, |most, it| most.max(it.abs()));
        let residual = quantity_axis("residual of flight time", "s", largest);
        let points =
            bounces.spans.iter().zip(&scatter.residuals).filter_map(|(span, residual_s)| {
                Some((0.5 * (instants[span.from] + instants[span.to]), (*residual_s)?))
            });
        let points = Curve::points("residual", points.collect()).like_curve(2);
        let zero = Curve::dashed("", vec![(instants[0], 0.0), (end, 0.0)]).coloured(GREY);
        charts.push(Chart::new(time, residual).with(zero).with(points));
    }
    charts
}

/// Returns about [`MOST_POINTS`] indices of a list with n entries: all, or in each of equal parts those of the smallest and the
/// largest value.
fn thinned(values: &[f64]) -> Vec<usize> {
    let n = values.len();
    if n <= MOST_POINTS {
        return (0..n).collect();
    }
    let size = n.div_ceil(MOST_POINTS / 2);
    let mut kept = Vec::new();
    for start in (0..n).step_by(size) {
        let part = start..(start + size).min(n);
        let by = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let ends = [part.clone().min_by(by), part.max_by(by)];
        let mut ends: Vec<usize> = ends.into_iter().flatten().collect();
        ends.sort_unstable();
        ends.dedup();
        kept.extend(ends);
    }
    kept
}

fn track_charts(track: &Track) -> Vec<Chart> {
    let frames = &track.frames;
    let (times, heights) = (&frames.times, &frames.heights);
    let start = times.first().copied().unwrap_or(0.0);
    let end = times.last().copied().unwrap_or(1.0);
    let time = quantity_axis("time", "s", end.abs().max(start.abs()));
    let largest = heights.iter().fold(0.0f64, |most, y| most.max(y.abs()));
    let height = quantity_axis("height", "m", largest);
    let points = thinned(heights).into_iter().map(|k| (times[k], heights[k])).collect();
    let frames = Curve::points("frame", points).coloured(GREY);
    let mut record = Chart::new(time.clone(), height).with(frames);
    let mut deviations = Vec::new();
    for flight in &track.flights {
        let (Some(first), Some(last)) = (flight.frames.first(), flight.frames.last()) else {
            continue;
        };
        let point = |k: usize| {
            let share = k as f64 / FLIGHT_POINTS as f64;
            let t = times[*first] + share * (times[*last] - times[*first]);
            (t, track.height(flight, t))
        };
        let points = (0..=FLIGHT_POINTS).map(point).collect();
        record = record.with(Curve::line("parabola", points).coloured(COLOURS[0]));
        let off = |k: &usize| (times[*k], heights[*k] - track.height(flight, times[*k]));
        deviations.extend(flight.frames.iter().map(off));
    }
    let level = |impact: &Impact| {
        let near = times.partition_point(|t| *t < impact.time).min(heights.len() - 1);
        (impact.time, heights[near])
    };
    let picked = track.impacts.iter().map(level).collect();
    record = record.with(Curve::points("bounce", picked).like_curve(1));
    let residual = quantity_axis("residual of frame", "m", 3.0 * track.noise);
    let values: Vec<f64> = deviations.iter().map(|it| it.1).collect();
    let kept = thinned(&values).into_iter().map(|k| deviations[k]);
    let points = Curve::points("residual", kept.collect()).like_curve(2);
    vec![record, restitution_chart(&track.impacts), Chart::new(time, residual).with(points)]
}

fn force_charts(force: &ForceRecord) -> Vec<Chart> {
    let (times, forces) = (&force.samples.times, &force.samples.forces);
    let end = times.last().copied().unwrap_or(1.0);
    let time = quantity_axis("time", "s", end.abs().max(times[0].abs()));
    let largest = force.pulses.iter().map(|pulse| pulse.peak_force_n).fold(0.0, f64::max);
    let newton = quantity_axis("force", "N", largest);
    let points = thinned(forces).into_iter().map(|k| (times[k], forces[k])).collect();
    let peak = |clipped: bool| -> Vec<(f64, f64)> {
        let pulses = force.pulses.iter().filter(|pulse| pulse.is_clipped == clipped);
        let top = |pulse: &Pulse| {
            let middle = 0.5 * pulse.baseline[1] + pulse.baseline[0];
            (pulse.time_s, pulse.peak_force_n + middle)
        };
        pulses.map(top).collect()
    };
    let record = Chart::new(time, newton.clone()).with(Curve::line("", points).coloured(GREY));
    let record = with_marks(record, "pulse", peak(false), 1);
    let record = with_marks(record, "clipped", peak(true), 3);
    let longest = force.pulses.iter().take(MOST_PULSES).filter_map(Pulse::contact_time);
    let contact = quantity_axis("time since touch", "s", longest.fold(0.0, f64::max));
    let mut pulses = Chart::new(contact, newton);
    for (k, pulse) in force.pulses.iter().take(MOST_PULSES).enumerate() {
        let [first, last] = pulse.samples;
        let values: Vec<f64> = (first..=last)
            .map(|k| {
                let share = (times[k] - times[first]) / (times[last] - times[first]);
                forces[k] - pulse.baseline[0] - share * pulse.baseline[1]
            })
            .collect();
        let point = |k: usize| (times[first + k] - pulse.time_s, values[k]);
        let points = thinned(&values).into_iter().map(point).collect();
        let label = format!("less baseline, {}", show(pulse.time_s, "s"));
        pulses = pulses.with(Curve::points_on_line(label, points).like_curve(k + 4));
    }
    vec![record, restitution_chart(&force.impacts), pulses]
}

/// The signal with the picked onsets, and the charts of their bounces.
fn sound_charts(sound: &Sound, rig: &Rig) -> Vec<Chart> {
    let signal = &sound.signal;
    let end = signal.time(signal.values.len());
    let time = quantity_axis("time", "s", end.abs().max(signal.start.abs()));
    let point = |k: usize| (signal.time(k), signal.values[k]);
    let points = thinned(&signal.values).into_iter().map(point).collect();
    let chart = Chart::new(time, Axis::new("signal"));
    let picked = sound.bounces.instants.values.iter().map(|t| (*t, 0.0)).collect();
    let chart = chart.with(Curve::line("", points).coloured(GREY));
    let mut charts = vec![with_marks(chart, "bounce", picked, 1)];
    charts.extend(bounce_charts(&sound.bounces, rig));
    charts
}
