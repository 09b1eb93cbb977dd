//! A case in memory.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fem::{Identity, Simulation};
use fem_command::{Failure, JobInput, Timed};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::OrRaise;
use crate::outcome::Outcome;
use crate::watch::{BROKEN, RunWatch, watched};

/// A valid case with its text and overrides.
#[pyclass(frozen, module = "fem_run._native")]
#[derive(Clone)]
pub struct Case {
    name: String,
    text: String,
    folder: PathBuf,
    overrides: Vec<String>,
    pub(crate) case: fem::Case,
}

impl Case {
    fn made(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        overrides: Vec<String>,
    ) -> PyResult<Self> {
        let case = fem::Case::parse(&name, &text, &folder, &overrides).or_raise(py)?;
        Ok(Self { name, text, folder, overrides, case })
    }

    /// Returns the case as the input of a job.
    pub(crate) fn given(&self) -> JobInput {
        JobInput { case: Some(self.case.clone()), name: self.name.clone(), data: None }
    }
}

#[pymethods]
impl Case {
    /// Reads a file, whose unlikely numbers need a unit.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, overrides: Vec<String>) -> PyResult<Self> {
        let name = path.display().to_string();
        let text = fem_case::text_at(&path, &name).or_raise(py)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let case = Self::made(py, name, text, folder, overrides)?;
        case.case.check_units(true).or_raise(py)?;
        Ok(case)
    }

    /// Reads a text.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        name: String,
        text: String,
        folder: PathBuf,
        overrides: Vec<String>,
    ) -> PyResult<Self> {
        Self::made(py, name, text, folder, overrides)
    }

    /// Returns the arguments of `parse` that recreate the case, also in another process (pickle).
    fn parts(&self) -> (String, String, PathBuf, Vec<String>) {
        (self.name.clone(), self.text.clone(), self.folder.clone(), self.overrides.clone())
    }

    /// Returns the case with further overrides, `KEY=VALUE`.
    fn overridden(&self, py: Python<'_>, overrides: Vec<String>) -> PyResult<Self> {
        let (name, text, folder, mut all) = self.parts();
        all.extend(overrides);
        Self::made(py, name, text, folder, all)
    }

    /// Returns the name of the case in messages.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Returns the title of the case.
    #[getter]
    fn title(&self) -> &str {
        self.case.scene().title()
    }

    /// Returns the name of the default result folder, which begins with `stem`.
    fn folder_name(&self, stem: &str) -> String {
        self.case.folder_name(stem)
    }

    /// Returns the case as written, with its overrides, as TOML in SI.
    fn to_toml(&self) -> String {
        // A valid case contains only what TOML can hold.
        self.case.toml_of(self.case.file()).unwrap_or_default()
    }

    /// Returns the tables of the case as JSON in SI.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(self.case.file())
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    /// Returns the number at a key in SI, and its unit.
    fn number_at(&self, parts: Vec<String>) -> Option<(f64, &'static str)> {
        self.case.file().number_at(parts.iter().map(String::as_str))
    }

    /// Returns the identity of the result with this build, which is also the name of a sweep's member.
    fn identity(&self, py: Python<'_>) -> PyResult<String> {
        Ok(Identity::of(&self.case).or_raise(py)?.result)
    }

    /// Returns the text of `fem-run check`.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let given = self.given();
        py.detach(|| fem_command::check(&given)).or_raise(py)
    }

    /// Computes the collision; `report` is called with the progress, 0 to 1.
    fn run(
        &self,
        py: Python<'_>,
        report: Option<&Bound<'_, PyAny>>,
        fields: bool,
    ) -> PyResult<(Outcome, Option<PyErr>)> {
        let started = Instant::now();
        let case = self.case.clone();
        let (ran, error) = watched(py, report, Duration::MAX, move |watch| {
            let mut simulation = Simulation::new(case)?;
            if !fields {
                simulation = simulation.without_snapshots();
            }
            let mut timed = Timed::since(started, RunWatch(watch));
            let computed = simulation.run_within_tolerance(&mut timed);
            Ok::<_, Failure>((computed, timed.stop().0))
        })?;
        // Without a limit of its time the work has ended with a value.
        let Some(ran) = ran else {
            return Err(error.unwrap_or_else(|| PyRuntimeError::new_err(BROKEN)));
        };
        let (computed, stopwatch) = ran.or_raise(py)?;
        Ok((Outcome::of(computed, stopwatch), error))
    }
}
