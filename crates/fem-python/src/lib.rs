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
mod failure;
mod jobs;
mod outcome;
mod sweep;
mod watch;

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
