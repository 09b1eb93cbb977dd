//! Sweeps: many cases computed in parallel.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use fem::ComputedCollision;
use fem::sweep::{Checked, Columns, Member, Observer, Row, Runner, check};
use fem::{Case as FemCase, CaseError, SharedModels};
use fem_collision::{Monitor, Progress};
use fem_command::{Failure, Timed};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use serde_json::Value;

use crate::OrRaise;
use crate::case::Case;
use crate::watch::{WatchState, watched};

/// Time that stopped members get to end; their results so far are returned in any case.
const GRACE: Duration = Duration::from_secs(1);

/// Results so far, for a caller that does not wait for the end.
#[derive(Default)]
struct PartialResults {
    /// Identity of each case.
    identities: Mutex<Vec<String>>,
    /// Summaries as JSON, by identity.
    texts: Mutex<HashMap<String, String>>,
}

/// The observer of the members of a sweep.
struct MemberObserver<'a> {
    watch: &'a WatchState,
    members: &'a [Member],
    n_members: usize,
    n_done: AtomicUsize,
    found: &'a PartialResults,
    failure: Mutex<Option<Failure>>,
}

struct MemberWatch<'a>(&'a WatchState);

impl Monitor for MemberWatch<'_> {
    fn report(&mut self, _: Progress) -> bool {
        !self.0.is_stopped()
    }
}

impl<'a> Observer for MemberObserver<'a> {
    type Watch = Timed<MemberWatch<'a>>;

    fn admits(&self, _: usize) -> bool {
        !self.watch.is_stopped() && locked(&self.failure).is_none()
    }

    fn begin(&self, _: usize) -> Self::Watch {
        Timed::since(Instant::now(), MemberWatch(self.watch))
    }

    fn end(&self, index: usize, watch: Self::Watch, ran: Result<&ComputedCollision, &CaseError>) {
        let n_done = self.n_done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.set(n_done as f64 / self.n_members as f64);
        let text = match ran {
            Ok(ran) if ran.collision.is_interrupted() => return,
            Ok(ran) => serde_json::to_string(&watch.stop().0.summary(ran, Vec::new()))
                .map_err(|error| Failure::failed(error.to_string())),
            Err(error) => Err(error.clone().into()),
        };
        match text {
            Ok(text) => {
                locked(&self.found.texts).insert(self.members[index].identity(), text);
            }
            Err(failure) => {
                locked(&self.failure).get_or_insert(failure);
            }
        }
    }
}

/// Locks a mutex. Its holder may have panicked, but its content is always valid.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn run(
    cases: &[FemCase],
    n_threads: usize,
    watch: &WatchState,
    found: &PartialResults,
) -> Result<(), Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build();
    let pool = pool.map_err(|error| Failure::failed(format!("no threads to run on: {error}")))?;
    let Checked { members, left, .. } =
        pool.install(|| check(cases, |_| true, |_| false, |_, _| ()))?;
    *locked(&found.identities) = members.iter().map(Member::identity).collect();
    let shared = SharedModels::default();
    let runner = Runner::new(cases, &shared).without_fields();
    let observer = MemberObserver {
        watch,
        members: &members,
        n_members: left.len(),
        n_done: AtomicUsize::new(0),
        found,
        failure: Mutex::default(),
    };
    pool.install(|| runner.run_all(&left, &observer));
    let failure = observer.failure.into_inner().unwrap_or_else(PoisonError::into_inner);
    failure.map_or(Ok(()), Err)
}

/// Identity and JSON summary of each case; `None` for a case that an interrupt left out.
type Summaries = Vec<(String, Option<String>)>;

/// Computes cases on `threads` threads, 0 for one per processor. An early end is returned with the
/// results until then, which are empty if it came before all cases were checked.
#[pyfunction]
pub fn run_members(
    py: Python<'_>,
    cases: Vec<PyRef<'_, Case>>,
    threads: usize,
    report: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Summaries, Option<PyErr>)> {
    let cases: Vec<FemCase> = cases.iter().map(|case| case.case.clone()).collect();
    let found = Arc::new(PartialResults::default());
    let own = Arc::clone(&found);
    let work = move |watch: &WatchState| run(&cases, threads, watch, &own);
    let (ran, error) = watched(py, report, GRACE, work)?;
    if let Some(ran) = ran {
        ran.or_raise(py)?;
    }
    let identities = std::mem::take(&mut *locked(&found.identities));
    let texts = std::mem::take(&mut *locked(&found.texts));
    let text = |identity: String| (identity.clone(), texts.get(&identity).cloned());
    Ok((identities.into_iter().map(text).collect(), error))
}

/// Returns the columns of a table of these summaries as JSON: names and values, in order.
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

/// Returns the name of a varied key's column in SI.
#[pyfunction]
pub fn key_column(key: &str, unit: &str) -> String {
    fem::sweep::key_column(key, unit)
}
