//! The program of the claims as its users call it.

mod claims;
#[path = "../../../crates/fem-run/tests/it/common/mod.rs"]
mod common;

/// The program that these tests run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_fem-validate");
