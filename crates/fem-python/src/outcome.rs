//! A computed collision.

use std::collections::BTreeMap;
use std::path::PathBuf;

use fem::ComputedCollision;
use fem::results::{Summary, history_columns, write_snapshots};
use fem_command::{Stopwatch, save};
use fem_vtk::{ReadArray, VtuFile};
use numpy::{PyArray1, PyArrayMethods, PyUntypedArray};
use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;

use crate::{OrRaise, raised};

/// A collision with its simulation.
#[pyclass(frozen, module = "fem_run._native")]
pub struct Outcome {
    computed: ComputedCollision,
    stopwatch: Stopwatch,
    summary: Summary,
}

impl Outcome {
    /// Summarises a collision.
    pub fn of(computed: ComputedCollision, stopwatch: Stopwatch) -> Self {
        let summary = stopwatch.summary(&computed, Vec::new());
        Self { computed, stopwatch, summary }
    }
}

fn broken(error: impl std::fmt::Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Returns an array with one row per point or cell, of which there are `n`.
fn array<'py>(py: Python<'py>, read: &ReadArray, n: usize) -> PyResult<Bound<'py, PyUntypedArray>> {
    let shaped = |len: usize| (len / n.max(1), n.max(1));
    if let Some(values) = read.as_float() {
        let array = PyArray1::from_slice(py, values);
        return match values.len() == n {
            true => Ok(array.as_untyped().clone()),
            false => Ok(array.reshape(shaped(values.len()))?.as_untyped().clone()),
        };
    }
    let values = read.as_integer().unwrap_or_default();
    Ok(PyArray1::from_slice(py, values).reshape(shaped(values.len()))?.as_untyped().clone())
}

#[pymethods]
impl Outcome {
    /// Returns the text of `summary.json`.
    fn summary(&self) -> PyResult<String> {
        serde_json::to_string(&self.summary).map_err(broken)
    }

    /// Returns the name of the default result folder, which begins with `stem`.
    fn folder_name(&self, stem: &str) -> String {
        self.computed.simulation.case().folder_name(stem)
    }

    /// Returns why the run stopped early, as an exception.
    fn failure(&self, py: Python<'_>) -> Option<PyErr> {
        let kept = "what was computed so far is the exception's result, marked incomplete";
        let failure = fem_command::stopped(&self.computed.collision, &self.summary, kept)?;
        Some(raised(py, &failure))
    }

    /// Returns the columns of `history.csv`.
    fn history<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyArray1<f64>>)>> {
        let scene = self.computed.simulation.case().scene();
        let columns = history_columns(scene, &self.computed.collision.history);
        let array = |(name, numbers): (String, Vec<f64>)| (name, PyArray1::from_vec(py, numbers));
        Ok(columns.into_iter().map(array).collect())
    }

    /// Returns the snapshots: label, time and arrays by name, as in their VTK files.
    fn snapshots<'py>(&self, py: Python<'py>) -> PyResult<Vec<SnapshotArrays<'py>>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path();
        let write =
            || write_snapshots(path, "s", &self.computed.simulation, &self.computed.collision);
        let (files, _) = py.detach(write).map_err(broken)?;
        let is_grid = |name: &&String| name.ends_with(".vtu");
        files.iter().filter(is_grid).map(|name| snapshot(py, path.join(name))).collect()
    }

    /// Writes the result folder, as the command does.
    fn save(&self, py: Python<'_>, folder: PathBuf, stem: String, force: bool) -> PyResult<()> {
        let Self { computed, stopwatch, .. } = self;
        let write = || save(&folder, &stem, computed, stopwatch, force);
        py.detach(write).or_raise(py)
    }
}

type Arrays<'py> = BTreeMap<String, Bound<'py, PyUntypedArray>>;
/// Label, time, grid, point arrays and cell arrays.
type SnapshotArrays<'py> = (String, f64, Arrays<'py>, Arrays<'py>, Arrays<'py>);

fn snapshot(py: Python<'_>, path: PathBuf) -> PyResult<SnapshotArrays<'_>> {
    let file = VtuFile::open(&path).map_err(broken)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().to_string();
    let label = name.splitn(3, '_').nth(2).ok_or_else(|| PyKeyError::new_err(name.clone()))?;
    let time = file.field_data("TimeValue").map_err(broken)?;
    let time = time.as_float().and_then(|values| values.first().copied()).unwrap_or(f64::NAN);
    let mesh = file.quad_mesh().map_err(broken)?;
    let points: Vec<f64> = mesh.points.iter().flatten().copied().collect();
    let quads: Vec<i64> = mesh.quads.iter().flatten().map(|node| i64::from(*node)).collect();
    let grid = [
        (
            "points",
            PyArray1::from_vec(py, points).reshape((mesh.points.len(), 3))?.as_untyped().clone(),
        ),
        (
            "quads",
            PyArray1::from_vec(py, quads).reshape((mesh.quads.len(), 4))?.as_untyped().clone(),
        ),
    ];
    let grid = grid.into_iter().map(|(name, array)| (name.to_string(), array)).collect();
    let arrays = |names: Vec<String>, is_points: bool, n: usize| -> PyResult<Arrays<'_>> {
        let one = |name: String| {
            let read = if is_points { file.point_data(&name) } else { file.cell_data(&name) };
            let read = read.map_err(broken)?;
            let len =
                read.as_float().map_or(read.as_integer().map_or(0, <[i64]>::len), <[f64]>::len);
            Ok((name, array(py, &read, len / n.max(1))?))
        };
        names.into_iter().map(one).collect()
    };
    let names = |names: &mut dyn Iterator<Item = &str>| names.map(String::from).collect();
    let points = arrays(names(&mut file.point_data_names()), true, mesh.points.len())?;
    let cells = arrays(names(&mut file.cell_data_names()), false, mesh.quads.len())?;
    Ok((label.to_string(), time, grid, points, cells))
}
