//! Measures the quantities of each run: `NAME.restitution`, `NAME.contact_time`, ….

use fem_collision::Account;

use crate::{Findings, Laboratory, Run, StudyError};

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.simulate_all(cases)?;
    let mut findings = Findings::new();
    for (name, run) in names.iter().zip(&runs) {
        for (quantity, value) in quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
    }
    Ok(findings)
}

/// Returns the quantities of a run by name, SI; NaN if the model does not compute one.
pub(crate) fn quantities(run: &Run) -> impl Iterator<Item = (&'static str, f64)> {
    let (collision, hertz) = (&run.collision, &run.hertz);
    let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let vibration = collision.bodies.iter().filter_map(|body| body.vibration_energy);
    let vibration = known(vibration.reduce(|lower, upper| lower + upper));
    let (contact_time, peak_force) = (known(collision.contact_time), known(collision.peak_force));
    let second = collision.bounces.get(1).map(|bounce| bounce.restitution);
    let strain = collision.energies.get(Account::Strain);
    [
        ("restitution", run.restitution),
        ("loss", 1.0 - run.restitution),
        ("contact_time", contact_time),
        ("contact_time_over_hertz", contact_time / hertz.contact_time()),
        ("peak_force", peak_force),
        ("peak_force_over_hertz", peak_force / hertz.peak_force()),
        ("max_approach", known(collision.max_approach)),
        ("max_contact_radius", known(collision.max_contact_radius)),
        ("peak_pressure", known(collision.peak_pressure)),
        ("pressure_over_hertz_at_force", run.pressure_over_hertz_at_force()),
        ("energy_residual", known(collision.residual_relative)),
        ("momentum_residual", known(collision.momentum_residual_relative)),
        ("vibration_energy_share", vibration / known(collision.initial_energy)),
        ("second_restitution", known(second)),
        ("strain_energy_share", known(strain) / known(collision.initial_energy)),
    ]
    .into_iter()
}
