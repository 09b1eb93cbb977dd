//! Nothing is allocated inside a step: the allocator itself counts, for each thread.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::common::Pair;
use fem_collision::{SnapshotInstant, SnapshotRequest};
use fem_explicit::collide;
use fem_material::ActsOn;
use fem_material::finite::HyperelasticLaw;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: passes every call on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations and steps of a run.
fn count(pair: &Pair) -> (usize, u64) {
    let (model, request) = (pair.model(), pair.request());
    let before = COUNT.get();
    let run = collide(&model, pair.expected(), &request, &mut ());
    (COUNT.get() - before, run.steps.unwrap())
}

#[test]
fn the_number_of_allocations_does_not_depend_on_the_number_of_steps() {
    let shear = Some(ActsOn::Shear);
    let finite = Some(HyperelasticLaw::NeoHooke);
    for (relaxation, law) in [(None, None), (shear, None), (None, finite), (shear, finite)] {
        let (element_size, candidate_radius) = (100e-6, 0.45e-3);
        let pair = Pair { element_size, candidate_radius, relaxation, law, ..Pair::default() };
        for (snapshots, n_kept) in [
            (SnapshotRequest::Times(Vec::new()), 0),
            (SnapshotRequest::Count(4), 8 * 4 + 2),
            // The ladder's rungs, and the three states after them.
            (SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec()), 26 + 3),
        ] {
            let pair = Pair { snapshots, ..pair.clone() };
            let (n, steps) = count(&pair);
            let (n_twice, steps_twice) = count(&Pair { step_factor: 0.45, ..pair });
            assert!(steps_twice as f64 > 1.9 * steps as f64);
            // State, forces, those of the contact, history, the pulse, rows of the lanes, ten or so for each of
            // some thirty sound states, and up to eight fields and forty lists of the contact's profile a
            // snapshot kept.
            assert!(n < 480 + 60 * n_kept, "{n} {relaxation:?} {law:?} {n_kept}");
            if n_kept == 0 {
                assert_eq!(n, n_twice);
            } else {
                // Some rungs more or less.
                assert!(n.abs_diff(n_twice) <= 180, "{n} {n_twice}");
            }
        }
    }
}
