//! Files of measured data, and their faults.

use std::path::Path;

use fem::measured::{DataError, Table};

use crate::failure::Failure;
use crate::standard_output::one_line;

/// Reads a CSV file.
///
/// # Errors
/// A file that cannot be read, is no CSV, or has no row.
pub fn read_table(path: &Path) -> Result<Table, Failure> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| {
        let name = one_line(&name);
        Failure::bad_input(format!("{name}: this file cannot be read: {error}"))
            .with_help("name a CSV file with a header, such as validation/data/bridges_ice.csv")
    })?;
    Ok(Table::parse(&name, &text)?)
}

impl From<DataError> for Failure {
    fn from(error: DataError) -> Self {
        let failure = Failure::bad_input(error.to_string());
        match error.help {
            Some(help) => failure.with_help(help),
            None => failure,
        }
    }
}
