//! The command as its users call it, in one program: linked once, its tests run side by side.

mod accuracy;
mod bad_input;
mod bounces;
mod common;
mod cost_estimate;
mod folders;
mod laws;
mod models;
mod one_number;
mod sweeps;
mod texts;
mod validate;
mod workspace_structure;

/// The program that these tests run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_fem-run");
