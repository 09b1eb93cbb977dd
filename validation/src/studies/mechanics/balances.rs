//! Energy and momentum balance of whole collisions.
//!
//! Measures `energy` and `momentum`, the largest residual of any run at any instant (over the energy of
//! approach and over Σ m|v|), and `NAME.energy` and `NAME.momentum` of each run.

use fem_collision::{Account, HistoryRow};
use fem_figure::{Axis, Chart, Curve, GREY, Mark};
use serde::Deserialize;

use crate::{Findings, Laboratory, Run, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The runs whose energies are drawn.
    drawn: Vec<String>,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.run_all(cases)?;
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs) {
        findings.measure(format!("{name}.energy"), run.energy_residual());
        findings.measure(format!("{name}.momentum"), run.momentum_residual());
        findings.measure_worst("energy", run.energy_residual());
        findings.measure_worst("momentum", run.momentum_residual());
    }
    let drawn = names.iter().zip(&runs).filter(|(name, _)| parameters.drawn.contains(name));
    let charts: Vec<Chart> = drawn.map(|(name, run)| energies(run, name)).collect();
    let caption = "Where the energy is during some of the collisions. The account sums up kinetic, \
                   strain and contact energy and what was dissipated, less the work of a moving wall.";
    findings.draw("energies", caption, &charts);
    let rows = names.iter().zip(&runs).map(|(name, run)| {
        [
            name.replace('_', " "),
            run.case.scene().title().to_string(),
            format!("{:.4}", run.restitution),
            format!("{:.1e}", run.energy_residual()),
            format!("{:.1e}", run.momentum_residual()),
        ]
    });
    let header = ["run", "case", "restitution", "energy", "momentum"];
    findings.tabulate("Worst imbalance of each run.", header, rows);
    Ok(findings)
}

/// Returns the chart of the energies of one run over that of approach, ½ m* v².
fn energies(run: &Run, name: &str) -> Chart {
    let hertz = run.hertz;
    let scale = 0.5 * hertz.pair().effective_mass() * hertz.approach_speed().powi(2);
    let start = run.collision.first_contact.unwrap_or(f64::NAN);
    let curve = |label: &str, mark: Mark, value: fn(&HistoryRow) -> f64| {
        let point =
            |row: &HistoryRow| ((row.time - start) / run.contact_time(), value(row) / scale);
        Curve::new(label, mark, run.collision.history.iter().map(point).collect())
    };
    let account = |row: &HistoryRow| row.energies.residual(0.0);
    Chart::new(
        Axis::new("time/contact time").from_to(0.0, 1.2),
        Axis::new("energy/energy of approach"),
    )
    .titled(name.replace('_', " "))
    .with(curve("kinetic", Mark::Line, |row| energy(row, Account::Kinetic)))
    .with(curve("strain", Mark::Line, |row| energy(row, Account::Strain)))
    .with(curve("contact springs", Mark::Line, |row| energy(row, Account::Contact)))
    .with(curve("dissipated", Mark::Line, |row| energy(row, Account::ViscousDissipation)))
    .with(curve("work of a wall", Mark::Line, |row| energy(row, Account::WallWork)))
    .with(curve("account", Mark::Dashed, account).coloured(GREY))
}

/// Returns an account's energy, J; 0 if no effect fills it.
fn energy(row: &HistoryRow, account: Account) -> f64 {
    row.energy(account).unwrap_or(0.0)
}
