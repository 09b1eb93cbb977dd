//! The Python module `fem_run._native`, under what `python/fem_run` shows of it.
//!
//! Python code keeps the words that users meet; here are the classes that hold cases and collisions, and the
//! calls that compute. What computes runs on a thread of its own without Python's lock, while the calling
//! thread looks at signals and reports (`watch::watched`). Numbers go through JSON and CSV texts that read
//! back to the same bits, or as arrays.

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

/// What `fem_run` stands on.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::jobs::{
        calibrate, cradle, export, fit, invert, material_toml, materials, run_command,
    };
    #[pymodule_export]
    use crate::outcome::Outcome;
    #[pymodule_export]
    use crate::sweep::{key_column, run_members, table_columns};
}
