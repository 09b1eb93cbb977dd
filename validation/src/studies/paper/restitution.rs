//! The restitution at 0.5 m/s for both readings of the bulk modulus and both decay rates of the paper.

use std::sync::Arc;

use fem::{Plan, ting_impact};
use fem_case::Case;
use fem_case::schema::TermTable;
use fem_figure::{Axis, Chart, Curve, GREY};
use serde::Deserialize;

use super::falls_through;
use crate::{ExplicitRun, Findings, Laboratory, Run, StudyError, studies::relaxing::with_term};

/// The two readings: run, label.
const READINGS: [(&str, &str); 2] = [("all", "constant ν"), ("shear", "elastic bulk")];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Restitution of the paper's elastic collision, which shows the numerical loss of its program.
    published_elastic: f64,
    /// Restitution of the paper's viscoelastic collision.
    published: f64,
    /// Restitution of the paper's experiment.
    measured: f64,
    /// Decay rates over which the readings are drawn, 1/s.
    rates: [f64; 2],
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.run_all(cases)?;
    let mut findings = Findings::new();
    let mut rows = Vec::new();
    for (name, run) in names.iter().zip(&runs) {
        let scene = run.case.scene();
        let pair = run.hertz.pair();
        let half_space = ting_impact(scene, pair, false)?.restitution;
        let finite = ting_impact(scene, pair, true)?.restitution;
        let with_loss = run.restitution * parameters.published_elastic;
        for (quantity, value) in [
            ("restitution", run.restitution),
            ("ting", half_space),
            ("ting_finite", finite),
            ("difference", (run.restitution - finite).abs()),
            ("with_published_loss", with_loss),
            ("ting_with_published_loss", half_space * parameters.published_elastic),
        ] {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        let numbers = [run.restitution, finite, half_space, with_loss].map(|e| format!("{e:.4}"));
        let [ours, finite, half_space, with_loss] = numbers;
        rows.push([reading(run), rate(run), ours, finite, half_space, with_loss]);
    }
    let header = [
        "relaxes",
        "decay rate [1/s]",
        "here",
        "Ting, finite spheres",
        "Ting",
        "here × the paper's elastic 0.994",
    ];
    findings.tabulate("Restitution at 0.5 m/s; the paper prints 0.92", header, rows);
    for (name, _) in READINGS {
        let case = laboratory.case(name)?;
        let rate = falls_through(parameters.published, (100.0, 1e5), |rate| {
            restitution_by_ting(&case, rate, false)
        })?;
        findings.measure(format!("{name}.rate_of_published"), rate);
    }
    draw(laboratory, &parameters, &runs, &mut findings)?;
    Ok(findings)
}

/// Describes the moduli that relax.
fn reading(run: &Run) -> String {
    use fem_case::schema::ActsOn;
    let relaxation = run.case.file().material.values().find_map(|m| m.relaxation.as_ref());
    match relaxation.and_then(|relaxation| relaxation.acts_on) {
        None => "nothing",
        Some(ActsOn::All) => "shear and bulk (constant ν)",
        Some(ActsOn::Shear) => "shear (elastic bulk)",
    }
    .into()
}

/// Formats the decay rate 1/τ of the first term.
fn rate(run: &Run) -> String {
    decay_rate(run).map_or(String::new(), |rate| format!("{rate:.1}"))
}

fn decay_rate(run: &Run) -> Option<f64> {
    let material = run.case.scene().bodies()[0].material()?;
    Some(material.relaxation()?.terms().first()?.relaxation_time.recip())
}

fn restitution_by_ting(case: &Case, rate: f64, finite_size: bool) -> Result<f64, StudyError> {
    let case = with_term(case, "glass", TermTable::with_decay_rate(1.0, rate))?;
    let hertz = Plan::of_case(&case)?.estimate.hertz;
    Ok(ting_impact(case.scene(), hertz.pair(), finite_size)?.restitution)
}

fn draw(
    laboratory: &Laboratory,
    parameters: &Parameters,
    runs: &[Arc<ExplicitRun>],
    findings: &mut Findings,
) -> Result<(), StudyError> {
    let [from, to] = parameters.rates;
    let rates = || (0..=24).map(move |k| from * (to / from).powf(f64::from(k) / 24.0));
    let mut chart =
        Chart::new(Axis::new("decay rate β [1/s]").logarithmic(), Axis::new("restitution"));
    for (k, (name, label)) in READINGS.into_iter().enumerate() {
        let case = laboratory.case(name)?;
        let point = |rate: f64| restitution_by_ting(&case, rate, true).map(|value| (rate, value));
        let curve = rates().map(point).collect::<Result<_, _>>()?;
        chart = chart.with(Curve::line(format!("Ting, {label}"), curve).like_curve(k));
        let same = runs.iter().filter(|run| reading(run).contains(label));
        let points = same.filter_map(|run| decay_rate(run).map(|rate| (rate, run.restitution)));
        let points = Curve::points(format!("finite elements, {label}"), points.collect());
        chart = chart.with(points.like_curve(k));
    }
    let level = |value: f64| vec![(from, value), (to, value)];
    chart = chart
        .with(Curve::dashed("the paper's 0.92", level(parameters.published)).coloured(GREY))
        .with(Curve::dashed("its experiment", level(parameters.measured)).coloured("#E69F00"));
    findings.draw(
        "restitution",
        "Restitution at 0.5 m/s against the decay rate of one Maxwell branch, for both readings of \
         the bulk modulus. The text's rate is 2708 1/s, that of Table 1 is 5967 1/s.",
        &[chart],
    );
    Ok(())
}
