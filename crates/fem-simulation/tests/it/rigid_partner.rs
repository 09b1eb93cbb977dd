//! A very stiff partner is computed as a rigid one.

use fem_case::CaseError;
use fem_collision::Collision;
use fem_simulation::Simulation;
use fem_simulation::effects::EffectDecision;

use crate::scene::{case_of, collision_of};

/// A soft relaxing ball and a steel one, with a ratio of stiffness of 1 to 4e4.
const SOFT: &str = r#"
    material.gel = { density = "1050 kg/m^3", youngs_modulus = "5 MPa", poissons_ratio = 0.3,
        relaxation = { acts_on = "all", terms = [{ weight = 0.3, relaxation_time = "1 ms" }] } }
    material.steel = { density = "7850 kg/m^3", youngs_modulus = "210 GPa", poissons_ratio = 0.3 }
    body = [{ name = "anvil", sphere.diameter = "30 mm", material = "steel" },
            { name = "ball", sphere.diameter = "20 mm", material = "gel", approach_speed = "0.2 m/s" }]
    output.snapshots = []"#;

const MODELS: [&str; 3] = ["model.fem={}", "model.condensed={}", "model.ting={}"];

fn simulation(set: &[&str]) -> Result<Simulation, CaseError> {
    Simulation::new(case_of(SOFT, set))
}

fn run(set: &[&str]) -> Collision {
    collision_of(SOFT, set)
}

fn decision_on(simulation: &Simulation) -> &EffectDecision {
    crate::scene::decision_on(simulation, "rigid partner")
}

/// The compliance of the partner is 2.4e-5 of the whole, which changes the contact time by 1e-5: the results stay.
#[test]
fn a_very_stiff_partner_is_rigid_with_the_same_results() {
    for model in MODELS {
        let set = [model, "mesh.contact_element_size='0.3 mm'"];
        let plain = simulation(&set).unwrap();
        let is_rigid = decision_on(&plain);
        assert!(is_rigid.active && is_rigid.reason.contains("anvil"), "{}", is_rigid.reason);
        let warnings = plain.setup().warnings().join("\n");
        assert!(!warnings.contains("rigid"), "{warnings}");
        let whole = run(&[set[0], set[1], "effects.rigid_partner='off'"]);
        let rigid = plain.run(&mut ());
        // Explicit runs have three elements across the contact, and springs between two meshes or on one.
        let is_coarse = model == MODELS[0];
        let close = |a: Option<f64>, b: Option<f64>, coarse: f64, what: &str| {
            let change = a.unwrap() / b.unwrap() - 1.0;
            let allowed = if is_coarse { coarse } else { 5e-4 };
            assert!(change.abs() < allowed, "{model}: {what} {change:e}");
        };
        close(rigid.restitution, whole.restitution, 2e-3, "e");
        close(rigid.contact_time, whole.contact_time, 5e-3, "T");
        close(rigid.peak_force, whole.peak_force, 1.5e-2, "F");
        let [ours, theirs] = [&rigid, &whole].map(|c| c.bodies[0].mass.unwrap());
        assert!((ours / theirs - 1.0).abs() < 1e-14, "{model}: {ours:e} {theirs:e}");
        let [ours, theirs] = [&rigid, &whole].map(|c| c.bodies[0].velocity_after);
        close(ours, theirs, 2e-3, "velocity of the anvil");
        if model == MODELS[0] {
            let updates = |collision: &Collision| collision.element_updates.unwrap();
            // Elements of steel make the time step 30 times shorter.
            assert!(10 * updates(&rigid) < updates(&whole), "{}", updates(&rigid));
        }
    }
}

/// A warning reports a partner that is forced to be rigid, and its estimate of the change is right.
#[test]
fn a_forced_rigid_partner_changes_the_results_as_estimated() {
    for model in MODELS {
        let stiff = "material.steel.youngs_modulus='200 MPa'";
        // Without viscosity elements ring by 2 % of the peak force.
        let smooth = match model {
            "model.fem={}" => "effects.bulk_viscosity='on'",
            _ => "effects.bulk_viscosity='auto'",
        };
        let set = [model, stiff, "mesh.contact_element_size='0.3 mm'", smooth];
        assert!(!decision_on(&simulation(&set).unwrap()).active);
        let on = "effects.rigid_partner='on'";
        let forced = simulation(&[set[0], set[1], set[2], set[3], on]).unwrap();
        let warnings = forced.setup().warnings().join("\n");
        assert!(warnings.contains("forced to be rigid"), "{model}: {warnings}");
        let setup = forced.setup();
        let estimated = forced.neglect_error(decision_on(&forced), &setup.estimate).unwrap();
        let (rigid, whole) = (forced.run(&mut ()), run(&set));
        let found = (rigid.contact_time.unwrap() - whole.contact_time.unwrap()).abs();
        let ratio = found / estimated.contact_time_s.unwrap();
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{model}: T {ratio}");
        let found = (rigid.peak_force.unwrap() - whole.peak_force.unwrap()).abs();
        let ratio = found / estimated.peak_force_n.unwrap();
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{model}: F {ratio}");
    }
}

#[test]
fn switches_that_contradict_the_scene_are_refused() {
    let wall = ["body.0={ name = 'floor', wall = {} }", "effects.rigid_partner='on'"];
    let error = simulation(&wall).unwrap_err();
    assert_eq!(error.key(), Some("effects.rigid_partner"));
    assert!(error.message().contains("a wall already"), "{error}");
    let both = ["effects.rigid_partner='on'", "effects.mirror_symmetry='on'"];
    let error = simulation(&both).unwrap_err();
    assert!(error.message().contains("both \"on\""), "{error}");
}

/// A steel ball on a soft half-space, and a soft ball on a held steel one, have a rigid partner, and elements and condensed
/// bodies agree.
#[test]
fn rigid_balls_on_a_half_space_and_held_ones() {
    const BLOCK: &str = "body.0={name='block', half_space={}, material='gel'}";
    const BALL: [&str; 2] = ["body.1.sphere.diameter='5 mm'", "body.1.material='steel'"];
    const HELD: [&str; 2] = ["body.0.held=true", "gravity.acceleration=9.81"];
    for scene in [[BLOCK, BALL[0], BALL[1]], [HELD[0], HELD[1], "start.gap=0"]] {
        let [fem, condensed] = ["model.fem={}", "model.condensed={}"].map(|model| {
            let set: Vec<&str> = scene.into_iter().chain([model]).collect();
            let simulation = simulation(&set).unwrap();
            assert!(decision_on(&simulation).active, "{scene:?}");
            simulation.run(&mut ())
        });
        assert!(fem.is_complete(), "{scene:?}: {:?}", fem.ending);
        let change = fem.restitution.unwrap() - condensed.restitution.unwrap();
        assert!(change.abs() < 0.02, "{scene:?}: {change:e}");
        assert!(fem.residual_relative.unwrap() < 1e-3, "{:?}", fem.residual_relative);
    }
}

/// Moved mass is a share of the lighter body. For a ball of 2 mm on a sphere of 60 mm, a share of the sphere would be
/// sixteen times the ball.
#[test]
fn moved_mass_is_a_share_of_a_small_rigid_ball() {
    let set = |model| {
        let body = |name, diameter, material, speed| {
            format!(
                "{{name='{name}', sphere={{diameter='{diameter}'}}, material='{material}', \
                 approach_speed={speed}}}"
            )
        };
        let bodies =
            [body("anvil", "60 mm", "rubber", 0.01), body("ball", "2 mm", "steel", 0.0)].join(",");
        let rubber = "material.rubber={density=950, youngs_modulus=1e6, poissons_ratio=0.47}";
        run(&[model, rubber, &format!("body=[{bodies}]")])
    };
    let [explicit, condensed] = [set("model.fem={}"), set("model.condensed={}")];
    let added = explicit.bodies[0].moved_mass.unwrap();
    assert!(added < 0.0051 * explicit.bodies[1].mass.unwrap(), "{added:e}");
    // The values are 0.9928 and 0.9925. With a share of the sphere's mass it was 0.7601, and the contact 14 % longer.
    let difference = explicit.restitution.unwrap() - condensed.restitution.unwrap();
    assert!(difference.abs() < 1e-3, "{difference:e}");
    let difference = explicit.contact_time.unwrap() / condensed.contact_time.unwrap() - 1.0;
    assert!(difference.abs() < 1e-2, "{difference:e}");
}
