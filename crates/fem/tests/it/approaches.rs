//! A model computes its bodies at any approach; what it gives does not depend on what came before.

use std::path::Path;

use fem::{Approach, Case, Collision, METHODS, Simulation, Want};
use serde_json::Value;

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
/// A mesh that serves both approaches.
const COARSE: [&str; 2] = ["mesh.contact_element_size='0.1 mm'", "mesh.refined_radius='0.4 mm'"];

fn simulation(method: &str, more: &[&str]) -> Simulation {
    let model = match method {
        "law" => "model.law.falcon.c=300".to_string(),
        name => format!("model.{name}={{}}"),
    };
    let overrides = COARSE.iter().chain(more).map(ToString::to_string).chain([model]).collect();
    let overrides: Vec<String> = overrides;
    Simulation::new(Case::parse("glass.toml", GLASS, Path::new("."), &overrides).unwrap()).unwrap()
}

/// So fast that the contact leaves the region in which it is looked for at first.
fn fast() -> Approach {
    Approach::new([4.0, -2.0], 2e-6).unwrap()
}

/// All of a collision but its fields.
fn plain(collision: &Collision) -> Collision {
    Collision { snapshots: Vec::new(), ..collision.clone() }
}

#[test]
fn a_collision_does_not_depend_on_those_before_it() {
    for method in METHODS {
        let simulation = simulation(method.name(), &[]);
        let model = simulation.model();
        let (own, want) = (simulation.setup().approach, Want::history());
        let collide = |approach: &Approach| plain(&model.collide(approach, &want, &mut ()));
        let first = collide(&own);
        let between = collide(&fast());
        assert_eq!((first.approach, between.approach), (own, fast()));
        if let (Some(small), Some(large)) = (first.searched, between.searched) {
            assert!(large.radius > 1.4 * small.radius, "{}", method.name());
        }
        assert!(first.is_complete() && between.is_complete(), "{}", method.name());
        assert_eq!(collide(&own), first, "{}", method.name());
        assert_eq!(collide(&fast()), between, "{}", method.name());
    }
}

/// What is said of a collision at another approach is said of it, not of the scene's own.
#[test]
fn a_summary_is_of_the_collision_that_was_computed() {
    let meeting = ["body.0.approach_speed=4", "body.1.approach_speed=2", "start.gap='2 um'"];
    for method in METHODS {
        let slow = simulation(method.name(), &[]);
        let collision = slow.model().collide(&fast(), &Want::history(), &mut ());
        let found = serde_json::to_value(slow.summary(&collision)).unwrap();
        let other = simulation(method.name(), &meeting);
        let expected = serde_json::to_value(other.summary(&other.run(&mut ()))).unwrap();
        let velocities = |summary: &Value| {
            [0, 1].map(|side: usize| summary["bodies"][side]["velocity_before_m_s"].clone())
        };
        assert_eq!(velocities(&found), velocities(&expected));
        for key in ["hertz", "restitution"] {
            if key == "hertz" || !["fem", "condensed"].contains(&method.name()) {
                assert_eq!(found[key], expected[key], "{} {key}", method.name());
            }
        }
        for key in ["body", "start"] {
            assert_eq!(found["case"][key], expected["case"][key], "{} {key}", method.name());
        }
        // What the speed alone decides on.
        for name in ["finite strain", "vibration", "viscoelasticity"] {
            let of = |summary: &Value| {
                let effects = summary["effects"].as_array().unwrap();
                effects.iter().find(|effect| effect["name"] == name).cloned()
            };
            assert_eq!(of(&found), of(&expected), "{} {name}", method.name());
        }
        assert!(slow.warnings(&collision).iter().any(|warning| warning.contains("small-strain")));
    }
}
