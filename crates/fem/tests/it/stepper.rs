//! A collision in pieces equals the collision in one call.

use fem::{Approach, Collision, Ending, METHODS, OutputRequest, RestartState, Simulation, Stop};

use crate::coarse_mesh::simulation;

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

/// Computes a collision that is stopped after some pieces, stored as text and continued.
fn in_two(simulation: &Simulation, approach: &Approach, n_pieces: usize) -> Collision {
    let (model, request) = (simulation.model(), OutputRequest::history());
    let mut stepper = model.start(approach, &request).unwrap();
    for _ in 0..n_pieces {
        stepper.advance(&mut ());
    }
    let text = serde_json::to_string(&stepper.restart_state().unwrap()).unwrap();
    let state: RestartState = serde_json::from_str(&text).unwrap();
    let mut resumed = model.resume(state).unwrap();
    while resumed.advance(&mut ()) {}
    resumed.finish()
}

/// A continued collision has the same bits, also if the contact outgrows its candidate region before or after the stop.
#[test]
fn a_collision_continues_from_its_restart_state() {
    let relaxing = "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, \
                    decay_rate=2e4}]}";
    let simulation = simulation("fem", &[relaxing]);
    for approach in [Approach::at(0.5), Approach::new([4.0, -2.0], 1e-6)] {
        let approach = approach.unwrap();
        let whole = simulation.model().collide(&approach, &OutputRequest::history(), &mut ());
        for n_pieces in [0, 1, 12, 40, 1000] {
            assert_eq!(in_two(&simulation, &approach, n_pieces), whole, "{n_pieces}");
        }
    }
}

#[test]
fn a_restart_state_of_another_case_is_rejected() {
    let relaxing = "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, \
                    decay_rate=2e4}]}";
    let state = simulation("fem", &[]).start().restart_state().unwrap();
    for other in [
        simulation("fem", &["mesh.contact_element_size='0.12 mm'"]),
        simulation("fem", &[relaxing]),
        simulation("condensed", &[]),
    ] {
        let refused = other.resume(state.clone()).map(|_| ()).unwrap_err();
        assert!(refused.message().contains("restart state"), "{refused}");
    }
}

/// A collision of identical bodies, of which half is computed, continues from its restart state.
#[test]
fn half_of_a_scene_continues_from_its_restart_state() {
    let twins = ["body.1.sphere.diameter='22.2 mm'", "body.1.approach_speed=0.2"];
    let simulation = simulation("fem", &twins);
    let whole = simulation.run(&mut ());
    assert_eq!(whole.bodies[0].elements, whole.bodies[1].elements);
    let mut stepper = simulation.start();
    assert!((0..10).all(|_| stepper.advance(&mut ())));
    let mut resumed = simulation.resume(stepper.restart_state().unwrap()).unwrap();
    while resumed.advance(&mut ()) {}
    assert_eq!(resumed.finish(), whole);
}
