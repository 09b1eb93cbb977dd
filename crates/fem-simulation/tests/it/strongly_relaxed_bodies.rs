//! Strongly relaxing bodies: their results, and the effective moduli by which effects are judged.

use fem_collision::QuantityOfInterest;
use fem_simulation::Simulation;
use fem_simulation::results::Summary;

use crate::scene::simulation_of;

/// Two spheres of 10 mm that relax much faster than their contact.
const PAIR: &str = "
    material.a = { density = 1200, youngs_modulus = '10 MPa', poissons_ratio = 0.4, relaxation = { acts_on = 'all',
        terms = [{ weight = 0.999, decay_rate = 6e5 }] } }
    body = [{ name = 'lo', sphere.diameter = '10 mm', material = 'a', approach_speed = '0.1 m/s' },
            { name = 'up', sphere.diameter = '10 mm', material = 'a' }]
    output.snapshots = []";
const FLUID: &str = "material.a.relaxation.terms=[{ weight = 1.0, decay_rate = 6e4 }]";
const ELASTIC: &str = "material.a.relaxation.terms.0.weight=0";
const AS_SOFT: &str = "material.a.youngs_modulus='10 kPa'";

fn simulation(set: &[&str]) -> Simulation {
    simulation_of(PAIR, set)
}

fn run(set: &[&str]) -> Summary {
    let computed = simulation(set).run_within_tolerance(&mut ());
    let (simulation, collision) = (&computed.simulation, &computed.collision);
    simulation.summary(collision)
}

/// The pressure of a Maxwell sphere is largest while the approach is still δ = v t: on the axis
/// p = (E*/πR) ∫ e^(−β(t−s)) d(2 √(R v s)) = (2 E*/πR) √(R v/β) D(√(βt)), where Dawson's D is at most 0.54104.
/// Force and contact radius are largest much later.
#[test]
fn the_pressure_of_a_fluid_is_largest_while_the_contact_is_small() {
    let (contact_modulus, radius, speed, rate) = (0.5 * 10e6 / (1.0 - 0.16), 2.5e-3, 0.1, 6e4);
    let exact = 2.0 * contact_modulus / (std::f64::consts::PI * radius)
        * f64::sqrt(radius * speed / rate)
        * 0.541_044;
    let ting = run(&[FLUID, "model.ting={}"]).collision.peak_pressure_pa.unwrap();
    assert!((ting / exact - 1.0).abs() < 2e-3, "{ting} {exact}");
    for (set, largest) in [
        // This mesh has five elements across the contact at that time.
        (&["model.condensed.steps=8000", "mesh.contact_element_size='12 um'"][..], 0.1),
        // The planned mesh and a coarse one do not resolve it.
        (&["model.condensed={}"], f64::INFINITY),
        (&["model.condensed={}", "mesh.contact_element_size='80 um'"], f64::INFINITY),
    ] {
        let summary = run(&[set, &[FLUID]].concat());
        let pressure = summary.collision.peak_pressure_pa.unwrap();
        let bar = summary.uncertainty.of(QuantityOfInterest::PeakPressure).discretisation.unwrap();
        assert!((pressure - exact).abs() < bar, "{set:?}: {pressure} ± {bar}, {exact}");
        assert!(bar / pressure < largest, "{set:?}: {pressure} ± {bar}");
    }
}

/// Warnings about inertia and the spheres' own compliance follow from the effective moduli: they are those of equally soft
/// elastic bodies.
#[test]
fn relaxed_bodies_have_the_warnings_of_soft_ones() {
    let kinds = ["of the shear wave speed", "the spheres' own compliance adds"];
    for model in ["model.condensed={}", "model.ting={}", "model.ting.finite_size=false"] {
        let of = |set: &[&str]| {
            let warnings = run(&[set, &[model]].concat()).warnings;
            kinds.map(|kind| warnings.iter().filter(|said| said.contains(kind)).count())
        };
        let [relaxed, soft, stiff] = [of(&[]), of(&[ELASTIC, AS_SOFT]), of(&[ELASTIC])];
        assert_eq!(relaxed, soft, "{model}");
        assert_ne!(relaxed, stiff, "{model}");
    }
    // With instantaneous moduli no modes would be selected.
    let chosen = simulation(&["model.auto={}"]).resolved().model.clone().unwrap();
    let modes = chosen.condensed.and_then(|condensed| condensed.vibration_modes);
    assert!(chosen.fem.is_some() || modes.is_some_and(|modes| modes.si() == Ok(12.0)));
}

/// Error bars belong to the computed collision, not to an impact a thousand times as stiff: models agree within them, and
/// all are small shares.
#[test]
fn models_agree_within_their_bars() {
    let fem = run(&["model.fem={}"]);
    let ting = run(&["model.ting={}"]);
    for quantity in QuantityOfInterest::ALL {
        let bar = |summary: &Summary| {
            let parts = summary.uncertainty.of(quantity);
            parts.discretisation.unwrap() + parts.model.unwrap()
        };
        let [one, other] = [&fem, &ting].map(|it| it.collision.number(quantity).unwrap());
        let bars = bar(&fem) + bar(&ting);
        assert!((one - other).abs() < bars, "{quantity:?}: {one} {other} ± {bars}");
        let share = bar(&fem) / quantity.scale(one);
        // The pressure peaks while the contact is a third of an element wide.
        let is_resolved = quantity != QuantityOfInterest::PeakPressure;
        assert!(!is_resolved || share < 0.12, "{quantity:?}: {one} ± {share}");
    }
}

/// The stress for plastic flow follows from the effective moduli: a pressure of 17 kPa, where elastic bodies have 480 kPa.
#[test]
fn yield_is_judged_with_effective_moduli() {
    let reason = |set: &[&str]| {
        let effects = run(&[set, &["model.ting={}"]].concat()).effects;
        let plastic = effects.into_iter().find(|it| it.decision.name == "plastic flow").unwrap();
        plastic.decision.reason
    };
    // An elastic body is stressed 27 times as much: the peak pressure is 0.080 and 0.003 of the contact modulus.
    assert!(reason(&[]).contains("stress is lo 9.6"), "{}", reason(&[]));
    assert!(reason(&[ELASTIC]).contains("stress is lo 2"), "{}", reason(&[ELASTIC]));
}
