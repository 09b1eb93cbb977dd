//! Text on the terminal: errors, tables and the report of a run.

pub mod failure;
pub mod run_report;
pub mod standard_output;
pub mod tables;

pub use failure::Failure;
pub use standard_output::{one_line, shown};
pub use tables::{
    hanging, headed, mesh_table, pairs, show_measured, show_value, table, wrapped, wrapped_at,
};
