//! Failures of the command as Python exceptions.

use fem_command::{Failure, Status};
use pyo3::prelude::*;

/// Returns the exception of a failure: its class follows from the exit status; it has the position, and the
/// message in Python's words.
pub fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
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
pub trait OrRaise<T> {
    /// Returns the value, or the exception.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T, E: Into<Failure>> OrRaise<T> for Result<T, E> {
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raised(py, &error.into()))
    }
}
