//! The recorder on its own, fed with an approach that rises and falls.

use std::f64::consts::PI;

use fem_collision::{Approach, BodyInput};
use fem_mesh::Side;

use super::*;
use crate::test_support::{glass_sphere, settings};

const CONTACT_TIME: f64 = 2.0;

fn model() -> ExplicitBodies {
    let bodies = [BodyInput::Wall, glass_sphere(4.0, Side::Above)];
    ExplicitBodies::new(bodies, Approach::new([1.0, 0.0], 0.5).unwrap(), &settings()).unwrap()
}

/// An instant of a contact.
const CONTACT: Instant = Instant {
    approach: 1.0,
    approach_rate: 1.0,
    is_closed: true,
    is_first_contact: false,
    is_last_contact: false,
    has_separated: false,
    stays_together: false,
};

fn expectation(approach: f64, contact_time: f64) -> Expectation {
    Expectation { contact_time, approach }
}

fn of_contact() -> SnapshotRequest {
    SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec())
}

fn labels(snapshots: &[Snapshot]) -> Vec<SnapshotInstant> {
    snapshots.iter().map(|snapshot| snapshot.label.unwrap()).collect()
}

/// A contact from first touch, approach `peak` sin(πt/T), in so many steps; the recorder at its
/// end and the most states it held.
fn record(
    request: &SnapshotRequest,
    model: &ExplicitBodies,
    peak: f64,
    expected: f64,
    n_steps: usize,
) -> (Recorder, usize) {
    let mut recorder = Recorder::new(request, model, expectation(expected, CONTACT_TIME));
    let mut state = State::at_first_touch(model);
    let mut scratch = Scratch::new(model);
    let mut most = 0;
    for step in 0..=n_steps {
        let share = step as f64 / n_steps as f64;
        state.time = model.approach().first_touch() + CONTACT_TIME * share;
        let now = Instant {
            approach: peak * (PI * share).sin(),
            approach_rate: peak * (PI * (share - 0.5 / n_steps as f64)).cos(),
            is_closed: step > 0 && step < n_steps,
            is_first_contact: step == 1,
            is_last_contact: step == n_steps - 1,
            ..CONTACT
        };
        recorder.observe(model, &state, &mut scratch, now);
        most = most.max(recorder.kept.len() + scratch.pool.len());
    }
    (recorder, most)
}

#[test]
fn recorder_finds_half_the_maximum_approach_for_any_estimate() {
    let model = model();
    let request = of_contact();
    for estimate in [0.1, 0.9, 1.0, 1.3, 10.0] {
        let peak = 0.37;
        let (recorder, most) = record(&request, &model, peak, peak * estimate, 5000);
        // ln 2 / ln 1.03 = 23.4 rungs span the upper half.
        assert!(most <= 26, "{most} states");
        let (snapshots, missing) = recorder.finish();
        assert!(missing.is_empty(), "{missing:?}");
        assert_eq!(labels(&snapshots), SnapshotInstant::OF_CONTACT);
        assert!(snapshots.windows(2).all(|pair| pair[0].time < pair[1].time));
        let approach = |k: usize| snapshots[k].approach / peak;
        // A rung is half a ratio away at most, and a step of π/5000 late.
        assert!((approach(0) / 0.5 - 1.0).abs() < 0.015 + 1e-3, "{}", approach(0));
        assert!((approach(1) - 1.0).abs() < 1e-6);
        assert!((approach(2) / 0.5 - 1.0).abs() < 2e-3, "{}", approach(2));
    }
}

/// While the bodies are as fast as at first touch, no candidate is taken below a quarter of the expected approach;
/// once they have slowed down, all are. Either way the ladder has the same rungs.
#[test]
fn recorder_takes_no_early_states_of_unslowed_bodies() {
    let model = model();
    let request = of_contact();
    let state = State::at_first_touch(&model);
    let mut scratch = Scratch::new(&model);
    let speed = model.approach().speed();
    let mut kept_of = |rate: f64, upto: f64| {
        let mut recorder = Recorder::new(&request, &model, expectation(1.0, CONTACT_TIME));
        for k in 1..=1000 {
            let approach = upto * f64::from(k) / 1000.0;
            let now = Instant { approach, approach_rate: rate, ..CONTACT };
            recorder.observe(&model, &state, &mut scratch, now);
        }
        recorder.kept.iter().map(|rung| rung.approach).collect::<Vec<_>>()
    };
    assert!(kept_of(speed, 0.249).is_empty());
    assert!(kept_of(1.2 * speed, 0.249).is_empty());
    let slowed = kept_of(0.98 * speed, 0.249);
    assert!(slowed.len() > 20 && slowed[0] < 0.5 * 0.249, "{slowed:?}");
    let unslowed = kept_of(speed, 0.4);
    assert!(unslowed[0] >= 0.25 && unslowed.len() > 10, "{unslowed:?}");
    assert!(kept_of(0.98 * speed, 0.4).ends_with(&unslowed), "{unslowed:?}");
}

#[test]
fn missing_snapshot_labels_are_reported() {
    let model = model();
    let request = of_contact();
    let expected = expectation(1.0, CONTACT_TIME);
    let (snapshots, missing) = Recorder::new(&request, &model, expected).finish();
    assert!(snapshots.is_empty());
    assert_eq!(missing.len(), 4);
    for (message, label) in missing.iter().zip(SnapshotInstant::OF_CONTACT) {
        assert!(message.contains(label.name()), "{message}");
    }
    // Only what was asked for.
    let some =
        SnapshotRequest::Labels(vec![SnapshotInstant::LastContact, SnapshotInstant::Maximum]);
    let (recorder, _) = record(&some, &model, 1.0, 1.0, 100);
    let (snapshots, missing) = recorder.finish();
    assert_eq!(labels(&snapshots), [SnapshotInstant::Maximum, SnapshotInstant::LastContact]);
    assert!(missing.is_empty());
}

/// Still in contact at their end.
#[test]
fn bodies_that_stay_together_have_no_last_contact() {
    let model = model();
    let request = of_contact();
    let mut recorder = Recorder::new(&request, &model, expectation(1.0, CONTACT_TIME));
    let state = State::at_first_touch(&model);
    // It would open in the next step.
    let now =
        Instant { approach_rate: 1e-9, is_last_contact: true, stays_together: true, ..CONTACT };
    recorder.observe(&model, &state, &mut Scratch::new(&model), now);
    let (snapshots, missing) = recorder.finish();
    assert_eq!(labels(&snapshots), [SnapshotInstant::Maximum]);
    assert!(missing.contains(&did_not_occur(SnapshotInstant::LastContact)), "{missing:?}");
}

/// Unusual requests that pass all checks: every state is kept, and every time that is a number has its snapshot.
#[test]
fn recorder_handles_extreme_counts_and_nan_times() {
    let model = model();
    for n in [OutputRequest::MAX_SNAPSHOTS, usize::MAX] {
        let (recorder, _) = record(&SnapshotRequest::Count(n), &model, 1.0, 1.0, 200);
        assert!(recorder.fits(&model, &SnapshotRequest::Count(n)));
        let (snapshots, missing) = recorder.finish();
        assert_eq!((snapshots.len(), missing.len()), (199, 1));
    }
    let times = SnapshotRequest::Times(vec![1.0, f64::NAN, 0.1, -f64::NAN, 1.5]);
    let (recorder, _) = record(&times, &model, 1.0, 1.0, 200);
    assert!(recorder.fits(&model, &times));
    let (snapshots, missing) = recorder.finish();
    assert_eq!((snapshots.len(), missing.len()), (3, 2));
}

/// So coarse that no state lies near half of the maximum: left out, not passed off.
#[test]
fn state_too_far_from_half_maximum_is_left_out() {
    let model = model();
    let request = SnapshotRequest::Labels(vec![SnapshotInstant::MidCompression]);
    let (recorder, _) = record(&request, &model, 1.0, 1.0, 8);
    let (snapshots, missing) = recorder.finish();
    assert!(snapshots.is_empty() && missing.len() == 1, "{snapshots:?}");
}

#[test]
fn count_spreads_states_evenly_over_the_contact() {
    let model = model();
    for n in [1, 2, 5, 20] {
        // The contact may last longer than was expected: the spacing doubles.
        for n_steps in [200, 4000] {
            let request = SnapshotRequest::Count(n);
            let (recorder, most) = record(&request, &model, 1.0, 1.0, n_steps);
            assert!(most <= n_kept(n) + 1, "{most} states for {n}");
            let (snapshots, missing) = recorder.finish();
            assert!(missing.is_empty());
            assert_eq!(snapshots.len(), n, "of {n_steps} steps");
            let step = CONTACT_TIME / n_steps as f64;
            let (start, length) =
                (model.approach().first_touch() + step, CONTACT_TIME - 2.0 * step);
            for (k, snapshot) in snapshots.iter().enumerate() {
                let share = if n == 1 { 0.5 } else { k as f64 / (n - 1) as f64 };
                // States are kept at a quarter of the spacing, or every step.
                let tolerance = (length / (4 * n) as f64).max(step);
                assert!((snapshot.time - start - share * length).abs() <= tolerance, "{n} {k}");
                assert_eq!(snapshot.label, None);
            }
        }
    }
}

#[test]
fn count_keeps_its_budget_when_the_contact_lasts_longer() {
    let model = model();
    let expected = expectation(1.0, CONTACT_TIME / 50.0);
    let mut recorder = Recorder::new(&SnapshotRequest::Count(5), &model, expected);
    let mut state = State::at_first_touch(&model);
    let mut scratch = Scratch::new(&model);
    for step in 0..=5000 {
        state.time = model.approach().first_touch() + CONTACT_TIME * f64::from(step) / 5000.0;
        let now = Instant { is_first_contact: step == 0, is_last_contact: step == 5000, ..CONTACT };
        recorder.observe(&model, &state, &mut scratch, now);
        assert!(recorder.kept.len() <= n_kept(5));
        assert!(recorder.kept.len() + scratch.pool.len() <= n_kept(5) + 1);
    }
    let (snapshots, _) = recorder.finish();
    let times: Vec<_> = snapshots.iter().map(|s| s.time - model.approach().first_touch()).collect();
    assert_eq!(times.len(), 5);
    for (k, time) in times.iter().enumerate() {
        // States are kept at a spacing of between a twentieth and a fortieth of the contact.
        assert!((time - CONTACT_TIME * k as f64 / 4.0).abs() <= CONTACT_TIME / 40.0, "{times:?}");
    }
}

#[test]
fn times_are_met_to_half_a_step() {
    let model = model();
    let touch = model.approach().first_touch();
    let asked = vec![touch + 1.5, 0.3 * touch, touch + 0.2, touch + 100.0, 0.0, touch];
    let (recorder, _) = record(&SnapshotRequest::Times(asked), &model, 1.0, 1.0, 400);
    let (snapshots, missing) = recorder.finish();
    assert_eq!(missing.len(), 1);
    let times: Vec<_> = snapshots.iter().map(|snapshot| snapshot.time).collect();
    let expected = [0.0, 0.3 * touch, touch, touch + 0.2, touch + 1.5];
    assert_eq!(times.len(), expected.len());
    for (time, expected) in times.iter().zip(expected) {
        // The steps of this test, 1/200, are shorter than the model's, whose half is the limit.
        assert!((time - expected).abs() <= 0.5 * model.time_step() + 1e-12, "{times:?}");
    }
    // Free flight is exact.
    assert_eq!(times[1], 0.3 * touch);
    assert!(snapshots[1].bodies[0].displacement.is_empty());
    assert_eq!(snapshots[1].approach, 0.3 * touch - 0.5);
}
