//! The quantities of plain runs: `NAME.restitution`, `NAME.contact_time`, ….

use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::{Laboratory, Run};

/// Runs every case of the claim.
pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let names: Vec<&String> = laboratory.claim().runs.keys().collect();
    let cases = names.iter().map(|name| laboratory.case(name, &[]));
    let runs = laboratory.run_all(cases.collect::<Result<_, _>>()?)?;
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs) {
        for (quantity, value) in quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
    }
    Ok(findings)
}

/// The quantities of a run by name, SI.
pub(crate) fn quantities(run: &Run) -> impl Iterator<Item = (&'static str, f64)> {
    let collision = &run.collision;
    let hertz = run.problem.plan.estimate.hertz;
    let vibration: f64 = collision.vibration_energy.map_or(f64::NAN, |both| both.iter().sum());
    [
        ("restitution", run.restitution),
        ("loss", 1.0 - run.restitution),
        ("contact_time", run.contact_time),
        ("contact_time_over_hertz", run.contact_time / hertz.contact_time()),
        ("peak_force", collision.peak_force),
        ("peak_force_over_hertz", collision.peak_force / hertz.peak_force()),
        ("max_approach", collision.max_approach),
        ("max_contact_radius", collision.max_contact_radius),
        ("peak_pressure", collision.peak_pressure),
        ("pressure_over_hertz_at_force", run.pressure_over_hertz_at_force()),
        ("energy_residual", collision.residual_relative),
        ("momentum_residual", collision.momentum_residual_relative),
        ("vibration_energy_share", vibration / collision.initial_energy),
    ]
    .into_iter()
}
