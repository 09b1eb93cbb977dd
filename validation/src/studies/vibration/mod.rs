//! Free vibrations of a sphere: frequencies of the finite elements against the exact equation.
//!
//! Measures for each Poisson's ratio ν and mode nSl: `ν.nSl.root`, the exact ω R/c_s; `ν.nSl.error`,
//! relative, on the finest mesh; `ν.nSl.order` of convergence.

mod bessel;
mod frequency;
mod spheroidal;

use fem_figure::{Axis, Chart, Curve, GREY};
use rayon::prelude::*;
use serde::Deserialize;

pub(crate) use spheroidal::{ElasticSphere, Vibration};

use crate::{Findings, Laboratory, StudyError, studies::order::fitted_order};

/// Frequency beyond every mode that a mesh of a dozen elements can resolve.
const HIGHEST_FREQUENCY: f64 = 12.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    poissons_ratios: Vec<f64>,
    /// Names of the modes by overtone and degree, such as `1S2`.
    modes: Vec<String>,
    /// Elements over the radius of each mesh, ascending.
    elements: Vec<f64>,
    /// Number of periods of each vibration.
    periods: f64,
}

/// A mode and its relative error on each mesh.
struct Ringing {
    poissons_ratio: f64,
    mode: String,
    exact: f64,
    errors: Vec<f64>,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let (ratios, modes) = (&parameters.poissons_ratios, &parameters.modes);
    let pairs: Vec<_> = ratios.iter().flat_map(|nu| modes.iter().map(move |m| (*nu, m))).collect();
    let results = pairs
        .into_par_iter()
        .map(|(nu, mode)| {
            let exact = vibration(nu, mode)?;
            let error = |elements: &f64| {
                let found = laboratory
                    .work(|| frequency::frequency(&exact, nu, *elements, parameters.periods))?;
                Ok(found / exact.frequency - 1.0)
            };
            let errors: Vec<f64> =
                parameters.elements.par_iter().map(error).collect::<Result<_, StudyError>>()?;
            let mode = mode.clone();
            Ok(Ringing { poissons_ratio: nu, mode, exact: exact.frequency, errors })
        })
        .collect::<Result<Vec<_>, StudyError>>()?;
    let mut findings = Findings::new();
    for Ringing { poissons_ratio, mode, exact, errors } in &results {
        let sizes = parameters.elements.iter().map(|n| n.recip());
        let name = format!("{poissons_ratio}.{mode}");
        findings.measure(format!("{name}.root"), *exact);
        findings.measure(format!("{name}.order"), fitted_order(sizes.zip(errors.iter().copied())));
        findings.measure(format!("{name}.error"), errors.last().copied().unwrap_or(f64::NAN));
    }
    draw(&mut findings, &parameters, &results);
    tabulate(&mut findings, &parameters, &results);
    Ok(findings)
}

/// Returns the exact vibration of a mode's name.
fn vibration(poissons_ratio: f64, mode: &str) -> Result<Vibration, StudyError> {
    let unknown = || {
        StudyError::parameters(format!(
            "mode `{mode}`: wanted is overtone, S and degree, such as 1S2, below ω R/c_s = \
             {HIGHEST_FREQUENCY}"
        ))
    };
    let (overtone, degree) = mode.split_once('S').ok_or_else(unknown)?;
    let overtone: usize = overtone.parse().map_err(|_| unknown())?;
    let degree: usize = degree.parse().map_err(|_| unknown())?;
    let all = ElasticSphere::new(poissons_ratio).vibrations(degree, HIGHEST_FREQUENCY);
    all.get(overtone).copied().ok_or_else(unknown)
}

fn draw(findings: &mut Findings, parameters: &Parameters, results: &[Ringing]) {
    let charts: Vec<Chart> = parameters
        .poissons_ratios
        .iter()
        .map(|nu| {
            let mut chart = Chart::new(
                Axis::new("elements over the radius").logarithmic(),
                Axis::new("error of the frequency [%]").logarithmic(),
            )
            .titled(format!("ν = {nu}"));
            for result in results.iter().filter(|result| result.poissons_ratio == *nu) {
                let errors = result.errors.iter().map(|error| 100.0 * error.abs());
                let points = parameters.elements.iter().copied().zip(errors).collect();
                chart = chart.with(Curve::points_on_line(result.mode.clone(), points));
            }
            let slope = parameters.elements.iter().map(|&n| (n, 30.0 / (n * n))).collect();
            chart.with(Curve::dashed("second order", slope).coloured(GREY))
        })
        .collect();
    let caption = "Relative error of the frequency of each mode. The dashed line falls with the \
                   square of the element size.";
    findings.draw("errors", caption, &charts);
}

fn tabulate(findings: &mut Findings, parameters: &Parameters, results: &[Ringing]) {
    let finest = parameters.elements.last().copied().unwrap_or(f64::NAN);
    let rows = results.iter().map(|result| {
        let error = result.errors.last().copied().unwrap_or(f64::NAN);
        [
            result.poissons_ratio.to_string(),
            result.mode.clone(),
            format!("{:.5}", result.exact),
            format!("{:.5}", result.exact * (1.0 + error)),
            format!("{:+.4} %", 100.0 * error),
        ]
    });
    findings.tabulate(
        format!("Frequencies ω R/c_s with {finest} elements over the radius."),
        ["ν", "mode", "exact", "finite elements", "difference"],
        rows,
    );
}
