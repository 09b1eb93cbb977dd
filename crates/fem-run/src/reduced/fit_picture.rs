//! `fit.svg`: data, curves and profile; `histories.svg`: what the fitted law does in time.

use fem_case::Scene;
use fem_fit::{Fit, Model, Role};
use fem_laws::laws::hertz;
use fem_laws::{Impact, LawError, LawImpact};

use super::fit_report::Fitted;
use crate::engineering::Unit;
use crate::plot::{COLOURS, Mark, Panel, Series, svg};

/// Points of a curve.
const N: usize = 80;
/// Speeds of the overlaps that are drawn, in the speed that is asked for.
const RATIOS: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
const ELASTIC_COLOUR: &str = "#333333";

/// e(v), and the rms error over the profiled parameter.
pub fn fit_picture(fitted: &Fitted<'_>) -> String {
    let points = fitted.problem.points;
    let speeds = || points.iter().map(|point| point.speed);
    let (low, high) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
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
    let label = |model: &Model, fit: &Fit| {
        let numbers = model.family().parameters().iter().zip(&fit.values);
        let exponent = numbers.filter(|(parameter, _)| parameter.key == "n");
        let exponent = exponent.map(|(_, n)| format!(", n = {n:.3}")).next();
        format!("{}{}", model.family().name(), exponent.unwrap_or_default())
    };
    let best =
        Series::new(label(model, fitted.fit), COLOURS[0], Mark::Line, curve(model, fitted.fit));
    let mut series = vec![best];
    for ((model, fit), colour) in fitted.compared.iter().zip(&COLOURS[2..]) {
        series.push(Series::new(label(model, fit), colour, Mark::Dashed, curve(model, fit)));
    }
    let data = points.iter().map(|point| (unit.scaled(point.speed), point.restitution)).collect();
    let errors = points.iter().filter_map(|point| point.restitution_uncertainty).collect();
    series.push(Series { errors, ..Series::new("data", COLOURS[1], Mark::Points, data) });
    let mut panels = vec![Panel {
        x_label: format!("approach speed [{}]", unit.symbol()),
        y_label: "restitution".to_string(),
        is_x_logarithmic: true,
        series,
    }];
    if let Some(profile) = fitted.profile {
        let parameter = fitted.problem.parameter(profile.index);
        let points = profile.points.iter().map(|point| (point.value, point.rms)).collect();
        let best = vec![(fitted.fit.values[profile.index], fitted.fit.rms)];
        let unit = if parameter.unit.is_empty() { "" } else { &format!(" [{}]", parameter.unit) };
        panels.push(Panel {
            x_label: format!("{}{unit}", parameter.key),
            y_label: "rms error, the others fitted".to_string(),
            is_x_logarithmic: parameter.role != Role::Number,
            series: vec![
                Series::new("", COLOURS[0], Mark::Line, points),
                Series::new("best fit", COLOURS[3], Mark::Points, best),
            ],
        });
    }
    svg(&panels)
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
        Series::new(label, colour, mark, points.collect())
    };
    // The first body moves with v at first and the second rests, as in the paper's figure.
    let share = scene.bodies[0].material().map_or(0.0, |_| mass_share(scene));
    let first = |rate: f64| speed - share * (speed - rate);
    let both = |y: &dyn Fn(f64) -> f64| {
        vec![
            series(&elastic, "elastic", ELASTIC_COLOUR, Mark::Dashed, y),
            series(&damped, name, COLOURS[0], Mark::Line, y),
        ]
    };
    let panel = |y_label: String, series| Panel {
        x_label: format!("time [{}]", time.symbol()),
        y_label,
        is_x_logarithmic: false,
        series,
    };
    let first_name = &scene.bodies[0].name;
    let overlaps = overlaps(model, values, speed, &time)?;
    Ok(svg(&[
        panel(format!("approach rate [{}]", rate.symbol()), both(&|rate| rate)),
        panel(format!("velocity of {first_name} [{}]", rate.symbol()), both(&first)),
        overlaps,
    ]))
}

/// m*/m₁: the share of a change of the relative velocity that the first body takes.
fn mass_share(scene: &Scene) -> f64 {
    let mass = |index: usize| {
        let body = &scene.bodies[index];
        body.diameter().zip(body.material()).map_or(f64::INFINITY, |(diameter, material)| {
            fem_laws::sphere_mass(diameter, material.density())
        })
    };
    1.0 / (1.0 + mass(0) / mass(1))
}

fn overlaps(model: &Model, values: &[f64], speed: f64, time: &Unit) -> Result<Panel, LawError> {
    let impacts: Vec<(f64, Impact)> = RATIOS
        .iter()
        .map(|ratio| Ok((ratio * speed, model.impact(values, ratio * speed)?)))
        .collect::<Result<_, LawError>>()?;
    let deepest = impacts.iter().map(|(_, impact)| impact.max_approach).fold(0.0, f64::max);
    let length = Unit::fitting(deepest, "m");
    let series = impacts.iter().zip(&COLOURS[2..]).map(|((speed, impact), colour)| {
        let instants = impact.history.iter();
        let points = instants.map(|now| (time.scaled(now.time), length.scaled(now.approach)));
        let label = format!("overlap at {}", crate::engineering::show(*speed, "m/s"));
        Series::new(label, colour, Mark::Line, points.collect())
    });
    Ok(Panel {
        x_label: format!("time [{}]", time.symbol()),
        y_label: format!("overlap [{}]", length.symbol()),
        is_x_logarithmic: false,
        series: series.collect(),
    })
}
