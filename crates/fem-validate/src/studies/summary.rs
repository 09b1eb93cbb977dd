//! The quantities of plain runs: `NAME.restitution`, `NAME.contact_time`, ….

use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;
use crate::run::Simulated;

/// Runs every case of the claim.
pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let names: Vec<&String> = laboratory.claim().runs.keys().collect();
    let cases = names.iter().map(|name| laboratory.case(name));
    let runs = laboratory.simulate_all(cases.collect::<Result<_, _>>()?)?;
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs) {
        for (quantity, value) in quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
    }
    Ok(findings)
}

/// The quantities of a run by name, SI; NaN where the model has none.
pub(crate) fn quantities(run: &Simulated) -> impl Iterator<Item = (&'static str, f64)> {
    let (outcome, hertz) = (&run.outcome, &run.hertz);
    let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let vibration = outcome.bodies.iter().filter_map(|body| body.vibration_energy);
    let vibration = known(vibration.reduce(|lower, upper| lower + upper));
    let (contact_time, peak_force) = (known(outcome.contact_time), known(outcome.peak_force));
    [
        ("restitution", run.restitution),
        ("loss", 1.0 - run.restitution),
        ("contact_time", contact_time),
        ("contact_time_over_hertz", contact_time / hertz.contact_time()),
        ("peak_force", peak_force),
        ("peak_force_over_hertz", peak_force / hertz.peak_force()),
        ("max_approach", known(outcome.max_approach)),
        ("max_contact_radius", known(outcome.max_contact_radius)),
        ("peak_pressure", known(outcome.peak_pressure)),
        ("pressure_over_hertz_at_force", run.pressure_over_hertz_at_force()),
        ("energy_residual", known(outcome.residual_relative)),
        ("momentum_residual", known(outcome.momentum_residual_relative)),
        ("vibration_energy_share", vibration / known(outcome.initial_energy)),
    ]
    .into_iter()
}
