//! Cases from outside, in one program: linked once, its tests run side by side.

mod faults;
mod flow;
mod in_code;
mod library;
mod overrides;
mod relaxation_file;
mod round_trip;
mod sweep_faults;

use std::path::Path;

use fem_case::{Case, CaseError};

/// A ball of the material "solid", which a test puts before it, on a wall.
const BALL_ON_WALL: &str = r#"
    body = [{ name = "ball", sphere.diameter = "1 cm", material = "solid", approach_speed = "1 m/s" },
            { name = "wall", wall = {} }]"#;

/// Reads a text with overrides, as from a file in a folder.
fn parse_in(folder: &Path, name: &str, text: &str, overrides: &[&str]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse(name, text, folder, &overrides)
}
