//! Finite strain near the contact: what it leaves out, and what it spares.

use std::path::Path;

use fem::{Case, Collision, Explicit, QuantityOfInterest, Simulation};

const ELASTIC: &str = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
const RELAXING: &str = include_str!("../../../../cases/glass_0.5ms.toml");
/// Four elements across the contact, and the tolerance of eight.
const AT_A_THOUSANDTH: [&str; 3] =
    ["accuracy.tolerance='0.1 %'", "mesh.contact_element_size='56 um'", "output.snapshots=[]"];
const EVERYWHERE: &str = "effects.finite_strain='on'";
const NOWHERE: &str = "effects.finite_strain='off'";

fn simulation(case: &str, set: &[&str]) -> Simulation {
    let set: Vec<String> = AT_A_THOUSANDTH.iter().chain(set).map(ToString::to_string).collect();
    Simulation::new(Case::parse("glass.toml", case, Path::new("."), &set).unwrap()).unwrap()
}

/// Differences of the restitution, of all others as shares.
fn apart(one: &Collision, other: &Collision) -> [f64; 6] {
    QuantityOfInterest::ALL.map(|headline| {
        let [one, other] = [one, other].map(|collision| headline.of(collision).unwrap());
        (one - other).abs() / headline.scale(other)
    })
}

/// What small strain leaves out far away is three hundredths of the tolerance at most, beside what it leaves out
/// everywhere.
#[test]
fn what_is_left_out_far_away_is_three_hundredths_of_the_tolerance() {
    for case in [ELASTIC, RELAXING] {
        let run = |set: &[&str]| simulation(case, set).run(&mut ());
        let [near, everywhere, nowhere] = [run(&[]), run(&[EVERYWHERE]), run(&[NOWHERE])];
        assert_ne!(near, everywhere);
        let [left, whole] = [apart(&near, &everywhere), apart(&nowhere, &everywhere)];
        for headline in [
            QuantityOfInterest::Restitution,
            QuantityOfInterest::ContactTime,
            QuantityOfInterest::PeakForce,
            QuantityOfInterest::MaxApproach,
            QuantityOfInterest::PeakPressure,
        ] {
            let k = headline as usize;
            assert!(left[k] < 3e-5, "{}: {left:?} of {whole:?}", headline.name());
        }
        let force = QuantityOfInterest::PeakForce as usize;
        assert!(whole[force] > 1e-3, "{whole:?}");
    }
}

/// Elements at finite strain, each of which costs three at small strain: counted, so that the plan's choice of them is
/// no dearer than it was.
#[test]
fn a_third_of_the_elements_is_at_finite_strain() {
    let share = |set: &[&str]| {
        let set: Vec<String> =
            ["accuracy.tolerance='0.1 %'"].iter().chain(set).map(ToString::to_string).collect();
        let case = Case::parse("glass.toml", RELAXING, Path::new("."), &set).unwrap();
        let model = Explicit::new(case.scene()).unwrap();
        let bodies = model.bodies();
        let n_finite: usize = bodies.bodies().iter().map(|body| body.n_finite_elements()).sum();
        n_finite as f64 / bodies.n_elements() as f64
    };
    assert!((0.3..0.4).contains(&share(&[])), "{}", share(&[]));
    assert_eq!(share(&[EVERYWHERE]), 1.0);
    assert_eq!(share(&[NOWHERE]), 0.0);
    // What a looser tolerance bears is not at finite strain at all.
    assert_eq!(share(&["accuracy.tolerance='1 %'"]), 0.0);
}

/// The reason says how far from the contact elements have it, where not all do.
#[test]
fn results_say_how_far_it_reaches() {
    let reason = |set: &[&str]| {
        let simulation = simulation(ELASTIC, set);
        let verdicts = &simulation.setup().decisions.verdicts;
        verdicts.iter().find(|verdict| verdict.name == "finite strain").unwrap().reason.clone()
    };
    let near = reason(&[]);
    assert!(
        near.contains("elements within 8") && near.contains(" µm of first touch, 3."),
        "{near}"
    );
    assert!(near.contains("stay at small strain"), "{near}");
    for set in [EVERYWHERE, NOWHERE, "accuracy.tolerance='1 %'"] {
        let reason = reason(&[set]);
        assert!(!reason.contains("first touch"), "{set}: {reason}");
    }
}
