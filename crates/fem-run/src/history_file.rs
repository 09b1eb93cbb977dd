//! `history.csv`.

use std::path::Path;

use fem_case::{Case, OutcomeRow};

/// The name of the file.
pub const HISTORY_FILE: &str = "history.csv";

/// Writes the history, a row an instant; numbers are the shortest that read back as the same, what
/// the model does not know is blank.
///
/// # Errors
/// The file system.
pub fn write_history(folder: &Path, case: &Case, rows: &[OutcomeRow]) -> csv::Result<()> {
    let [first, second] = &case.scene.bodies;
    let mut file = csv::Writer::from_path(folder.join(HISTORY_FILE))?;
    file.write_record([
        "time_s",
        "contact_force_n",
        "contact_radius_m",
        "approach_m",
        "centre_pressure_pa",
        &format!("velocity_{}_m_s", first.name),
        &format!("velocity_{}_m_s", second.name),
        "kinetic_j",
        "strain_j",
        "contact_j",
        "viscous_dissipation_j",
        "residual_j",
    ])?;
    for row in rows {
        file.serialize((
            row.time,
            row.contact_force,
            row.contact_radius,
            row.approach,
            row.centre_pressure,
            row.velocity,
            row.kinetic,
            row.strain,
            row.contact,
            row.viscous_dissipation,
            row.residual,
        ))?;
    }
    Ok(file.flush()?)
}
