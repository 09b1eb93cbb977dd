//! Text on the terminal: errors, tables and the report of a run.

pub mod failure;
pub mod run_report;
pub mod standard_output;
pub mod tables;
