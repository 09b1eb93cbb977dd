//! The other jobs of the command, and the command itself.

use std::ffi::OsString;

use fem_case::library;
use fem_command::JobInput;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::OrRaise;
use crate::case::Case;

/// Runs the job of a command such as `fit` without Python's lock, and returns its numbers as JSON; see `fem_command::numbers_of`.
/// Data are a name and the bytes of a file.
#[pyfunction]
pub fn numbers_of(
    py: Python<'_>,
    job: &str,
    case: Option<PyRef<'_, Case>>,
    data: Option<(String, Vec<u8>)>,
    options: Vec<String>,
) -> PyResult<String> {
    let given = case.map_or_else(JobInput::default, |case| case.given());
    let given = JobInput { data, ..given };
    let numbers = py.detach(|| fem_command::numbers_of(job, &given, &options)).or_raise(py)?;
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
