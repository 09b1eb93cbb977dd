//! A collision in pieces equals the collision in one call.

use fem_collision::{Approach, Ending, OutputRequest, Stop};
use fem_simulation::{METHODS, RestartState};

use crate::scene::coarse_glass as simulation;

#[test]
fn stepped_collision_equals_the_whole_run() {
    for method in METHODS {
        let simulation = simulation(method.name(), &[]);
        let whole = simulation.run(&mut ());
        let mut stepper = simulation.start();
        let mut n_pieces = 0;
        while stepper.advance(&mut ()) {
            n_pieces += 1;
        }
        assert_eq!(n_pieces > 10, method.name() == "fem", "{}", method.name());
        // A finished collision does not continue.
        assert!(!stepper.advance(&mut ()));
        assert_eq!(stepper.finish(), whole, "{}", method.name());
    }
}

#[test]
fn a_stepper_that_is_finished_early_is_interrupted() {
    for method in ["fem", "condensed"] {
        let simulation = simulation(method, &[]);
        let mut stepper = simulation.start();
        if method == "fem" {
            assert!(stepper.advance(&mut ()));
        }
        let left = stepper.finish();
        let Ending::Stopped(Stop::Interrupted { .. }) = left.ending else { panic!("{left:?}") };
        assert_eq!(left.restitution, None);
    }
}

const RELAXING: &str =
    "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, decay_rate=2e4}]}";

/// A collision that is stopped after some pieces, stored as text and continued has the same bits, also if the contact
/// outgrows its candidate region before or after the stop, and if half of identical bodies is computed.
#[test]
fn a_collision_continues_from_its_restart_state() {
    let twins = ["body.1.sphere.diameter='22.2 mm'", "body.1.approach_speed=0.2"];
    for (more, approach, pieces) in [
        (&[RELAXING][..], Approach::at(0.5), &[0, 1, 12, 1000][..]),
        (&[RELAXING], Approach::new([4.0, -2.0], 1e-6), &[1, 12, 40]),
        (&twins, Approach::at(0.3), &[10]),
    ] {
        let (simulation, approach) = (simulation("fem", more), approach.unwrap());
        let (model, request) = (simulation.model(), OutputRequest::history());
        let whole = model.collide(&approach, &request, &mut ());
        let is_half = whole.bodies[0].elements == whole.bodies[1].elements;
        assert_eq!(is_half, more.len() == twins.len());
        for n_pieces in pieces {
            let mut stepper = model.start(&approach, &request).unwrap();
            (0..*n_pieces).for_each(|_| _ = stepper.advance(&mut ()));
            let text = serde_json::to_string(&stepper.restart_state().unwrap()).unwrap();
            let state: RestartState = serde_json::from_str(&text).unwrap();
            let mut resumed = model.resume(state).unwrap();
            while resumed.advance(&mut ()) {}
            assert_eq!(resumed.finish(), whole, "{more:?} {n_pieces}");
        }
    }
}

#[test]
fn a_restart_state_of_another_case_is_rejected() {
    let state = simulation("fem", &[]).start().restart_state().unwrap();
    for other in [
        simulation("fem", &["mesh.contact_element_size='0.12 mm'"]),
        simulation("fem", &[RELAXING]),
        simulation("condensed", &[]),
    ] {
        let refused = other.resume(state.clone()).map(|_| ()).unwrap_err();
        assert!(refused.message().contains("restart state"), "{refused}");
    }
}
