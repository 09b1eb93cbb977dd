//! The native part of the Python module: `fem_run._native`, below `python/fem_run`.
//!
//! The Python code has the interface for users; here are the classes for cases and collisions, and the
//! calls that compute. Computations run on a thread of their own without Python's lock, while the calling
//! thread handles signals and reports progress (`watch::watched`). Numbers are passed as arrays, or as JSON
//! and CSV text that reads back to the same bits.

#![allow(
    clippy::disallowed_methods,
    reason = "a front door has the clock: how long a run took is in its summary"
)]

mod case;
mod jobs;
mod outcome;
mod sweep;
mod watch;

use fem_command::{Failure, Status};
use pyo3::prelude::*;

/// Returns the exception of a failure: its class follows from the exit status; it has the position, and the
/// message in Python's words.
fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
    let kind = match failure.status() {
        Status::BadInput => "InputError",
        Status::Failed => "RunError",
        Status::Interrupted => "Interrupted",
    };
    let make = || -> PyResult<PyErr> {
        let case = failure.case_error();
        let place = (
            case.map(|case| case.source_name()),
            case.and_then(|case| case.line()),
            case.and_then(|case| case.column()),
            case.and_then(|case| case.key()),
        );
        let create = py.import("fem_run._errors")?.getattr("from_command")?;
        Ok(PyErr::from_value(create.call1((kind, failure.text(), failure.advice(), place))?))
    };
    make().unwrap_or_else(|error| error)
}

/// Turns failures into Python exceptions.
trait OrRaise<T> {
    /// Returns the value, or the exception.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T, E: Into<Failure>> OrRaise<T> for Result<T, E> {
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raised(py, &error.into()))
    }
}

/// The content of `fem_run._native`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::jobs::{material_toml, materials, numbers_of, options, run_command};
    #[pymodule_export]
    use crate::outcome::Outcome;
    #[pymodule_export]
    use crate::sweep::{key_column, run_members, table_columns};
}
