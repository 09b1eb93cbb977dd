//! `fit.svg`: data, curves and profile; `histories.svg`: what the fitted law does in time.

use fem::laws::{LawFit, LawRanking};
use fem_case::Scene;
use fem_case::engineering::{Unit, show};
use fem_figure::{Axis, COLOURS, Chart, Curve, GREY, Mark};
use fem_fit::{Fit, Model};
use fem_laws::laws::hertz;
use fem_laws::{Impact, LawError, LawImpact, ParameterRole};

use super::ranking::evidence;

/// Points of a curve.
const N: usize = 80;
/// Speeds of the overlaps that are drawn, in the speed that is asked for.
const RATIOS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];

/// e(v), of all laws of a ranking with their shares of the evidence, and the rms error over the profiled parameter.
pub fn fit_picture(fitted: &LawFit<'_>, ranking: Option<&LawRanking>) -> String {
    let points = fitted.problem.points;
    let (low, high) = fitted.data.speeds();
    let (low, high) = if low < high { (low, high) } else { (low / 2.0, high * 2.0) };
    let unit = Unit::fitting(high, "m/s");
    let curve = |model: &Model, fit: &Fit| -> Vec<(f64, f64)> {
        let speed = |k: usize| low * (high / low).powf(k as f64 / (N - 1) as f64);
        let point = |k| {
            let outcome = model.outcome(&fit.values, speed(k)).ok()?;
            Some((unit.scaled(speed(k)), outcome.restitution))
        };
        (0..N).filter_map(point).collect()
    };
    let model = fitted.problem.model;
    let share = |place: usize| -> String {
        let weight = ranking.and_then(|ranking| ranking.laws.get(place)?.weight);
        weight.map_or(String::new(), |weight| format!(", evidence {}", evidence(weight)))
    };
    let label = |place: usize, model: &Model, fit: &Fit| {
        let numbers = model.family().parameters().iter().zip(&fit.values);
        let exponent = numbers.filter(|(parameter, _)| parameter.key == "n");
        let exponent = exponent.map(|(_, n)| format!(", n = {n:.3}")).next();
        format!("{}{}{}", model.family().name(), exponent.unwrap_or_default(), share(place))
    };
    let speed_axis = Axis::new(format!("impact speed v [{}]", unit.symbol())).logarithmic();
    let mut chart = Chart::new(speed_axis, Axis::new("restitution e"))
        .with(Curve::line(label(0, model, &fitted.fit), curve(model, &fitted.fit)).like_curve(0));
    // The law and the data have the first two colours.
    for (k, (model, fit)) in fitted.compared.iter().enumerate() {
        let curve = Curve::dashed(label(k + 1, model, fit), curve(model, fit));
        chart = chart.with(curve.like_curve(k + 2));
    }
    let data = points.iter().map(|point| (unit.scaled(point.speed), point.restitution)).collect();
    let errors = points.iter().map(|point| point.restitution_uncertainty.unwrap_or(0.0)).collect();
    let mut charts =
        vec![chart.with(Curve::points("data", data).with_errors(errors).like_curve(1))];
    if let Some(profile) = &fitted.profile {
        let parameter = fitted.problem.parameter(profile.index);
        let points = profile.points.iter().map(|point| (point.value, point.rms)).collect();
        let best = vec![(fitted.fit.values[profile.index], fitted.fit.rms)];
        let unit = if parameter.unit.is_empty() { "" } else { &format!(" [{}]", parameter.unit) };
        let axis = Axis::new(format!("{}{unit}", parameter.key));
        let axis = if parameter.role == ParameterRole::Number { axis } else { axis.logarithmic() };
        charts.push(
            Chart::new(axis, Axis::new("rms error, the others fitted"))
                .with(Curve::line("", points).like_curve(0))
                .with(Curve::points("best fit", best).like_curve(3)),
        );
    }
    fem_figure::svg(&charts).unwrap_or_default()
}

/// Relative velocity and the first body's at one speed, elastic and with the law, and the overlap at
/// several speeds.
///
/// # Errors
/// Collisions that cannot be computed.
pub fn histories_picture(
    scene: &Scene,
    model: &Model,
    values: &[f64],
    speed: f64,
) -> Result<String, LawError> {
    let elastic = LawImpact::new(model.pair(), hertz(model.pair())?).impact(speed)?;
    let damped = model.impact(values, speed)?;
    let name = model.family().name();
    let time = Unit::fitting(elastic.contact_time.unwrap_or(1.0), "s");
    let rate = Unit::fitting(speed, "m/s");
    let series = |impact: &Impact, label: &str, colour, mark, y: &dyn Fn(f64) -> f64| {
        let instants = impact.history.iter();
        let points = instants.map(|now| (time.scaled(now.time), rate.scaled(y(now.approach_rate))));
        Curve::new(label, mark, points.collect()).coloured(colour)
    };
    // The first body moves with v at first and the second rests, as in the paper's figure.
    let share = scene.bodies()[0].material().map_or(0.0, |_| mass_share(scene));
    let first = |rate: f64| speed - share * (speed - rate);
    let both = |y: &dyn Fn(f64) -> f64| {
        [
            series(&elastic, "elastic", GREY, Mark::Dashed, y),
            series(&damped, name, COLOURS[0], Mark::Line, y),
        ]
    };
    let panel = |label: String, curves: [Curve; 2]| {
        let chart = Chart::new(time_axis(&time), Axis::new(label));
        curves.into_iter().fold(chart, Chart::with)
    };
    let first_name = &scene.bodies()[0].name();
    let overlaps = overlaps(model, values, speed, &time)?;
    let charts = [
        panel(format!("approach rate [{}]", rate.symbol()), both(&|rate| rate)),
        panel(format!("velocity of {first_name} [{}]", rate.symbol()), both(&first)),
        overlaps,
    ];
    Ok(fem_figure::svg(&charts).unwrap_or_default())
}

/// m*/m₁: the share of a change of the relative velocity that the first body takes.
fn mass_share(scene: &Scene) -> f64 {
    let mass = |index: usize| {
        let body = &scene.bodies()[index];
        body.diameter().zip(body.material()).map_or(f64::INFINITY, |(diameter, material)| {
            fem_laws::sphere_mass(diameter, material.density())
        })
    };
    1.0 / (1.0 + mass(0) / mass(1))
}

fn overlaps(model: &Model, values: &[f64], speed: f64, time: &Unit) -> Result<Chart, LawError> {
    let impacts: Vec<(f64, Impact)> = RATIOS
        .iter()
        .map(|ratio| Ok((ratio * speed, model.impact(values, ratio * speed)?)))
        .collect::<Result<_, LawError>>()?;
    let deepest = impacts.iter().map(|(_, impact)| impact.max_approach).fold(0.0, f64::max);
    let length = Unit::fitting(deepest, "m");
    let curves = impacts.iter().zip(&COLOURS[2..]).map(|((speed, impact), colour)| {
        let instants = impact.history.iter();
        let points = instants.map(|now| (time.scaled(now.time), length.scaled(now.approach)));
        let label = format!("overlap at {}", show(*speed, "m/s"));
        Curve::line(label, points.collect()).coloured(*colour)
    });
    let label = format!("overlap [{}]", length.symbol());
    Ok(curves.fold(Chart::new(time_axis(time), Axis::new(label)), Chart::with))
}

fn time_axis(time: &Unit) -> Axis {
    Axis::new(format!("time [{}]", time.symbol()))
}
