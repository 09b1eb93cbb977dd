//! Sweeps: many cases that differ in a few keys, computed side by side.
//!
//! ```text
//! Members ──────── check ─────────── Runner ─────────────── Row
//! a sweep file's,  a Member each,    one, or many on all    a Summary's columns,
//! Variations in    who is left,      threads; Observer      sweep.csv
//! code             in which order    reports, stops them
//! ```
//!
//! [`sweep()`] does all of it for a case and values in code. [`Members`] are a source of cases, and a [`Member`] is the
//! index and the identity of one of them. [`Runner::run_one`] runs one member, for callers with their own workers, and
//! [`Runner::run`] runs many. Nothing here reads a clock or prints.

mod check;
mod columns;
mod key_numbers;
mod members;
mod row;
mod runner;
mod variations;

pub use check::{Checked, check, check_some};
pub use columns::{Columns, column_below, column_unit, column_words, key_column};
pub use key_numbers::{KeyNumbers, NumberColumn};
pub use members::load;
pub use members::{Member, Members};
pub use row::Row;
#[cfg(feature = "files")]
pub use row::{SWEEP_FILE, sweep_csv};
pub use runner::{Observer, Runner, most_expensive_first};
pub use variations::{Variations, sweep};

pub use fem_case::Sweep;
pub use fem_data::table::COLUMNS;
