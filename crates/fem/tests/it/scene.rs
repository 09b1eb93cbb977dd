//! Cases from a text and overrides.

use std::path::Path;

use fem::{Case, Simulation};

/// Parses a case with overrides.
pub fn case_of<S: ToString>(text: &str, overrides: &[S]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse("case.toml", text, Path::new("."), &overrides)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Builds the model of a case with overrides.
pub fn simulation_of<S: ToString>(text: &str, overrides: &[S]) -> Simulation {
    Simulation::new(case_of(text, overrides)).unwrap_or_else(|error| panic!("{error}"))
}
