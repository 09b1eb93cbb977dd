//! The other jobs of the command, and the command itself.

use std::ffi::OsString;

use fem::measured::{Table, decode, is_of_library, library_table};
use fem_case::library;
use fem_command::{Failure, JobInput};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::case::Case;
use crate::failure::OrRaise;

/// A table: its name and its CSV text in bytes.
type Data = Option<(String, Vec<u8>)>;

/// Runs a job without Python's lock and returns its numbers as JSON.
fn done(
    py: Python<'_>,
    given: JobInput,
    data: Data,
    options: Vec<String>,
    job: fn(&JobInput, &[String]) -> Result<Value, Failure>,
) -> PyResult<String> {
    let work = || -> Result<Value, Failure> {
        let read = |(name, bytes): (String, Vec<u8>)| match is_of_library(&name) {
            true => library_table(&name).map(|(table, _)| table),
            false => Table::parse(&name, &decode(&bytes)),
        };
        let table = data.map(read).transpose()?;
        job(&JobInput { table, ..given }, &options)
    };
    let numbers = py.detach(work).or_raise(py)?;
    serde_json::to_string(&numbers).map_err(|error| PyRuntimeError::new_err(error.to_string()))
}

macro_rules! jobs {
    ($($(#[$doc:meta])+ $name:ident;)+) => {
        $(
            $(#[$doc])+
            #[pyfunction]
            pub fn $name(
                py: Python<'_>,
                case: PyRef<'_, Case>,
                data: Data,
                options: Vec<String>,
            ) -> PyResult<String> {
                done(py, case.given(), data, options, fem_command::$name)
            }
        )+
    };
}

jobs! {
    /// Runs `fem-run fit`.
    fit;
    /// Runs `fem-run invert`.
    invert;
    /// Runs `fem-run export`.
    export;
    /// Runs `fem-run calibrate`.
    calibrate;
}

/// Runs `fem-run cradle`.
#[pyfunction]
pub fn cradle(py: Python<'_>, data: Data, options: Vec<String>) -> PyResult<String> {
    done(py, JobInput::default(), data, options, fem_command::cradle)
}

/// Runs `fem-run measure`.
#[pyfunction]
pub fn measure(py: Python<'_>, data: Data, options: Vec<String>) -> PyResult<String> {
    let (name, bytes) = data.unwrap_or_default();
    let numbers = py.detach(|| fem_command::measure(&name, &bytes, &options)).or_raise(py)?;
    serde_json::to_string(&numbers).map_err(|error| PyRuntimeError::new_err(error.to_string()))
}

/// Runs `fem-run relaxation`.
#[pyfunction]
pub fn relaxation(py: Python<'_>, data: Data, options: Vec<String>) -> PyResult<String> {
    let (name, bytes) = data.unwrap_or_default();
    let numbers = py.detach(|| fem_command::relaxation(&name, &bytes, &options)).or_raise(py)?;
    serde_json::to_string(&numbers).map_err(|error| PyRuntimeError::new_err(error.to_string()))
}

/// Returns the options of the jobs as JSON.
#[pyfunction]
pub fn options() -> String {
    fem_command::options().to_string()
}

/// Returns the library of materials as JSON.
#[pyfunction]
pub fn materials() -> String {
    let entry = |(name, found): (&String, &library::Material)| {
        let library::Material { title, names, source, range, material, measured } = found;
        let value = json!({
            "title": title,
            "names": names,
            "source": source,
            "range": range,
            "table": material,
            "measured": measured.iter().map(measured_json).collect::<Value>(),
        });
        (name.clone(), value)
    };
    Value::Object(library::materials().iter().map(entry).collect()).to_string()
}

/// Returns a measured restitution as JSON, with its points as columns.
fn measured_json(measured: &library::MeasuredRestitution) -> Value {
    let (speeds, restitutions): (Vec<f64>, Vec<f64>) = measured.points().into_iter().unzip();
    json!({
        "name": measured.name,
        "source": measured.source,
        "bodies": measured.bodies,
        "size": measured.size,
        "temperature": measured.temperature,
        "speed_m_s": speeds,
        "restitution": restitutions,
        "scatter": measured.scatter(),
    })
}

/// Runs `fem-run materials NAME`.
#[pyfunction]
pub fn material_toml(py: Python<'_>, name: &str) -> PyResult<String> {
    fem_command::material(name).or_raise(py)
}

/// Runs the command line and returns the exit status.
#[pyfunction]
pub fn run_command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| fem_command::run(words))
}
