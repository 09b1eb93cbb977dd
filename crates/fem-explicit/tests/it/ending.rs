//! A run that has ended has ended, and one that is left is interrupted.

use std::sync::Arc;

use crate::common::Pair;
use fem_collision::{Collision, Ending, OutputRequest, Stop};
use fem_explicit::{Model, RestartState, Run};

/// About 1900 steps a contact and 270 elements.
fn small() -> Pair {
    Pair { element_size: 110e-6, candidate_radius: 0.45e-3, ..Pair::default() }
}

/// Runs that part, outgrow their region of contact, or do not part in time.
fn endings() -> [Pair; 3] {
    let outgrown = Pair { candidate_radius: 0.15e-3, ..small() };
    [small(), outgrown, Pair { max_time: 30e-6, ..small() }]
}

fn stored(memory: &RestartState) -> RestartState {
    postcard::from_bytes(&postcard::to_stdvec(memory).unwrap()).unwrap()
}

#[test]
fn an_ended_run_does_no_step_more() {
    let mut names = Vec::new();
    for pair in endings() {
        let model = pair.model();
        let mut run = Run::new(&model, pair.expected(), &pair.request());
        assert_eq!(run.advance(10), None);
        assert_eq!(run.restart_state().ending(), None);
        let ending = run.advance(u64::MAX).unwrap().clone();
        let memory = run.restart_state().clone();
        assert_eq!(memory.ending(), Some(&ending));
        for n_steps in [0, 1, u64::MAX] {
            assert_eq!(run.advance(n_steps), Some(&ending));
            assert_eq!(run.restart_state(), &memory);
        }
        // Nor does one that is resumed.
        let mut resumed = Run::resume(&model, stored(&memory)).unwrap();
        assert_eq!(resumed.advance(100), Some(&ending));
        assert_eq!(resumed.restart_state(), &memory);
        let whole = pair.run_model(&model);
        assert_eq!(whole.ending, ending);
        assert_eq!(run.finish(), whole);
        assert_eq!(resumed.finish(), whole);
        names.push(match ending {
            Ending::Stopped(Stop::ContactBeyondCandidates { .. }) => "outgrown",
            Ending::Stopped(Stop::NoSeparation { .. }) => "endless",
            Ending::Parted => "parted",
            other => panic!("{other:?}"),
        });
    }
    assert_eq!(names, ["parted", "outgrown", "endless"]);
}

/// At the start, in contact and in the flight after it; with rows and without.
#[test]
fn a_run_that_is_left_is_interrupted_where_it_is() {
    let pair = small();
    let model = pair.model();
    let n_steps = pair.run_model(&model).steps.unwrap();
    for step in [0, 1, n_steps / 2, n_steps - 1] {
        for request in [
            pair.request(),
            OutputRequest { history_rows: 7, ..pair.request() },
            OutputRequest::quantities(),
        ] {
            let mut run = Run::new(&model, pair.expected(), &request);
            assert_eq!(run.advance(step), None);
            let time = run.restart_state().time();
            let left = run.finish();
            assert_eq!(left.ending, Ending::Stopped(Stop::Interrupted { time, step }));
            assert_eq!([left.restitution, left.contact_time], [None; 2]);
            assert!(left.energies.entries().count() > 2 && left.residual.is_some());
            assert_eq!(left.history.is_empty(), request.history_rows == 0);
            if let Some(row) = left.history.last() {
                assert_eq!((row.time, row.energies), (time, left.energies));
            }
        }
    }
}

/// A run that owns a share of its model can be handed on.
#[test]
fn a_run_can_hold_its_model() {
    fn begun(pair: &Pair) -> Run<Arc<Model>> {
        Run::new(Arc::new(pair.model()), pair.expected(), &pair.request())
    }
    fn finished(mut run: Run<Arc<Model>>) -> Collision {
        while run.advance(64).is_none() {}
        assert_eq!(run.model().n_elements(), small().model().n_elements());
        run.finish()
    }
    let run = begun(&small());
    let elsewhere = std::thread::spawn(|| finished(run)).join().unwrap();
    assert_eq!(elsewhere, small().run());
}
