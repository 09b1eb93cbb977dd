//! The glass pair on a coarse mesh, by any method.

use std::path::Path;

use fem::{Case, Simulation};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
/// A mesh for all approaches.
const MESH: [&str; 2] = ["mesh.contact_element_size='0.1 mm'", "mesh.refined_radius='0.4 mm'"];

/// Returns the simulation of a case with overrides.
pub fn simulation_of(text: &str, overrides: &[&str]) -> Simulation {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let case = Case::parse("case.toml", text, Path::new("."), &overrides).unwrap();
    Simulation::new(case).unwrap()
}

/// Returns the pair with a method and more overrides, which may name another model.
pub fn simulation(method: &str, more: &[&str]) -> Simulation {
    Simulation::new(case(method, more)).unwrap()
}

/// Returns the message of a rejected pair.
pub fn refused(method: &str, more: &[&str]) -> String {
    Simulation::new(case(method, more)).unwrap_err().to_string()
}

fn case(method: &str, more: &[&str]) -> Case {
    let model = match method {
        "law" => "model.law.falcon.c=300".to_string(),
        name => format!("model.{name}={{}}"),
    };
    let overrides = [model].into_iter();
    let overrides: Vec<String> =
        overrides.chain(MESH.iter().chain(more).map(ToString::to_string)).collect();
    Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap()
}
