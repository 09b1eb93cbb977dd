//! Bodies that relax to little: what is read of them, and what they are judged by.

use std::path::Path;

use fem::results::Summary;
use fem::{Case, QuantityOfInterest, Simulation};

/// Two spheres of 10 mm that relax in no time beside the contact they have in the end.
const PAIR: &str = "
[material.a]
density = 1200
youngs_modulus = '10 MPa'
poissons_ratio = 0.4
[material.a.relaxation]
acts_on = 'all'
terms = [{ weight = 0.999, decay_rate = 6e5 }]
[[body]]
name = 'lo'
sphere = { diameter = '10 mm' }
material = 'a'
approach_speed = '0.1 m/s'
[[body]]
name = 'up'
sphere = { diameter = '10 mm' }
material = 'a'
[output]
snapshots = []
";
const FLUID: &str = "material.a.relaxation.terms=[{ weight = 1.0, decay_rate = 6e4 }]";
const ELASTIC: &str = "material.a.relaxation.terms.0.weight=0";
const AS_SOFT: &str = "material.a.youngs_modulus='10 kPa'";

fn simulation(set: &[&str]) -> Simulation {
    let set: Vec<String> = set.iter().map(ToString::to_string).collect();
    let case = Case::parse("pair.toml", PAIR, Path::new("."), &set).unwrap();
    Simulation::new(case).unwrap()
}

fn run(set: &[&str]) -> Summary {
    let computed = simulation(set).run_within_tolerance(&mut ());
    let (simulation, collision) = (&computed.simulation, &computed.collision);
    simulation.summary(collision)
}

/// A Maxwell sphere presses hardest while the approach is v t, δ = v t and F = K δ^(3/2) with E e^(−βt): on the axis
/// p = (E*/πR) ∫ e^(−β(t−s)) d(2 √(R v s)) = (2 E*/πR) √(R v/β) D(√(βt)), of which Dawson's D is 0.54104 at most.
/// Far below are the largest force and the largest contact.
#[test]
fn the_pressure_of_a_fluid_is_largest_while_the_contact_is_small() {
    let (contact_modulus, radius, speed, rate) = (0.5 * 10e6 / (1.0 - 0.16), 2.5e-3, 0.1, 6e4);
    let exact = 2.0 * contact_modulus / (std::f64::consts::PI * radius)
        * f64::sqrt(radius * speed / rate)
        * 0.541_044;
    let ting = run(&[FLUID, "model.ting={}"]).collision.peak_pressure_pa.unwrap();
    assert!((ting / exact - 1.0).abs() < 2e-3, "{ting} {exact}");
    for (set, largest) in [
        // Five elements across the contact of that time.
        (&["model.condensed.steps=8000", "mesh.contact_element_size='12 um'"][..], 0.1),
        // As the plan has it, and as coarse as nothing of it is seen.
        (&["model.condensed={}"], f64::INFINITY),
        (&["model.condensed={}", "mesh.contact_element_size='80 um'"], f64::INFINITY),
    ] {
        let summary = run(&[set, &[FLUID]].concat());
        let told = summary.collision.peak_pressure_pa.unwrap();
        let off =
            summary.uncertainty.parts(QuantityOfInterest::PeakPressure).discretisation.unwrap();
        assert!((told - exact).abs() < off, "{set:?}: {told} ± {off}, {exact}");
        assert!(off / told < largest, "{set:?}: {told} ± {off}");
    }
}

/// What inertia and the spheres' own compliance are worth is judged by what is left of the moduli: the words are those
/// of elastic bodies that are as soft.
#[test]
fn bodies_that_have_relaxed_are_warned_of_as_soft_ones_are() {
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
    // Of instantaneous moduli no vibration is worth a mode.
    let chosen = simulation(&["model.auto={}"]).resolved().model.clone().unwrap();
    let modes = chosen.condensed.and_then(|condensed| condensed.vibration_modes);
    assert!(chosen.fem.is_some() || modes.is_some_and(|modes| modes.si() == Ok(12.0)));
}

/// Error bars are those of the collision as it is, not of an impact a thousand times as stiff: none is missing, models
/// are within them, and the force's is a share of the force.
#[test]
fn model_bars_are_of_the_collision_as_it_is() {
    let fem = run(&["model.fem={}"]);
    let ting = run(&["model.ting={}"]);
    for headline in QuantityOfInterest::ALL {
        let bar = |summary: &Summary| {
            let parts = summary.uncertainty.parts(headline);
            parts.discretisation.unwrap() + parts.model.unwrap()
        };
        let [one, other] = [&fem, &ting].map(|it| it.collision.number(headline).unwrap());
        let off = bar(&fem) + bar(&ting);
        assert!((one - other).abs() < off, "{headline:?}: {one} {other} ± {off}");
        let share = bar(&fem) / headline.scale(one);
        // The pressure comes while the contact is a third of an element wide.
        let is_seen = headline != QuantityOfInterest::PeakPressure;
        assert!(!is_seen || share < 0.12, "{headline:?}: {one} ± {share}");
    }
}

/// The stress that is announced is that of the collision: 17 kPa of pressure, where elastic bodies have 480.
#[test]
fn the_stress_that_is_announced_is_that_of_the_collision() {
    let words = |set: &[&str]| {
        let effects = run(&[set, &["model.ting={}"]].concat()).effects;
        let plastic = effects.into_iter().find(|it| it.verdict.name == "plastic yield").unwrap();
        plastic.verdict.reason
    };
    assert!(words(&[]).contains("contact modulus = 0.003"), "{}", words(&[]));
    assert!(words(&[ELASTIC]).contains("contact modulus = 0.080"), "{}", words(&[ELASTIC]));
}
