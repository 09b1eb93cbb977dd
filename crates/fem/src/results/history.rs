//! `history.csv`.

use std::io::Write;

use fem_case::Scene;
use fem_collision::{Account, Row};

/// The name of the file.
pub const HISTORY_FILE: &str = "history.csv";
/// Accounts of the ledger that every history has a column of.
const ENERGIES: [Account; 4] =
    [Account::Kinetic, Account::Strain, Account::Contact, Account::ViscousDissipation];

/// Writes a history, a row an instant; numbers are the shortest that read back as the same, what the
/// model does not know is blank.
///
/// # Errors
/// Those of `to`.
pub fn history_csv(to: impl Write, scene: &Scene, rows: &[Row]) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    let velocities = scene.bodies().each_ref().map(|body| format!("velocity_{}_m_s", body.name()));
    let energies = ENERGIES.map(|account| format!("{}_j", account.name()));
    let first =
        ["time_s", "contact_force_n", "contact_radius_m", "approach_m", "centre_pressure_pa"];
    let names = velocities.iter().chain(&energies).map(String::as_str);
    file.write_record(first.into_iter().chain(names).chain(["residual_j"]))?;
    for row in rows {
        file.serialize((
            row.time,
            row.contact_force,
            row.contact_radius,
            row.approach,
            row.centre_pressure,
            row.velocity,
            ENERGIES.map(|account| row.energy(account)),
            row.residual,
        ))?;
    }
    Ok(file.flush()?)
}
