//! What finite strain changes: runs against the same collision at small strain, and runs against
//! their finer meshes.
//!
//! Of each run all that the study `summary` measures, and of its pulse `NAME.pulse_time`, the time of
//! Hertz' pulse that is as wide by its second moment, √(∫F (t − t̄)² dt/∫F dt), and `NAME.pulse_force`,
//! the top of the parabola that fits the force best within a tenth of the contact time around its
//! largest value. Neither knows of single points that close last or ring.
//!
//! For each pair of `against` what changes from the partner to the run: `NAME.time_change` (first to
//! last contact), `NAME.width_change` (of `pulse_time`) and `NAME.force_change` as shares,
//! `NAME.restitution_change`, and `NAME.width_slope` and `NAME.force_slope` over the partner's largest
//! contact radius over R\*.

use std::collections::BTreeMap;

use fem_collision::Row;
use serde::Deserialize;

use super::summary;
use crate::error::StudyError;
use crate::findings::{Findings, Table};
use crate::laboratory::Laboratory;
use crate::run::Run;

/// Time of Hertz' elastic pulse over the root of its second moment, by quadrature.
const TIME_OVER_WIDTH: f64 = 5.152_65;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Runs and the runs that they are held against.
    against: BTreeMap<String, String>,
}

/// The pulse of a run.
#[derive(Clone, Copy)]
struct Pulse {
    /// First to last contact, s.
    contact_time: f64,
    /// By its second moment, s.
    time: f64,
    force: f64,
    restitution: f64,
    /// Largest contact radius over R*.
    strain: f64,
}

/// Runs all cases and compares.
pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { against } = laboratory.parameters()?;
    let names: Vec<&String> = laboratory.claim().runs.keys().collect();
    let cases = names.iter().map(|name| laboratory.case(name));
    let runs = laboratory.simulate_all(cases.collect::<Result<_, _>>()?)?;
    let mut findings = Findings::new();
    let mut pulses = BTreeMap::new();
    for (name, run) in names.into_iter().zip(&runs) {
        for (quantity, value) in summary::quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        let pulse = Pulse::of(run);
        findings.measure(format!("{name}.pulse_time"), pulse.time);
        findings.measure(format!("{name}.pulse_force"), pulse.force);
        pulses.insert(name.clone(), pulse);
    }
    let pulse_of = |name: &String| {
        let known = pulses.get(name).copied();
        known.ok_or_else(|| StudyError::parameters(format!("against: there is no [run.{name}]")))
    };
    let mut rows = Vec::new();
    for (name, partner) in &against {
        let (own, base) = (pulse_of(name)?, pulse_of(partner)?);
        let change = |quantity: fn(&Pulse) -> f64| quantity(&own) / quantity(&base) - 1.0;
        let [time, width] = [change(|pulse| pulse.contact_time), change(|pulse| pulse.time)];
        let force = change(|pulse| pulse.force);
        let restitution = own.restitution - base.restitution;
        let changes = [
            ("time_change", time),
            ("width_change", width),
            ("force_change", force),
            ("restitution_change", restitution),
            ("width_slope", width / base.strain),
            ("force_slope", force / base.strain),
        ];
        for (quantity, value) in changes {
            findings.measure(format!("{name}.{quantity}"), value);
        }
        let numbers =
            [format!("{:.3}", base.strain), percent(time), percent(width), percent(force)];
        let rest = [format!("{restitution:+.4}")];
        let slopes = [width, force].map(|change| format!("{:+.3}", change / base.strain));
        let cells = [name.clone(), partner.clone()].into_iter();
        rows.push(cells.chain(numbers).chain(rest).chain(slopes).collect());
    }
    let header =
        ["run", "against", "a/R*", "ΔT", "Δw", "ΔF", "Δe", "Δw/w over a/R*", "ΔF/F over a/R*"];
    let caption = "What changes from one run to another: contact time T, width of the pulse w, peak force F, \
                   restitution e."
        .into();
    findings.tables.push(Table { caption, header: header.map(String::from).to_vec(), rows });
    Ok(findings)
}

fn percent(share: f64) -> String {
    format!("{:+.3} %", 100.0 * share)
}

impl Pulse {
    fn of(run: &Run) -> Self {
        let rows = &run.collision.history;
        Self {
            contact_time: run.contact_time(),
            time: TIME_OVER_WIDTH * width(rows),
            force: top(rows, run.contact_time()),
            restitution: run.restitution,
            strain: run.max_contact_radius() / run.hertz.pair().effective_radius(),
        }
    }
}

/// Root of the second moment of the force over time, trapezoidal rule.
fn width(rows: &[Row]) -> f64 {
    let moment = |of: &dyn Fn(f64) -> f64| -> f64 {
        let value = |row: &Row| row.contact_force * of(row.time);
        let piece = |pair: &[Row]| {
            0.5 * (value(&pair[0]) + value(&pair[1])) * (pair[1].time - pair[0].time)
        };
        rows.windows(2).map(piece).sum()
    };
    let impulse = moment(&|_| 1.0);
    let mean = moment(&|time| time) / impulse;
    (moment(&|time| (time - mean) * (time - mean)) / impulse).sqrt()
}

/// The top of the parabola of least squares through the rows around the largest force.
fn top(rows: &[Row], contact_time: f64) -> f64 {
    let Some(peak) = rows.iter().max_by(|a, b| a.contact_force.total_cmp(&b.contact_force)) else {
        return f64::NAN;
    };
    let half = 0.05 * contact_time;
    let near = rows.iter().filter(|row| (row.time - peak.time).abs() <= half);
    // Σ x^(i+j) c_j = Σ x^i F in x = (t − t_peak)/half.
    let (mut moments, mut sums) = ([0.0; 5], [0.0; 3]);
    for row in near {
        let x = (row.time - peak.time) / half;
        let mut power = 1.0;
        for k in 0..5 {
            moments[k] += power;
            if k < 3 {
                sums[k] += power * row.contact_force;
            }
            power *= x;
        }
    }
    let matrix = |i: usize, j: usize| moments[i + j];
    let minor = |column: Option<usize>| {
        let entry = |i: usize, j: usize| if column == Some(j) { sums[i] } else { matrix(i, j) };
        entry(0, 0) * (entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1))
            - entry(0, 1) * (entry(1, 0) * entry(2, 2) - entry(1, 2) * entry(2, 0))
            + entry(0, 2) * (entry(1, 0) * entry(2, 1) - entry(1, 1) * entry(2, 0))
    };
    let [c_0, c_1, c_2] = [0, 1, 2].map(|j| minor(Some(j)) / minor(None));
    c_0 - c_1 * c_1 / (4.0 * c_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_collision::Book;

    fn pulse(force: impl Fn(f64) -> f64) -> Vec<Row> {
        let row = |k: usize| {
            let time = 1e-3 * k as f64;
            Row {
                time,
                contact_force: force(time),
                contact_radius: None,
                approach: 0.0,
                centre_pressure: None,
                velocity: [0.0; 2],
                energies: Book::EMPTY,
                residual: None,
                vibration: [0.0; 2],
            }
        };
        (0..=1000).map(row).collect()
    }

    /// In s² = 1 − δ/δ_max, time is ∫ 2s ds/√(1 − (1 − s²)^(5/2)) and force (1 − s²)^(3/2).
    #[test]
    fn the_width_of_hertz_pulse_is_known() {
        let n = 100_000;
        let (mut time, mut impulse, mut moment) = (0.0, 0.0, 0.0);
        for k in 0..n {
            let s = (f64::from(k) + 0.5) / f64::from(n);
            let depth = 1.0 - s * s;
            let dt = 2.0 * s / (1.0 - depth.powf(2.5)).sqrt() / f64::from(n);
            let (force, middle) = (depth.powf(1.5), time + 0.5 * dt);
            impulse += force * dt;
            moment += force * middle * middle * dt;
            time += dt;
        }
        let ratio = 2.0 * time / (moment / impulse).sqrt();
        assert!((ratio - TIME_OVER_WIDTH).abs() < 1e-4, "{ratio}");
    }

    /// Of t (1 − t) the second moment is a twentieth; the top lies between two rows.
    #[test]
    fn a_parabola_has_its_top_and_its_width() {
        let rows = pulse(|t| 4.0 * t * (1.0 - t));
        assert!((width(&rows) - 0.05f64.sqrt()).abs() < 1e-5);
        let rows = pulse(|t| 4.0 * t * (0.9993 - t));
        assert!((top(&rows, 1.0) / 0.9993f64.powi(2) - 1.0).abs() < 1e-9);
    }

    /// A point that rings by a per cent over a hundredth of the time moves the top by next to nothing.
    #[test]
    fn ringing_does_not_count() {
        let quiet = pulse(|t| (std::f64::consts::PI * t).sin());
        let ringing = pulse(|t| (std::f64::consts::PI * t).sin() + 0.01 * (628.3 * t).sin());
        let change = top(&ringing, 1.0) / top(&quiet, 1.0) - 1.0;
        assert!(change.abs() < 5e-4, "{change}");
        let change = width(&ringing) / width(&quiet) - 1.0;
        assert!(change.abs() < 5e-4, "{change}");
    }
}
