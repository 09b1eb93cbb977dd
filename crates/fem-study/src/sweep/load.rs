//! A sweep file, its tables read as measured data are.

use std::path::Path;

use fem_case::{CaseError, Sweep};

use crate::measured::rows_below;

/// Reads a sweep file, the tables that it names and its base case; `overrides` are those of the base case.
///
/// # Errors
/// Those of [`Sweep::load`].
pub fn load(path: &Path, overrides: &[String]) -> Result<Sweep, CaseError> {
    Sweep::load(path, overrides, &rows_below)
}
