//! Energy that an elastic collision leaves in vibrations, against the sum over the modes of both
//! spheres under Hertz' pulse.
//!
//! Measures for each run `NAME.loss`, 1 − e², and `NAME.modes`, the sum over modes, both over the energy of
//! approach ½ m* v², and `NAME.ratio`, their quotient.

mod modes;

use fem_case::Shape;
use fem_figure::{Axis, Chart, Curve};
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, Run, StudyError};
use modes::{Excited, Pulse, excite};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// ω R/c_s up to which modes are summed.
    highest_frequency: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let names: Vec<&String> = laboratory.claim().runs.keys().collect();
    let sums = names
        .par_iter()
        .map(|name| {
            let run = laboratory.run(laboratory.case(name)?)?;
            let modes =
                laboratory.work(|| Ok((modes_of(&run, parameters.highest_frequency), 0)))?;
            Ok((run, modes))
        })
        .collect::<Result<Vec<_>, StudyError>>()?;
    let mut findings = Findings::new();
    let mut chart = Chart::new(
        Axis::new("modes up to ω R/c_s"),
        Axis::new("share of the energy of approach").logarithmic(),
    );
    let mut rows = Vec::new();
    for (k, (name, (run, modes))) in names.iter().zip(&sums).enumerate() {
        let energy = energy_of_approach(run);
        let loss = 1.0 - run.restitution * run.restitution;
        let sum = modes.iter().map(|mode| mode.energy).sum::<f64>() / energy;
        findings.measure(format!("{name}.loss"), loss);
        findings.measure(format!("{name}.modes"), sum);
        findings.measure(format!("{name}.ratio"), loss / sum);
        let speed = run.hertz.approach_speed();
        let label = format!("{speed} m/s");
        let end = parameters.highest_frequency;
        chart = chart
            .with(
                Curve::line(format!("sum over modes, {label}"), summed(modes, energy))
                    .like_curve(k),
            )
            .with(
                Curve::dashed(format!("1 − e², {label}"), vec![(0.0, loss), (end, loss)])
                    .like_curve(k),
            );
        rows.push([
            label,
            format!("{loss:.2e}"),
            format!("{sum:.2e}"),
            format!("{:.2}", loss / sum),
            strongest(modes, energy),
        ]);
    }
    let caption = "What Hertz' pulse leaves in the modes of both spheres up to a frequency, and \
                   what the computed collision loses (dashed).";
    findings.draw("modes", caption, &[chart]);
    findings.tabulate(
        "Loss of the computed collision and of the modes, over the energy of approach.",
        ["speed", "1 − e²", "sum over modes", "quotient", "strongest modes"],
        rows,
    );
    Ok(findings)
}

/// Returns the modes of both spheres in ascending frequency.
fn modes_of(run: &Run, highest_frequency: f64) -> Vec<Excited> {
    let pulse = Pulse::new(&run.hertz);
    let mut modes = Vec::new();
    for body in run.case.scene().bodies() {
        if let Shape::Sphere { diameter, material, .. } = body.shape() {
            modes.extend(excite(material, 0.5 * diameter, &pulse, highest_frequency));
        }
    }
    modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    modes
}

/// Returns ½ m* v², J.
fn energy_of_approach(run: &Run) -> f64 {
    let hertz = run.hertz;
    0.5 * hertz.pair().effective_mass() * hertz.approach_speed().powi(2)
}

/// Returns the chart of the running sum over the frequency.
fn summed(modes: &[Excited], energy: f64) -> Vec<(f64, f64)> {
    let mut sum = 0.0;
    let add = |mode: &Excited| {
        sum += mode.energy / energy;
        (mode.frequency, sum)
    };
    modes.iter().map(add).collect()
}

/// Returns the three modes with the largest energies.
fn strongest(modes: &[Excited], energy: f64) -> String {
    let mut order: Vec<&Excited> = modes.iter().collect();
    order.sort_by(|a, b| b.energy.total_cmp(&a.energy));
    let name =
        |mode: &&Excited| format!("{}S{} {:.1e}", mode.overtone, mode.degree, mode.energy / energy);
    order.iter().take(3).map(name).collect::<Vec<_>>().join(", ")
}
