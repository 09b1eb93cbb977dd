//! Cases from a text and overrides, and the glass pair on a coarse mesh.

use std::path::Path;

use fem_case::{Case, CaseError};
use fem_collision::Collision;
use fem_simulation::Simulation;
use fem_simulation::effects::EffectDecision;
use fem_simulation::results::Summary;

pub const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
pub const ELASTIC_GLASS: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
pub const THREE_BOUNCES: &str = include_str!("../../../../cases/three_bounces.toml");
pub const SOFT_SPHERE: &str = include_str!("../../../../cases/soft_sphere.toml");
pub const RUBBER_BALL: &str = include_str!("rubber_ball.toml");

/// A steel ball that yields from 35 mm/s on and falls twice, on a coarse mesh. It needs a spot.
pub const DENTED_BALL: &str = r#"
    material.steel = { density = 7850, youngs_modulus = "210 GPa", poissons_ratio = 0.3, flow.yield_strength = "1 GPa" }
    body = [{ name = "floor", wall = {} },
            { name = "ball", sphere.diameter = "10 mm", material = "steel", approach_speed = "1 m/s" }]
    gravity.acceleration = 9.81
    stop.bounces = 2
    accuracy.tolerance = "5 %"
    model.fem = {}"#;

pub fn parse<S: ToString>(text: &str, overrides: &[S]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Case::parse("case.toml", text, Path::new("."), &overrides)
}

pub fn case_of<S: ToString>(text: &str, overrides: &[S]) -> Case {
    parse(text, overrides).unwrap_or_else(|error| panic!("{error}"))
}

pub fn simulation_of<S: ToString>(text: &str, overrides: &[S]) -> Simulation {
    Simulation::new(case_of(text, overrides)).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the error of a case whose model is rejected.
pub fn refused_of<S: ToString>(text: &str, overrides: &[S]) -> CaseError {
    Simulation::new(case_of(text, overrides)).expect_err("a rejected case")
}

pub fn collision_of<S: ToString>(text: &str, overrides: &[S]) -> Collision {
    simulation_of(text, overrides).run(&mut ())
}

pub fn summary_of<S: ToString>(text: &str, overrides: &[S]) -> Summary {
    let simulation = simulation_of(text, overrides);
    simulation.summary(&simulation.run(&mut ()))
}

/// Returns the simulation of the resolved case, read from its text.
pub fn resolved(simulation: &Simulation) -> Simulation {
    simulation_of::<&str>(&simulation.resolved().to_toml().unwrap(), &[])
}

/// Returns the decision on an effect.
pub fn decision_on<'a>(simulation: &'a Simulation, effect: &str) -> &'a EffectDecision {
    let decisions = &simulation.setup().decisions.all;
    decisions.iter().find(|decision| decision.name == effect).unwrap()
}

/// Returns the glass pair by a method on a mesh for all approaches, with more overrides, which may name another model.
pub fn coarse_glass(method: &str, more: &[&str]) -> Simulation {
    simulation_of(GLASS, &coarse(method, more))
}

/// Returns the message of a rejected pair.
pub fn refused(method: &str, more: &[&str]) -> String {
    refused_of(GLASS, &coarse(method, more)).to_string()
}

fn coarse(method: &str, more: &[&str]) -> Vec<String> {
    let model = match method {
        "law" => "model.law.falcon.c=300".to_string(),
        name => format!("model.{name}={{}}"),
    };
    let mesh = ["mesh.contact_element_size='0.1 mm'", "mesh.refined_radius='0.4 mm'"];
    [model].into_iter().chain(mesh.iter().chain(more).map(ToString::to_string)).collect()
}
