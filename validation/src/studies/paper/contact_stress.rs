//! Fig. 13: σ_yy in the middle of the contact against time, for several speeds.

use fem_collision::HistoryRow;
use fem_figure::{Axis, Chart, Curve, GREY};

use super::{Speeds, exponent};
use crate::{Findings, Laboratory, Run, StudyError};

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let speeds: Speeds = laboratory.parameters()?;
    let runs = speeds.run_elastic(laboratory)?;
    let mut findings = Findings::new();
    let mut peaks = Vec::new();
    let mut chart = Chart::new(Axis::new("time [µs]"), Axis::new("σ_yy [GPa]"));
    for (k, run) in runs.iter().enumerate() {
        let hertz = run.hertz;
        let (speed, peak) = (hertz.approach_speed(), run.peak_pressure());
        findings.measure(format!("stress.{speed}"), -peak);
        findings.measure_worst("worst_peak", (peak / hertz.peak_pressure() - 1.0).abs());
        findings.measure_worst("worst_at_force", (run.pressure_over_hertz_at_force() - 1.0).abs());
        findings.measure_worst("worst_history", history_difference(run));
        peaks.push((speed, peak));
        let end = run.collision.last_contact.unwrap_or(f64::INFINITY);
        let rows = run.collision.history.iter().filter(|row| row.time <= end);
        let ours = rows.map(|row| (1e6 * row.time, -1e-9 * pressure(row))).collect();
        chart = chart.with(Curve::line(format!("{speed} m/s"), ours).like_curve(k));
        let times = (0..=120).map(|n| hertz.contact_time() * f64::from(n) / 120.0);
        let by_hertz = times.map(|t| (1e6 * t, -1e-9 * pressure_by_hertz(run, t))).collect();
        chart = chart.with(Curve::dashed("", by_hertz).like_curve(k));
    }
    chart = chart.with(Curve::dashed("Hertz", Vec::new()).coloured(GREY));
    findings.measure("exponent", exponent(&peaks));
    findings.draw(
        "contact_stress",
        "Fig. 13 of the paper, computed here: stress across the contact on the axis against time, \
         Hertz dashed. A faster collision is shorter and has a higher pressure; compression and separation are mirror \
         images.",
        &[chart],
    );
    let row = |run: &Run| {
        let hertz = run.hertz;
        let peak = run.peak_pressure();
        [
            format!("{}", hertz.approach_speed()),
            format!("{:.4}", -1e-9 * peak),
            format!("{:.4}", -1e-9 * hertz.peak_pressure()),
            format!("{:+.2} %", 100.0 * (peak / hertz.peak_pressure() - 1.0)),
        ]
    };
    findings.tabulate(
        "Largest compression on the axis, GPa",
        ["speed [m/s]", "here", "Hertz", "difference"],
        runs.iter().map(|run| row(run)).collect::<Vec<_>>(),
    );
    Ok(findings)
}

fn pressure(row: &HistoryRow) -> f64 {
    row.centre_pressure.unwrap_or(f64::NAN)
}

fn pressure_by_hertz(run: &Run, time: f64) -> f64 {
    let hertz = run.hertz;
    hertz.pressure(hertz.at(time).approach).peak_pressure
}

/// Returns the root mean square difference from Hertz' force over the contact, relative to the peak.
fn history_difference(run: &Run) -> f64 {
    let hertz = run.hertz;
    let rows = run.collision.history.iter().filter(|row| row.time <= hertz.contact_time());
    let square = |row: &HistoryRow| (pressure(row) - pressure_by_hertz(run, row.time)).powi(2);
    let (sum, n) = rows.fold((0.0, 0.0), |(sum, n), row| (sum + square(row), n + 1.0));
    (sum / n).sqrt() / hertz.peak_pressure()
}
