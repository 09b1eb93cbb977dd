//! Sweeps: many cases that differ in a few keys, computed side by side.
//!
//! ```text
//! Members ──────── check ─────────── Runner ─────────────── Row
//! a sweep file's,  a Member each,    one, or many on all    a Summary's columns,
//! Variations in    who is left,      threads; Observer      sweep.csv
//! code             dearest first     looks on, ends them
//! ```
//!
//! [`sweep()`] is all of it for a case and values in code. A member is a place in a source of
//! [`Members`] and what is known of the case that the source makes there; [`Runner::run_one`] runs one, for whoever
//! has workers of their own, and [`Runner::run`] runs many. Nothing here reads a clock or prints.

mod check;
mod columns;
mod expense;
mod identity;
mod in_code;
mod key_numbers;
#[cfg(feature = "csv")]
mod load;
mod members;
mod observer;
mod order;
mod row;
mod runner;
#[cfg(feature = "files")]
mod table;
mod variations;

pub use check::{Checked, check, check_some};
pub use columns::{COLUMNS, Columns, column_unit, column_words, columns, key_column};
pub use identity::Member;
pub use in_code::sweep;
pub use key_numbers::{KeyNumbers, NumberColumn};
#[cfg(feature = "csv")]
pub use load::load;
pub use members::Members;
pub use observer::Observer;
pub use order::dearest_first;
pub use row::Row;
pub use runner::Runner;
#[cfg(feature = "files")]
pub use table::{SWEEP_FILE, sweep_csv};
pub use variations::Variations;

pub use fem_case::Sweep;
