//! Reads the trials of a Newton's cradle from a table of angles.

use super::cradle::Trial;
use crate::table::{DataError, Measured, Table};

/// Returns the trials of a table, one per row. Its columns are `alpha_deg` and `beta_deg` (or `_rad`) and optionally
/// `alpha_uncertainty_deg` and `beta_uncertainty_deg`.
///
/// # Errors
/// The table has an error, or a column does not name its unit.
///
/// ```
/// use fem_data::instruments::cradle_trials;
/// use fem_data::table::Table;
///
/// let table = Table::parse("trials.csv", "alpha_deg,beta_deg\n90,60\n")?;
/// let trials = cradle_trials(&table)?;
/// assert_eq!(trials[0].release.value, std::f64::consts::FRAC_PI_2);
///
/// let table = Table::parse("trials.csv", "alpha,beta\n90,60\n")?;
/// let error = cradle_trials(&table).unwrap_err();
/// assert_eq!(error.to_string(), "trials.csv:1: the column alpha does not name its unit");
/// # Ok::<(), fem_data::table::DataError>(())
/// ```
pub fn cradle_trials(table: &Table) -> Result<Vec<Trial>, DataError> {
    let alpha = table.require(&["alpha"], "alpha_deg")?;
    let beta = table.require(&["beta"], "beta_deg")?;
    let of_alpha = table.find(&["alpha_uncertainty"])?;
    let of_beta = table.find(&["beta_uncertainty"])?;
    let trial = |row: usize| {
        Ok(Trial {
            release: angle(table, row, alpha, of_alpha)?,
            rise: angle(table, row, beta, of_beta)?,
        })
    };
    (0..table.n_rows()).map(trial).collect()
}

/// Reads an angle; its column must name the unit, since a bare number may be in degrees or in radians.
fn angle(
    table: &Table,
    row: usize,
    column: usize,
    uncertainty: Option<usize>,
) -> Result<Measured, DataError> {
    let name = &table.header()[column];
    if !name.ends_with("_deg") && !name.ends_with("rad") {
        let error = table.header_fault(format!("the column {name} does not name its unit"));
        return Err(error.in_column(name).with_help(format!("call it {name}_deg or {name}_rad")));
    }
    let uncertainty = uncertainty.map(|column| table.number(row, column, [0; 3]));
    Ok(Measured {
        uncertainty: uncertainty.transpose()?.unwrap_or(0.0),
        value: table.number(row, column, [0; 3])?,
    })
}
