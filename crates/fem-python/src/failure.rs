//! Failures of the command as exceptions of Python.

use fem_command::{Failure, Status};
use pyo3::prelude::*;

/// The exception of a failure: the class of its exit status, the words of the command, and where it is.
pub fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
    let class = match failure.status() {
        Status::BadInput => "InputError",
        Status::Failed => "RunError",
        Status::Interrupted => "Interrupted",
    };
    let make = || -> PyResult<PyErr> {
        let class = py.import("fem_run._errors")?.getattr(class)?;
        let case = failure.case_error();
        let place = (
            case.map(|case| case.source_name()),
            case.and_then(|case| case.line()),
            case.and_then(|case| case.column()),
            case.and_then(|case| case.key()),
        );
        let error = class.call1((failure.text(), failure.advice(), place))?;
        Ok(PyErr::from_value(error))
    };
    make().unwrap_or_else(|error| error)
}

/// Failures of what a front door of Rust gives, raised.
pub trait Raise<T> {
    /// The value, or the exception.
    ///
    /// # Errors
    /// The failure as an exception.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T, E: Into<Failure>> Raise<T> for Result<T, E> {
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raised(py, &error.into()))
    }
}
