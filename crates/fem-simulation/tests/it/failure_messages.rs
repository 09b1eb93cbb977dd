//! Diagnostics of a run: time, place and size of a fault, and a remedy that helps.

use fem_collision::{Collision, Ending, StepInstant, Stop};
use fem_simulation::{Simulation, diagnose, stop_advice};

use crate::scene::{ELASTIC_GLASS as GLASS, SOFT_SPHERE as SOFT, refused_of, simulation_of};

/// A ball of steel on one of rubber: surfaces that slip, and a front of contact as fast as waves.
const SLIP: &str = "
    material.steel = { density = 7850, youngs_modulus = '210 GPa', poissons_ratio = 0.3 }
    material.rubber = { density = 1100, youngs_modulus = '5 MPa', poissons_ratio = 0.45,
        relaxation = { acts_on = 'shear', terms = [{ weight = 0.5, relaxation_time = '1 ms' }] } }
    body = [{ name = 'ball', sphere.diameter = '20 mm', material = 'steel', approach_speed = '0.5 m/s' },
            { name = 'target', sphere.diameter = '20 mm', material = 'rubber' }]
    model.fem = {}";

fn run(case: &str, overrides: &[&str]) -> (Simulation, Collision) {
    let simulation = simulation_of(case, overrides);
    let collision = simulation.run(&mut ());
    (simulation, collision)
}

/// Returns the first diagnostic message with a word in it.
fn said(case: &str, overrides: &[&str], word: &str) -> Option<String> {
    let (simulation, collision) = run(case, overrides);
    diagnose(&simulation, &collision, &simulation.estimate_errors(&collision))
        .into_iter()
        .find(|text| text.contains(word))
}

/// Returns `KEY=VALUE` from `… write KEY = VALUE` in a message.
fn written(message: &str) -> String {
    let advice = message.split("write ").nth(1).unwrap_or_else(|| panic!("{message}"));
    let advice = advice.split([',', ';']).next().unwrap();
    advice.replacen(" = ", "=", 1)
}

/// Asserts that a scene has a message with a word, and none after its remedy. Returns the message.
#[track_caller]
fn assert_helped(case: &str, overrides: &[&str], word: &str) -> String {
    let message = said(case, overrides, word).unwrap_or_else(|| panic!("no word of {word}"));
    let remedy = written(&message);
    let with = [overrides, &[&remedy]].concat();
    for word in ["scatters", "add up", "overlap"] {
        assert_eq!(said(case, &with, word), None, "{message}");
    }
    message
}

const COARSE: &str = "mesh.contact_element_size='90 um'";
/// Small elements with light nodes, between which springs ring.
const SLIPPING_FINE: &str = "mesh.contact_element_size='0.163 mm'";
const SOFT_FINE: &str = "mesh.contact_element_size='0.55 mm'";
const LITTLE_MASS: &str = "time.mass_scaling=2e-4";

#[test]
fn a_massless_boundary_is_advised_for_ringing_springs() {
    for method in ["penalty", "node_to_surface"] {
        let method = format!("contact.method='{method}'");
        let overrides = [COARSE, &method, "contact.penalty_factor=30"];
        let message = assert_helped(GLASS, &overrides, "scatters");
        for words in ["% of its peak, most about", "s (step", "massless"] {
            assert!(message.contains(words), "{message}");
        }
    }
}

/// A massless boundary does not ring on slipping surfaces at any stiffness, and is advised for springs that ring.
#[test]
fn a_massless_boundary_is_advised_for_slipping_surfaces() {
    assert_massless_is_advised("1");
}

#[test]
#[ignore = "takes many seconds"]
fn a_massless_boundary_is_advised_for_stiff_springs_on_slipping_surfaces() {
    assert_massless_is_advised("100");
}

fn assert_massless_is_advised(factor: &str) {
    let factor = format!("contact.penalty_factor={factor}");
    let fine = [factor.as_str(), SLIPPING_FINE, LITTLE_MASS];
    assert_eq!(said(SLIP, &fine, "scatters"), None);
    let springs = [&fine[..], &["contact.method='penalty'"]].concat();
    let message = assert_helped(SLIP, &springs, "scatters");
    assert_eq!(written(&message), "contact.method=\"massless\"");
}

/// Where a massless boundary is not possible, softer springs are advised and help.
#[test]
#[ignore = "26 s; .ci/run runs it"]
fn softer_springs_are_advised_without_a_massless_boundary() {
    let viscous = "effects.bulk_viscosity='on'";
    let stiff = "contact.penalty_factor=300";
    let message = assert_helped(SLIP, &[viscous, stiff, SLIPPING_FINE, LITTLE_MASS], "scatters");
    assert_eq!(written(&message), "contact.penalty_factor=1");
    for factor in [10.0, 100.0] {
        let factor = format!("contact.penalty_factor={factor}");
        let message =
            assert_helped(SOFT, &[&factor, "model.fem={}", SOFT_FINE, LITTLE_MASS], "scatters");
        assert_eq!(written(&message), "contact.penalty_factor=1");
    }
}

/// Springs that open and close within a few steps get a shorter time step and conserve energy; with the usual step they
/// gain 3e-3 to 5e-2 of it or fail.
#[test]
fn ringing_springs_conserve_energy() {
    for (method, factor) in [("penalty", 100.0), ("node_to_surface", 10.0)] {
        assert_energy_balance(method, factor, COARSE);
    }
}

/// The same with finer elements and stiffer springs.
#[test]
#[ignore = "20 s; .ci/run runs it"]
fn stiffer_springs_conserve_energy() {
    const FINE: &str = "mesh.contact_element_size='40 um'";
    for (method, factor, mesh) in [
        ("penalty", 100.0, FINE),
        ("node_to_surface", 10.0, FINE),
        ("node_to_surface", 300.0, FINE),
        ("node_to_surface", 300.0, COARSE),
    ] {
        assert_energy_balance(method, factor, mesh);
    }
}

/// Asserts the energy balance to the tolerance of the claim on hard scenes.
fn assert_energy_balance(method: &str, factor: f64, mesh: &str) {
    let set = [format!("contact.method='{method}'"), format!("contact.penalty_factor={factor}")];
    let (_, collision) = run(GLASS, &[mesh, LITTLE_MASS, &set[0], &set[1]]);
    assert_eq!(collision.stop(), None);
    assert!(collision.residual_relative.unwrap() < 1e-3, "{set:?} {mesh}");
    assert!(collision.restitution.unwrap() < 1.0 + 1e-5, "{set:?} {mesh}");
}

/// An energy residual is reported with its time. No scene is known that has one, so a residual is added to a valid result.
#[test]
fn an_energy_residual_is_reported_with_its_time() {
    let (simulation, mut collision) = run(GLASS, &[COARSE, "contact.method='penalty'"]);
    let about_energy = |collision: &Collision| {
        let messages = diagnose(&simulation, collision, &simulation.estimate_errors(collision));
        messages.into_iter().find(|text| text.contains("energy balance"))
    };
    assert_eq!(about_energy(&collision), None);
    let since = StepInstant { time: 20e-6, step: 1000 };
    (collision.residual_relative, collision.residual_since) = (Some(2e-3), Some(since));
    let message = about_energy(&collision).unwrap();
    assert!(message.contains(&format!("2.0e-3 of the initial energy since {since} (limit 1e-3)")));
    assert_eq!(written(&message), "contact.method=\"massless\"");
}

#[test]
fn stiffer_springs_are_advised_for_soft_ones() {
    for factor in [0.02, 0.1] {
        let factor = format!("contact.penalty_factor={factor}");
        let message = assert_helped(GLASS, &[COARSE, &factor], "overlap");
        assert!(message.contains("% of an element, deepest "), "{message}");
        // The deepest overlap is near the axis at the largest force.
        let (_, collision) = run(GLASS, &[COARSE, &factor]);
        let deepest_overlap = collision.deepest_overlap.unwrap();
        assert!(message.contains(&deepest_overlap.to_string()), "{message}");
        let [first, last] = [collision.first_contact, collision.last_contact].map(Option::unwrap);
        let late = (deepest_overlap.at.time - 0.5 * (first + last)).abs() / (last - first);
        assert!(late < 0.1, "{deepest_overlap}");
        let most = 0.3 * collision.max_contact_radius.unwrap();
        assert!(deepest_overlap.radius < most, "{deepest_overlap}");
        // F = k ∫ overlap dA, of a paraboloid at most twice its mean.
        let most = 0.5 * collision.max_approach.unwrap();
        assert!(deepest_overlap.overlap < most, "{deepest_overlap}");
    }
}

/// A run that a limit stops completes if the limit is raised, as its advice says.
#[test]
fn a_raised_limit_lets_the_run_complete() {
    let fluid = "material.glass.relaxation={acts_on='all', terms=[{weight=0.995, relaxation_time='0.3 us'}]}";
    let mesh = ["mesh.contact_element_size='0.2 mm'", "mesh.refined_radius='0.6 mm'", fluid];
    let simulation = run(GLASS, &mesh).0;
    let request = simulation.request().clone();
    let simulation = simulation
        .with_output_request(fem_collision::OutputRequest {
            most_element_updates: 100_000,
            ..request
        })
        .unwrap();
    let collision = simulation.run(&mut ());
    let stop = collision.stop().expect("a stop");
    assert!(matches!(stop, Stop::TooManyUpdates { .. }), "{stop}");
    let most = 2 * collision.bodies[0].elements.unwrap() as u64 + 1000;
    assert!((100_000..100_000 + most).contains(&collision.element_updates.unwrap()));
    assert!(!simulation.summary(&collision).complete);
    assert!(stop_advice(stop).unwrap().remedy.starts_with("raise limits.element_updates"));
    assert_eq!(run(GLASS, &mesh).1.stop(), None);
}

/// A rejection names the setting that makes a run too long or a mesh too fine.
#[test]
fn an_extreme_setting_is_named() {
    for (key, value) in [
        ("mesh.growth", "1.0000001"),
        ("mesh.growth", "1.00001"),
        ("time.step_factor", "1e-7"),
        ("contact.penalty_factor", "1e-300"),
        ("contact.penalty_factor", "1e-200"),
        ("contact.penalty_factor", "1e300"),
    ] {
        let error = refused_of(GLASS, &[format!("{key}={value}")]).to_string();
        assert!(error.contains(key), "{key}={value}: {error}");
        assert!(error.contains("leave it out"), "{key}={value}: {error}");
    }
}

/// A mass that is not finite is blamed on the density or diameter, not on the body as a whole.
#[test]
fn an_extreme_mass_names_its_cause() {
    for (set, key, words) in [
        ("material.glass.density=1e-300", "body.0.material", "density is 1e-300 kg/m^3"),
        ("body.0.sphere.diameter=1e-110", "body.0.sphere.diameter", "diameter is 1e-110 m"),
    ] {
        let error = refused_of(GLASS, &[set]);
        assert_eq!(error.key(), Some(key), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

/// A run that ends with NaN reports the cause once, without messages that follow from it.
#[test]
fn the_cause_of_a_failure_is_reported_once() {
    let (simulation, mut collision) = run(GLASS, &["model={ condensed = {} }"]);
    collision.ending = Ending::Stopped(Stop::NoNumber {
        at: StepInstant { time: 1e-5, step: 7 },
        body: 0,
        node: 3,
        place: [0.0, 0.0],
    });
    collision.residual_relative = Some(f64::NAN);
    collision.momentum_residual_relative = Some(f64::NAN);
    let warnings = simulation.summary(&collision).warnings;
    let of = |word: &str| warnings.iter().filter(|text| text.contains(word)).count();
    let counts = ["is not a number", "add up", "NaN", "not finite"].map(of);
    assert_eq!(counts, [1, 0, 0, 1], "{warnings:?}");
}
