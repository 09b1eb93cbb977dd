//! Finite strain only near the contact: its error, and the elements that it saves.

use fem_collision::{Collision, QuantityOfInterest};
use fem_simulation::{Explicit, Simulation};

use crate::scene::{
    ELASTIC_GLASS as ELASTIC, GLASS as RELAXING, case_of, decision_on, simulation_of,
};

/// Settings with four elements across the contact, and the tolerance of eight.
const AT_A_THOUSANDTH: [&str; 3] =
    ["accuracy.tolerance='0.1 %'", "mesh.contact_element_size='56 um'", "output.snapshots=[]"];
const EVERYWHERE: &str = "effects.finite_strain='on'";
const NOWHERE: &str = "effects.finite_strain='off'";

fn simulation(case: &str, set: &[&str]) -> Simulation {
    simulation_of(case, &[&AT_A_THOUSANDTH, set].concat())
}

/// Returns the differences of two collisions: the restitution's absolute, others relative.
fn differences(one: &Collision, other: &Collision) -> [f64; 6] {
    QuantityOfInterest::ALL.map(|quantity| {
        let [one, other] = [one, other].map(|collision| quantity.of(collision).unwrap());
        (one - other).abs() / quantity.scale(other)
    })
}

/// Small strain away from the contact changes the results by at most three hundredths of the tolerance; small strain
/// everywhere changes the force by more than the tolerance.
#[test]
fn small_strain_away_from_the_contact_is_negligible() {
    for case in [ELASTIC, RELAXING] {
        let run = |set: &[&str]| simulation(case, set).run(&mut ());
        let [near, everywhere, nowhere] = [run(&[]), run(&[EVERYWHERE]), run(&[NOWHERE])];
        assert_ne!(near, everywhere);
        let [left, whole] = [differences(&near, &everywhere), differences(&nowhere, &everywhere)];
        for quantity in [
            QuantityOfInterest::Restitution,
            QuantityOfInterest::ContactTime,
            QuantityOfInterest::PeakForce,
            QuantityOfInterest::MaxApproach,
            QuantityOfInterest::PeakPressure,
        ] {
            let k = quantity as usize;
            assert!(left[k] < 3e-5, "{}: {left:?} of {whole:?}", quantity.name());
        }
        let force = QuantityOfInterest::PeakForce as usize;
        assert!(whole[force] > 1e-3, "{whole:?}");
    }
}

/// The number of elements at finite strain, each of which costs as much as three at small strain, is bounded.
#[test]
fn a_third_of_the_elements_is_at_finite_strain() {
    let share = |set: &[&str]| {
        let case = case_of(RELAXING, &[&AT_A_THOUSANDTH[..1], set].concat());
        let model = Explicit::new(case.scene()).unwrap();
        let bodies = model.bodies();
        let n_finite: usize = bodies.bodies().iter().map(|body| body.n_finite_elements()).sum();
        n_finite as f64 / bodies.n_elements() as f64
    };
    assert!((0.3..0.4).contains(&share(&[])), "{}", share(&[]));
    assert_eq!(share(&[EVERYWHERE]), 1.0);
    assert_eq!(share(&[NOWHERE]), 0.0);
    // A larger tolerance needs no finite strain.
    assert_eq!(share(&["accuracy.tolerance='1 %'"]), 0.0);
}

/// The effect's reason reports the distance from the contact within which elements are at finite strain.
#[test]
fn the_reason_reports_the_distance() {
    let reason =
        |set: &[&str]| decision_on(&simulation(ELASTIC, set), "finite strain").reason.clone();
    let near = reason(&[]);
    for words in ["elements within 8", " µm of first touch, 3.", "stay at small strain"] {
        assert!(near.contains(words), "{near}");
    }
    for set in [EVERYWHERE, NOWHERE, "accuracy.tolerance='1 %'"] {
        let reason = reason(&[set]);
        assert!(!reason.contains("first touch"), "{set}: {reason}");
    }
}
