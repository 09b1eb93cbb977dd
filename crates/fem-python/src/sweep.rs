//! Many cases side by side.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use fem::results::Summary;
use fem::sweep::{Checked, Columns, Observer, Row, Runner, check};
use fem::{Case as FemCase, CaseError, Shared};
use fem_collision::{Monitor, Progress};
use fem_command::{Failure, Stopwatch, Timed};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use serde_json::Value;

use crate::case::Case;
use crate::failure::Raise;
use crate::watch::{Watched, watched};

/// Looks on while members run.
struct Members<'a> {
    watch: &'a Watched,
    n_members: usize,
    n_done: AtomicUsize,
    stopwatches: std::sync::Mutex<HashMap<usize, Stopwatch>>,
}

struct MemberWatch<'a>(&'a Watched);

impl Monitor for MemberWatch<'_> {
    fn report(&mut self, _: Progress) -> bool {
        !self.0.is_stopped()
    }
}

impl<'a> Observer for Members<'a> {
    type Watch = Timed<MemberWatch<'a>>;

    fn admits(&self, _: usize) -> bool {
        !self.watch.is_stopped()
    }

    fn begin(&self, _: usize) -> Self::Watch {
        Timed::since(std::time::Instant::now(), MemberWatch(self.watch))
    }

    fn end(&self, index: usize, watch: Self::Watch, _: Result<&fem::sweep::Ran, &CaseError>) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.set(n_done as f64 / self.n_members as f64);
        if let Ok(mut stopwatches) = self.stopwatches.lock() {
            stopwatches.insert(index, watch.stop().0);
        }
    }
}

/// What each case is known by, and its summary as JSON, none of a case that an interrupt left out.
type Summaries = Vec<(String, Option<String>)>;

fn run(cases: &[FemCase], n_threads: usize, watch: &Watched) -> Result<Summaries, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
    let pool = pool.map_err(|error| Failure::failed(format!("no threads to run on: {error}")))?;
    let Checked { members, left, .. } =
        pool.install(|| check(cases, |_| true, |_| false, |_, _| ()))?;
    let shared = Shared::default();
    let runner = Runner::new(cases, &shared).without_fields();
    let observer = Members {
        watch,
        n_members: left.len(),
        n_done: AtomicUsize::new(0),
        stopwatches: Default::default(),
    };
    let ran = pool.install(|| runner.run(&left, &observer, |ran| ran));
    let mut stopwatches = observer.stopwatches.into_inner().unwrap_or_default();
    let mut texts = HashMap::new();
    for (index, ran) in ran {
        let ran = ran?;
        let Some(stopwatch) = stopwatches.remove(&index) else { continue };
        if ran.collision.is_interrupted() {
            continue;
        }
        let warnings = ran.simulation.warnings(&ran.collision);
        let (spent, files) = (stopwatch.spent(), Vec::new());
        let summary = Summary::of(&ran.simulation, &ran.collision, spent, warnings, files);
        let text = serde_json::to_string(&summary);
        let text = text.map_err(|error| Failure::failed(error.to_string()))?;
        texts.insert(members[index].identity(), text);
    }
    let text = |identity: String| (identity.clone(), texts.get(&identity).cloned());
    Ok(members.iter().map(|member| text(member.identity())).collect())
}

/// Computes cases on so many threads, 0 for one a processor.
#[pyfunction]
pub fn run_members(
    py: Python<'_>,
    cases: Vec<PyRef<'_, Case>>,
    threads: usize,
    report: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Summaries, Option<PyErr>)> {
    let cases: Vec<FemCase> = cases.iter().map(|case| case.case.clone()).collect();
    let (ran, error) = watched(py, report, |watch| run(&cases, threads, watch))?;
    Ok((ran.or_raise(py)?, error))
}

/// The columns of a table of these summaries, as JSON: names and values in order.
#[pyfunction]
pub fn table_columns(summaries: Vec<String>) -> PyResult<String> {
    let broken = |error: serde_json::Error| {
        pyo3::exceptions::PyValueError::new_err(format!("no summary: {error}"))
    };
    let mut columns = Columns::default();
    let mut rows = Vec::new();
    for (index, text) in summaries.iter().enumerate() {
        let summary: Value = serde_json::from_str(text).map_err(broken)?;
        columns.see(&summary);
        let (values, numbers, identity) = (Vec::new(), Vec::new(), String::new());
        rows.push(Row { index, values, numbers, identity, summary });
    }
    let column = |name: &'static str| {
        let values: Vec<Value> = rows.iter().map(|row| row.value(name)).collect();
        (name, values)
    };
    let table: Vec<_> = columns.names().into_iter().map(column).collect();
    serde_json::to_string(&table).map_err(broken)
}

/// The name of a varied key's column in SI.
#[pyfunction]
pub fn key_column(key: &str, unit: &str) -> String {
    fem::sweep::key_column(key, unit)
}
