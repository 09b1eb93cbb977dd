//! `history.csv`.

use std::path::Path;

use fem_case::Problem;
use fem_explicit::HistoryRow;

/// The name of the file.
pub const HISTORY_FILE: &str = "history.csv";

/// Writes the history, a row an instant; numbers are the shortest that read back as the same.
///
/// # Errors
/// The file system.
pub fn write_history(folder: &Path, problem: &Problem, rows: &[HistoryRow]) -> csv::Result<()> {
    let [first, second] = &problem.case.scene.bodies;
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
        file.serialize([
            row.time,
            row.contact_force,
            row.contact_radius,
            row.approach,
            row.centre_pressure,
            row.velocity[0],
            row.velocity[1],
            row.kinetic,
            row.strain,
            row.contact,
            row.viscous_dissipation,
            row.residual,
        ])?;
    }
    Ok(file.flush()?)
}
