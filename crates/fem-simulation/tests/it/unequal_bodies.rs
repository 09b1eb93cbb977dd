//! Small bodies on large ones, stiff on soft: moved mass is a share of the lighter body.

use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::Simulation;

use crate::scene::simulation_of;

/// A slow steel ball on a thirty times larger rubber sphere.
const BALL: &str = r#"
    material.rubber = { density = "950 kg/m^3", youngs_modulus = "1 MPa", poissons_ratio = 0.47,
        hyperelastic = "neo-hooke" }
    material.steel = { density = "7800 kg/m^3", youngs_modulus = "200 GPa", poissons_ratio = 0.3 }
    body = [{ name = "large", sphere.diameter = "60 mm", material = "rubber" },
            { name = "small", sphere.diameter = "2 mm", material = "steel", approach_speed = "1 cm/s" }]
    output.snapshots = []"#;

/// Overrides with sizes and stiffnesses from one extreme to the other.
const SCENES: [&[&str]; 4] = [
    &[],
    &["body.1.sphere.diameter='1 mm'"],
    // The large body is the stiff one.
    &["body.0.material='steel'", "body.1.material='rubber'"],
    // Both bodies are meshed, and the large one is lighter.
    &[
        "effects.rigid_partner='off'",
        "body.1.sphere.diameter='40 mm'",
        "material.steel={density='3e4 kg/m^3', youngs_modulus='4 MPa', poissons_ratio=0.3}",
    ],
];

fn run(set: &[&[&str]]) -> (Simulation, Collision) {
    let simulation = simulation_of(BALL, &set.concat());
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// The moved mass is the allowed share of the lighter body, larger for a less compliant body, and at most that share of the
/// body's own mass.
#[test]
fn moved_mass_is_the_allowed_share() {
    for scene in SCENES {
        let (simulation, collision) = run(&[scene]);
        let allowed = simulation.setup().elements.as_ref().unwrap().plan.mass_scaling;
        let lightest = collision.bodies.iter().filter_map(|body| body.mass).reduce(f64::min);
        let compliance = simulation.case().scene().compliance_shares();
        let shares = collision.bodies.iter().zip(compliance).filter_map(|(body, compliance)| {
            let times = (0.125 / compliance).max(1.0);
            let whole = body.mass?.min(times * lightest?);
            Some(body.moved_mass? / (allowed * whole))
        });
        let share = shares.fold(0.0, f64::max);
        assert!((0.99..1.000_001).contains(&share), "{scene:?}: {share} of {allowed}");
    }
}

/// Moved mass changes no quantity by more than its error bar. With a share of the large body's mass the restitution of the
/// first two scenes would be 0.76 and 0.54 in place of 0.993.
#[test]
fn moved_mass_is_within_the_bars() {
    for scene in &SCENES[1..3] {
        let (simulation, collision) = run(&[scene]);
        let (_, without) = run(&[scene, &["time.mass_scaling=0"]]);
        assert!(without.steps > collision.steps, "{scene:?}");
        let bars = simulation.summary(&collision).uncertainty;
        for quantity in QuantityOfInterest::ALL {
            let [value, truth] = [&collision, &without].map(|it| quantity.of(it).unwrap());
            let bar = bars.of(quantity).discretisation.unwrap();
            assert!(
                (value - truth).abs() <= bar,
                "{scene:?} {}: {value} {truth} {bar}",
                quantity.name()
            );
        }
    }
}

/// A stiff half-space gets as much moved mass as the ball, which saves four fifths of the steps with the same results.
/// With a share of the ball's mass alone the step would be 1.6 times the unscaled one. The allowed change of the
/// contact time is a sixth of its bar, that of the force a fifth.
#[test]
fn a_stiff_half_space_gets_more_moved_mass() {
    let scene = [
        "body.0={ name='large', half_space={}, material='steel' }",
        "body.1={ name='small', sphere.diameter='30 mm', material='rubber', approach_speed='0.3 m/s' }",
        "material.rubber={ density=1150, youngs_modulus='100 MPa', poissons_ratio=0.47 }",
    ];
    let (_, collision) = run(&[&scene]);
    // Recorded without added mass, which takes 45,316 steps.
    assert!(5 * collision.steps.unwrap() < 45_316, "{:?}", collision.steps);
    assert!(collision.bodies[0].moved_mass > Some(0.01));
    for (quantity, truth, allowed) in [
        (QuantityOfInterest::Restitution, 0.999_818_98, 2e-4),
        (QuantityOfInterest::ContactTime, 9.081_414_8e-4, 5e-4),
        (QuantityOfInterest::PeakForce, 20.005_278_7, 1e-3),
    ] {
        let value = quantity.of(&collision).unwrap();
        assert!((value / truth - 1.0).abs() < allowed, "{}: {value} {truth}", quantity.name());
    }
}
