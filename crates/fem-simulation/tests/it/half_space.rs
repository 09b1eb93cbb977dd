//! A ball on a half-space.

use fem_collision::Collision;
use fem_simulation::Simulation;

use crate::scene::{collision_of, resolved, simulation_of};

const BALL: &str = r#"
    material.steel = { density = "7850 kg/m^3", youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
    material.polymer = { density = "1200 kg/m^3", youngs_modulus = "3 GPa", poissons_ratio = 0.4 }
    body = [{ name = "block", half_space = {}, material = "polymer" },
            { name = "ball", sphere.diameter = "10 mm", material = "steel", approach_speed = "0.1 m/s" }]"#;

const FINE: &str = "accuracy.tolerance='0.3 %'";

fn simulation(set: &[&str]) -> Simulation {
    simulation_of(BALL, set)
}

fn run(set: &[&str]) -> Collision {
    collision_of(BALL, set)
}

/// Hertz by hand: R* is the ball's radius, m* its mass, 1/E* = 0.91/210 GPa + 0.84/3 GPa.
#[test]
fn the_contact_time_is_that_of_hertz() {
    let contact_modulus: f64 = (0.91 / 210e9 + 0.84 / 3e9f64).recip();
    let (radius, speed) = (5e-3f64, 0.1f64);
    let mass = 7850.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    let time = 2.868_265 * (mass * mass / (radius * contact_modulus.powi(2) * speed)).powf(0.2);
    for model in ["model.hertz={}", "model.ting={}", "model.law.hertz={}"] {
        // Radiated waves would lengthen the contact by 2e-4, and surface slip would shorten it by 1e-3.
        let off = "effects={ partner_waves = 'off', surface_slip = 'off' }";
        let found = run(&[model, off]).contact_time.unwrap();
        assert!((found / time - 1.0).abs() < 1e-5, "{model}: {found:e} {time:e}");
    }
}

/// The contact time of elements on a half-space is that of Hertz with the sphere's own compliance, within the
/// discretisation error.
#[test]
fn the_contact_time_of_elements_is_that_of_hertz() {
    // A ball of the same material allows long time steps.
    let soft = "body.1.material='polymer'";
    let time = run(&["model.hertz.finite_size=true", soft]).contact_time.unwrap();
    for model in ["model.condensed={}", "model.fem={}"] {
        let simulation = simulation(&[model, soft, "output.snapshots=['maximum']", FINE]);
        let found = simulation.run(&mut ());
        let ratio = found.contact_time.unwrap() / time;
        assert!((ratio - 1.0).abs() < 2e-3, "{model}: {ratio}");
        assert!(found.bodies[0].elements.unwrap() > 300, "{model}");
        let [block, _] = simulation.model().meshes();
        assert_eq!(found.snapshots[0].bodies[0].displacement.len(), block.unwrap().nodes().len());
        assert_eq!(resolved(&simulation).run(&mut ()), found, "{model}");
    }
}
