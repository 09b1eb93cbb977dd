//! Figures of fits, calibrations, exports and cradle experiments.

use fem::calibrate::{Abscissa, Calibration};
use fem::fit::cradle::{Swing, Trial};
use fem::fit::{Fit, FitError, Model};
use fem::laws::{DemExport, FittedLaw, LawExport, LawFit, LawRanking};
use fem_case::Scene;
use fem_case::engineering::number;
use fem_case::engineering::show;
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY, Mark};
use fem_laws::laws::hertz;
use fem_laws::{Impact, LawError, LawFamily, LawImpact, ParameterRole};

use crate::quantity_axis::{DECADE, fitting_axis, quantity_axis};

/// Speeds of the overlap curves over the given speed.
const SPEED_RATIOS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];

/// Most laws of a ranking that a figure or a short text shows, the best ones.
pub const MAX_RANKED: usize = 3;

/// Returns a share of the evidence in percent.
pub fn evidence(weight: f64) -> String {
    format!("{:.1} %", 100.0 * weight)
}

/// Returns the name of a law for readers: `Kuwabara–Kono` for kuwabara_kono.
fn title(family: LawFamily) -> String {
    let capitalised = |word: &str| {
        let (first, rest) = word.split_at_checked(1).unwrap_or((word, ""));
        first.to_uppercase() + rest
    };
    let names: Vec<String> = family.name().split('_').map(capitalised).collect();
    names.join("–")
}

/// Returns `fit.svg`: restitution over speed for the fitted law, for those that it is compared with and for
/// the data, and the rms error over the profiled parameter. The best laws of a ranking are labelled with their
/// evidence.
pub fn fit_figure(fitted: &LawFit<'_>, ranking: Option<&LawRanking>) -> String {
    let data = fitted.problem.points;
    let speeds = fitted.curve_speeds();
    let high = speeds.last().copied().unwrap_or(1.0);
    let x = quantity_axis("approach speed", "m/s", high).logarithmic();
    let curve = |model: &Model, fit: &Fit| -> Vec<(f64, f64)> {
        let restitutions = LawFit::curve((model, fit), &speeds);
        speeds.iter().zip(restitutions).filter_map(|(&speed, e)| Some((speed, e?))).collect()
    };
    let model = fitted.problem.model;
    let share = |rank: usize| -> String {
        let weight = ranking.and_then(|ranking| ranking.laws.get(rank)?.weight);
        weight.map_or(String::new(), |weight| format!(", evidence {}", evidence(weight)))
    };
    let label = |rank: usize, model: &Model, fit: &Fit| {
        let numbers = model.family().parameters().iter().zip(&fit.values);
        let exponent = numbers.filter(|(parameter, _)| parameter.key == "n");
        let exponent = exponent.map(|(_, n)| format!(", n = {n:.3}")).next();
        format!("{}{}{}", title(model.family()), exponent.unwrap_or_default(), share(rank))
    };
    let band = speeds.iter().zip(fitted.band(&speeds));
    let band: Vec<(f64, f64, f64)> =
        band.filter_map(|(&speed, ends)| ends.map(|(a, b)| (speed, a, b))).collect();
    let mut chart = Chart::new(x, Axis::new("restitution e"));
    if !band.is_empty() {
        let label = format!("{} % band of the fit", number(100.0 * fitted.confidence, 3));
        chart = chart.with_band(label, band, GREY);
    }
    let mut chart = chart
        .with(Curve::line(label(0, model, &fitted.fit), curve(model, &fitted.fit)).like_curve(0));
    let n_ranked = ranking.map_or(0, |ranking| ranking.laws.len());
    let ranks = (1..=fitted.compared.len()).zip(&fitted.compared);
    let drawn = ranks.filter(|(rank, _)| !(MAX_RANKED..n_ranked).contains(rank));
    // The fitted law and the data have the first two colours.
    for (rank, (model, fit)) in drawn {
        let curve = Curve::dashed(label(rank, model, fit), curve(model, fit));
        chart = chart.with(curve.like_curve(rank + 1));
    }
    let points = data.iter().map(|point| (point.speed, point.restitution)).collect();
    let errors = data.iter().map(|point| point.restitution_uncertainty.unwrap_or(0.0)).collect();
    let mut charts =
        vec![chart.with(Curve::points("data", points).with_errors(errors).like_curve(1))];
    if let Some(profile) = &fitted.profile {
        let parameter = fitted.problem.parameter(profile.index);
        let points = profile.points.iter().map(|point| (point.value, point.rms)).collect();
        let best = vec![(fitted.fit.values[profile.index], fitted.fit.rms)];
        let unit = if parameter.unit.is_empty() { "" } else { &format!(" [{}]", parameter.unit) };
        let words = match (parameter.role, parameter.key) {
            (ParameterRole::Damping, _) => "damping",
            (ParameterRole::Stiffness, _) => "stiffness",
            (ParameterRole::Strength, _) => "strength",
            (ParameterRole::Rate, _) => "rate",
            (ParameterRole::Speed, _) => "speed",
            (ParameterRole::Number, "n") => "exponent",
            (ParameterRole::Number, "e") => "restitution",
            (ParameterRole::Number, _) => "number",
        };
        let axis = Axis::new(format!("{words} {}{unit}", parameter.key));
        let axis = if parameter.role == ParameterRole::Number { axis } else { axis.logarithmic() };
        charts.push(
            Chart::new(axis, Axis::new("rms error of e, others refitted"))
                .with(Curve::line("", points).like_curve(0))
                .with(Curve::points("best fit", best).like_curve(3)),
        );
    }
    fem_figure::svg(&charts).unwrap_or_default()
}

/// Returns `histories.svg`: approach rate and, if both bodies can move, velocity of the striking one over time at one speed
/// (m/s), elastic and with the law, and the overlap at several speeds.
pub fn histories_figure(
    scene: &Scene,
    model: &Model,
    values: &[f64],
    speed: f64,
) -> Result<String, LawError> {
    let elastic = LawImpact::new(model.pair(), hertz(model.pair())?).impact(speed)?;
    let damped = model.impact(values, speed)?;
    let name = &title(model.family());
    let time = quantity_axis("time", "s", elastic.contact_time.unwrap_or(1.0));
    let series = |impact: &Impact, label: &str, colour, mark, y: &dyn Fn(f64) -> f64| {
        let points = impact.history.iter().map(|now| (now.time, y(now.approach_rate)));
        Curve::new(label, mark, points.collect()).coloured(colour)
    };
    // At first touch the striking body moves with v and the other one rests, as in the paper's figure.
    let striking = scene.bodies().iter().position(|body| body.velocity() != 0.0).unwrap_or(0);
    let share = scene.bodies()[striking].material().map_or(0.0, |_| mass_share(scene, striking));
    let own = |rate: f64| speed - share * (speed - rate);
    let panel = |label: &str, y: &dyn Fn(f64) -> f64| {
        Chart::new(time.clone(), quantity_axis(label, "m/s", speed))
            .with(series(&elastic, "elastic", GREY, Mark::Dashed, y))
            .with(series(&damped, name, COLOURS[0], Mark::Line, y))
    };
    let at = show(speed, "m/s");
    let mut charts = vec![panel(&format!("approach rate at {at}"), &|rate| rate)];
    // Beside an immovable body the other one has the approach rate.
    if share > 0.0 && share < 1.0 {
        let name = scene.bodies()[striking].name();
        charts.push(panel(&format!("velocity of {name} at {at}"), &own));
    }
    charts.push(overlap_chart(model, values, speed, time.clone())?);
    Ok(fem_figure::svg(&charts).unwrap_or_default())
}

/// Returns m*/m_k, the share of a change of the relative velocity that the body of this index takes.
fn mass_share(scene: &Scene, k: usize) -> f64 {
    let mass = |index: usize| scene.bodies()[index].mass().unwrap_or(f64::INFINITY);
    1.0 / (1.0 + mass(k) / mass(1 - k))
}

fn overlap_chart(model: &Model, values: &[f64], speed: f64, time: Axis) -> Result<Chart, LawError> {
    let impacts: Vec<(f64, Impact)> = SPEED_RATIOS
        .iter()
        .map(|ratio| Ok((ratio * speed, model.impact(values, ratio * speed)?)))
        .collect::<Result<_, LawError>>()?;
    let deepest = impacts.iter().map(|(_, impact)| impact.max_approach).fold(0.0, f64::max);
    let overlap = quantity_axis("overlap", "m", deepest);
    let curves = impacts.iter().zip(&COLOURS[2..]).map(|((speed, impact), colour)| {
        let points = impact.history.iter().map(|now| (now.time, now.approach));
        let label = format!("overlap at {}", show(*speed, "m/s"));
        Curve::line(label, points.collect()).coloured(*colour)
    });
    Ok(curves.fold(Chart::new(time, overlap), Chart::with))
}

/// Intervals of a drawn curve of e or T over speed.
const N_DRAWN: usize = 60;

/// Returns `export.svg`: restitution and contact time over speed, of the data and of the laws.
pub fn export_figure(fitted: &DemExport) -> String {
    let (curve, fastest) = (&fitted.curve, fitted.curve.speeds().1);
    let longest = curve.points.iter().filter_map(|point| point.contact_time).fold(0.0, f64::max);
    let speed = quantity_axis("approach speed", "m/s", fastest).logarithmic();
    let slowest = curve.speeds().0;
    let step = (fastest / slowest).powf(1.0 / N_DRAWN as f64);
    let drawn = || (0..=N_DRAWN).map(|k| slowest * step.powi(k as i32));
    let panel = |y: Axis,
                 (is_measured, data): (bool, Vec<(f64, f64)>),
                 of_law: &dyn Fn(&FittedLaw, f64) -> Option<f64>| {
        // The linear law covers the other law with a constant restitution.
        let mark = |law: &FittedLaw| match law.model.family() {
            LawFamily::Linear => Mark::Dashed,
            _ => Mark::Line,
        };
        let law = |(law, colour): (&FittedLaw, &'static str)| {
            let points = drawn().filter_map(|speed| Some((speed, of_law(law, speed)?)));
            Curve::new(law.name(), mark(law), points.collect()).coloured(colour)
        };
        let colours = [0, 2, 3, 4, 5, 6].map(|k| COLOURS[k]);
        let laws = fitted.laws.iter().zip(colours).map(law);
        let (name, k) = match (is_measured, curve.law) {
            (true, None) => ("data", 1),
            (true, Some(law)) => (law.name(), 1),
            (false, _) => ("Hertz, in place of data", 6),
        };
        let chart = laws.fold(Chart::new(speed.clone(), y), Chart::with);
        chart.with(Curve::points(name, data).like_curve(k))
    };
    let points = || curve.points.iter();
    let e_data = points().map(|point| (point.speed, point.restitution)).collect();
    let t_data = points().filter_map(|point| Some((point.speed, point.contact_time?))).collect();
    let charts = [
        panel(Axis::new("restitution e"), (true, e_data), &|law, speed| {
            law.outcome(speed).map(|outcome| outcome.restitution)
        }),
        panel(
            quantity_axis("contact time T", "s", longest),
            (!curve.has_hertz_times, t_data),
            &|law, speed| law.outcome(speed)?.contact_time,
        ),
    ];
    fem_figure::svg(&charts).unwrap_or_default()
}

/// Smallest error of e that a figure shows.
const LEAST_ERROR: f64 = 1e-5;

/// Returns `export.svg` of a law to compile: restitution over speed of its model, of the law, and of laws that codes have, and the errors.
pub fn compiled_law_figure(export: &LawExport, own: &[FittedLaw]) -> String {
    let model = || export.law.curve.iter().map(|[speed, e, _]| (*speed, *e));
    let compiled = model().zip(&export.made).map(|((speed, _), e)| (speed, *e)).collect();
    let mut curves = vec![("the exported law", compiled)];
    // The linear law has the restitution of the other one with a constant e.
    curves.extend(own.iter().filter(|law| law.model.family() != LawFamily::Linear).map(|law| {
        let made =
            |(speed, _)| (speed, law.outcome(speed).map_or(f64::NAN, |made| made.restitution));
        (law.name(), model().map(made).collect::<Vec<_>>())
    }));
    let speed = quantity_axis("approach speed", "m/s", export.speeds()[1]).logarithmic();
    let restitutions = Chart::new(speed.clone(), Axis::new("restitution e"));
    let errors = Chart::new(speed, Axis::new("error of e").logarithmic());
    let mut charts = [restitutions, errors];
    for ((name, points), k) in curves.into_iter().zip([0, 2, 3, 4, 5, 6]) {
        let error = |((speed, made), (_, e)): (&(f64, f64), (f64, f64))| {
            (*speed, (made - e).abs().max(LEAST_ERROR))
        };
        let of_error = points.iter().zip(model()).map(error).collect();
        let [left, right] = charts;
        charts = [
            left.with(Curve::line(name, points).like_curve(k)),
            right.with(Curve::line(name, of_error).like_curve(k)),
        ];
    }
    let [left, right] = charts;
    let left = left.with(Curve::points(export.model.clone(), model().collect()).like_curve(1));
    fem_figure::svg(&[left, right]).unwrap_or_default()
}

/// Returns `cradle.svg`: the restitution of each trial over its approach speed.
pub fn cradle_figure(swings: &[(Trial, Swing)]) -> String {
    let points = swings.iter().map(|(_, swing)| (swing.before.value, swing.restitution.value));
    let has_errors = swings.iter().all(|(_, swing)| swing.restitution.uncertainty > 0.0);
    let errors = swings.iter().filter(|_| has_errors);
    let errors = errors.map(|(_, swing)| swing.restitution.uncertainty).collect();
    let trials = Curve::points("trials", points.collect()).with_errors(errors);
    let chart = Chart::new(Axis::new("approach speed [m/s]"), Axis::new("restitution"));
    fem_figure::svg(&[chart.with(trials)]).unwrap_or_default()
}

/// Returns `calibrate.svg`: restitution over speed or contact time, and the weights with their ranges over
/// relaxation time.
pub fn calibration_figure(found: &Calibration) -> Result<String, FitError> {
    let charts = [restitution_chart(found)?, weight_chart(found)];
    Ok(fem_figure::svg(&charts).unwrap_or_default())
}

fn restitution_chart(found: &Calibration) -> Result<Chart, FitError> {
    let curves = found.curves()?;
    let (symbol, name) = match curves.over {
        Abscissa::Speed => ("m/s", "approach speed"),
        Abscissa::ContactTime => ("s", "elastic contact time"),
    };
    let x = quantity_axis(name, symbol, curves.range.1).logarithmic();
    let (best, power) = (curves.best, curves.over.steepest_loss());
    let (middle, level) = best[best.len() / 2];
    let limit =
        |x: f64, sign: f64| (1.0 - (1.0 - level) * (x / middle).powf(sign * power)).max(0.0);
    let band = best.iter().map(|&(x, _)| (x, limit(x, 1.0), limit(x, -1.0))).collect();
    let errors = found.measured.data.points.iter();
    let errors = errors.map(|point| point.restitution_uncertainty.unwrap_or(0.0)).collect();
    let mut chart = Chart::new(x, Axis::new("restitution e"));
    if let Some(prior) = curves.prior {
        chart = chart.with(Curve::dashed("measured relaxation alone", prior).like_curve(4));
    }
    Ok(chart
        .with_band("slopes of any Prony series", band, GREY)
        .with(Curve::dashed("single Maxwell term", curves.maxwell).like_curve(2))
        .with(Curve::line("best fit", best).like_curve(0))
        .with(Curve::points("data", curves.data).with_errors(errors).like_curve(1)))
}

fn weight_chart(found: &Calibration) -> Chart {
    let (first, last) = found.contact_times();
    let times = found.times.iter().copied().chain([first, last]);
    let x = fitting_axis("relaxation time", "s", times, DECADE).logarithmic();
    let mut chart = Chart::new(x, Axis::new("weight g").from_to(0.0, 1.0));
    for time in [first, last] {
        let line = vec![(time, 0.0), (time, 1.0)];
        chart = chart.with(Curve::dashed("contact times of the data", line).coloured(GREY));
    }
    let label = format!("{} % range, all others free", 100.0 * found.confidence);
    for (k, time) in found.times.iter().enumerate() {
        let range = found.weight_range(k);
        let line = vec![(*time, range.low), (*time, range.high)];
        chart = chart.with(Curve::line(label.clone(), line).coloured(COLOURS[3]));
    }
    if let Some(parts) = &found.fit.parts {
        let points = found.times.iter().zip(&parts.weights);
        let points = points.map(|(time, weight)| (*time, weight.value)).collect();
        let errors = parts.weights.iter().map(|weight| weight.error).collect();
        let prior = Curve::points("measured relaxation", points).with_errors(errors);
        chart = chart.with(prior.like_curve(4));
    }
    let weights = found.times.iter().copied().zip(found.fit.weights.iter().copied()).collect();
    chart.with(Curve::points("weight found", weights).like_curve(0))
}
