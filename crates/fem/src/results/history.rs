//! `history.csv`.

use std::io::Write;

use fem_case::Scene;
use fem_collision::{Account, Row};

use super::energy::{energy_key, in_history};

/// The name of the file.
pub const HISTORY_FILE: &str = "history.csv";

/// Writes a history, a row an instant; accounts of effects that are on come last. Numbers are the
/// shortest that read back as the same, what the model does not know is blank.
///
/// # Errors
/// `to` cannot be written to.
pub fn history_csv(to: impl Write, scene: &Scene, rows: &[Row]) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    let velocities = scene.bodies().each_ref().map(|body| format!("velocity_{}_m_s", body.name()));
    let books = rows.iter().map(|row| &row.energies);
    let accounts = in_history(books, Account::shown);
    let [energies, of_effects] = accounts
        .each_ref()
        .map(|those| those.iter().map(|account| energy_key(*account)).collect::<Vec<_>>());
    let first =
        ["time_s", "contact_force_n", "contact_radius_m", "approach_m", "centre_pressure_pa"];
    let names = velocities.iter().chain(&energies).map(String::as_str);
    let last = of_effects.iter().map(String::as_str);
    file.write_record(first.into_iter().chain(names).chain(["residual_j"]).chain(last))?;
    for row in rows {
        let [energies, of_effects] = accounts
            .each_ref()
            .map(|those| those.iter().map(|account| row.energy(*account)).collect::<Vec<_>>());
        file.serialize((
            row.time,
            row.contact_force,
            row.contact_radius,
            row.approach,
            row.centre_pressure,
            row.velocity,
            energies,
            row.residual,
            of_effects,
        ))?;
    }
    Ok(file.flush()?)
}
