//! A collision in pieces is the collision in one go.

use fem::{Approach, Collision, Ending, METHODS, OutputRequest, RestartState, Simulation, Stop};

use crate::coarse::simulation;

#[test]
fn pieces_make_the_whole() {
    for method in METHODS {
        let simulation = simulation(method.name(), &[]);
        let whole = simulation.run(&mut ());
        let mut course = simulation.start();
        let mut n_pieces = 0;
        while course.advance(&mut ()) {
            n_pieces += 1;
        }
        assert_eq!(n_pieces > 10, method.name() == "fem", "{}", method.name());
        // What is over stays so.
        assert!(!course.advance(&mut ()));
        assert_eq!(course.finish(), whole, "{}", method.name());
    }
}

#[test]
fn a_course_that_is_left_is_interrupted() {
    for method in ["fem", "condensed"] {
        let simulation = simulation(method, &[]);
        let mut course = simulation.start();
        if method == "fem" {
            assert!(course.advance(&mut ()));
        }
        let left = course.finish();
        let Ending::Stopped(Stop::Interrupted { .. }) = left.ending else { panic!("{left:?}") };
        assert_eq!(left.restitution, None);
    }
}

/// Put away after so many pieces, through text, and taken up again.
fn in_two(simulation: &Simulation, approach: &Approach, n_pieces: usize) -> Collision {
    let (model, request) = (simulation.model(), OutputRequest::history());
    let mut course = model.start(approach, &request).unwrap();
    for _ in 0..n_pieces {
        course.advance(&mut ());
    }
    let text = serde_json::to_string(&course.restart_state().unwrap()).unwrap();
    let memory: RestartState = serde_json::from_str(&text).unwrap();
    let mut resumed = model.resume(memory).unwrap();
    while resumed.advance(&mut ()) {}
    resumed.finish()
}

/// Also of a contact that has outgrown the region in which it was looked for, before it was put away
/// or after.
#[test]
fn a_course_goes_on_from_its_memory() {
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
fn a_memory_of_another_case_is_refused() {
    let relaxing = "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, \
                    decay_rate=2e4}]}";
    let memory = simulation("fem", &[]).start().restart_state().unwrap();
    for other in [
        simulation("fem", &["mesh.contact_element_size='0.12 mm'"]),
        simulation("fem", &[relaxing]),
        simulation("condensed", &[]),
    ] {
        let refused = other.resume(memory.clone()).map(|_| ()).unwrap_err();
        assert!(refused.message().contains("restart state"), "{refused}");
    }
}

/// Of identical bodies half is computed, put away and taken up again.
#[test]
fn the_half_of_a_scene_goes_on_from_its_memory() {
    let twins = ["body.1.sphere.diameter='22.2 mm'", "body.1.approach_speed=0.2"];
    let simulation = simulation("fem", &twins);
    let whole = simulation.run(&mut ());
    assert_eq!(whole.bodies[0].elements, whole.bodies[1].elements);
    let mut course = simulation.start();
    assert!((0..10).all(|_| course.advance(&mut ())));
    let mut resumed = simulation.resume(course.restart_state().unwrap()).unwrap();
    while resumed.advance(&mut ()) {}
    assert_eq!(resumed.finish(), whole);
}
