//! Fig. 5: a spring in series with a Kelvin element is one Prony term of weight below 1.
//!
//! The dashpot and the series spring stay the same. The stiffness of the spring parallel to the dashpot grows, from
//! Maxwell's fluid, which the paper's finite elements use, to stiffer solids.

use fem::{Plan, ting_impact};
use fem_case::Case;
use fem_case::schema::TermTable;
use fem_figure::{Axis, Chart, Curve};
use fem_material::{ActsOn, PronySeries};
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError, studies::relaxing::with_term};

/// Steps of the integration of springs and dashpot, over three relaxation times.
const N_STEPS: u32 = 600;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Stiffness k₁ of the series spring, the instantaneous shear modulus, Pa.
    series_stiffness: f64,
    /// Initial decay rate k₁/η of the modulus, 1/s.
    first_decay: f64,
    /// Ratios k₂/k₁ of the runs.
    ratios: Vec<f64>,
    /// Largest k₂/k₁ of the curve of Ting's model.
    largest_ratio: f64,
}

impl Parameters {
    fn series(&self, ratio: f64) -> Result<PronySeries, StudyError> {
        let (k1, eta) = (self.series_stiffness, self.series_stiffness / self.first_decay);
        PronySeries::three_parameter_solid(k1, ratio * k1, eta, ActsOn::All)
            .map_err(|error| StudyError::parameters(error.to_string()))
    }

    /// Returns the case with the solid as its Prony term.
    fn case(&self, glass: &Case, ratio: f64) -> Result<Case, StudyError> {
        let term = self.series(ratio)?.terms()[0];
        let term = TermTable::with_relaxation_time(term.weight, term.relaxation_time);
        with_term(glass, "glass", term)
    }
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let glass = laboratory.case("glass")?;
    let case = |ratio: &f64| parameters.case(&glass, *ratio);
    let cases = parameters.ratios.iter().map(case).collect::<Result<_, _>>()?;
    let runs = laboratory.run_all(cases)?;
    let mut findings = Findings::new();
    let mut relaxation = Chart::new(Axis::new("time [µs]"), Axis::new("G(t) / G₀"));
    let (mut points, mut rows) = (Vec::new(), Vec::new());
    for (k, (ratio, run)) in parameters.ratios.iter().zip(&runs).enumerate() {
        let series = parameters.series(*ratio)?;
        let term = series.terms()[0];
        let pair = run.hertz.pair();
        let expected = ting_impact(run.case.scene(), pair, true)?.restitution;
        findings.measure(format!("weight.{ratio}"), term.weight);
        findings.measure(format!("restitution.{ratio}"), run.restitution);
        findings.measure_worst("worst_over_ting", (run.restitution - expected).abs());
        let held = hold(*ratio, parameters.first_decay, 3.0 * term.relaxation_time);
        for (time, stress) in &held {
            let difference = (stress - series.relaxation(*time)).abs();
            findings.measure_worst("worst_over_springs", difference);
        }
        points.push((*ratio, run.restitution));
        rows.push([
            format!("{ratio}"),
            format!("{:.4}", term.weight),
            format!("{:.2}", 1e6 * term.relaxation_time),
            format!("{:.5}", run.restitution),
            format!("{expected:.5}"),
        ]);
        let curve = (0..=100).map(|n| f64::from(n) * 6e-6);
        let curve = curve.map(|t| (1e6 * t, series.relaxation(t))).collect();
        relaxation = relaxation.with(Curve::line(format!("k₂/k₁ = {ratio}"), curve).like_curve(k));
    }
    let by_ting = |k: u32| {
        let ratio = parameters.largest_ratio * f64::from(k) / 24.0;
        let case = parameters.case(&glass, ratio)?;
        let hertz = Plan::of_case(&case)?.estimate.hertz;
        Ok((ratio, ting_impact(case.scene(), hertz.pair(), true)?.restitution))
    };
    let curve = (0..=24).map(by_ting).collect::<Result<_, StudyError>>()?;
    let restitution = Chart::new(Axis::new("k₂ / k₁"), Axis::new("restitution"))
        .with(Curve::points("finite elements", points).coloured("#000000"))
        .with(Curve::dashed("Ting, finite spheres", curve).coloured("#000000"));
    findings.draw(
        "solid",
        "The paper's fig. 5 as a relaxation function: a spring k₁ in series with a spring k₂ beside \
         a dashpot. All fall alike at first, and a collision of 63 µs sees little more: the \
         restitution moves by less than the difference between the two readings of the bulk \
         modulus.",
        &[relaxation, restitution],
    );
    let header = ["k₂/k₁", "weight", "relaxation time [µs]", "here", "Ting, finite spheres"];
    findings.tabulate("Three-parameter solids at 0.5 m/s", header, rows);
    Ok(findings)
}

/// Returns the stress over time, relative to the first, while springs and dashpot are held at a strain of 1; the
/// dashpot's creep ε̇₂ = (k₁ − (k₁+k₂) ε₂)/η by Runge and Kutta's fourth order.
fn hold(ratio: f64, first_decay: f64, end: f64) -> Vec<(f64, f64)> {
    let rate = |creep: f64| first_decay * (1.0 - (1.0 + ratio) * creep);
    let step = end / f64::from(N_STEPS);
    let mut creep = 0.0;
    let mut held = vec![(0.0, 1.0)];
    for n in 1..=N_STEPS {
        let a = rate(creep);
        let b = rate(creep + 0.5 * step * a);
        let c = rate(creep + 0.5 * step * b);
        let d = rate(creep + step * c);
        creep += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        held.push((step * f64::from(n), 1.0 - creep));
    }
    held
}
