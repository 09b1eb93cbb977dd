//! Runs whose state is modified.

use fem_collision::{Approach, BodyInput, HistoryRow, SnapshotInstant, SnapshotRequest};
use fem_mesh::Side;

use super::phases::is_closed_next;
use super::*;
use crate::state::{Scratch, State};
use crate::test_support::{settings, sphere, started, unit_glass};
use crate::{ModelParts, Settings, SmallStrainContact};

/// Unit spheres at a hundredth of the wave's speed, two elements a block's side; or the upper one on a wall.
fn on_springs(
    contact_stiffness: f64,
    method: SmallStrainContact,
    has_wall: bool,
) -> ExplicitBodies {
    let sphere = |side| BodyInput::Sphere { mesh: sphere(0.05, 0.1, side), material: unit_glass() };
    let lower = if has_wall { BodyInput::Wall } else { sphere(Side::Below) };
    let settings = Settings { contact_stiffness, ..settings() };
    let parts = ModelParts { method, ..ModelParts::default() };
    let approach = Approach::at(0.01).unwrap();
    started([lower, sphere(Side::Above)], approach, &settings, parts).0
}

fn model() -> ExplicitBodies {
    on_springs(5.0, SmallStrainContact::Penalty, false)
}

const EXPECTED: Expectation = Expectation { contact_time: 12.0, approach: 0.05 };

const COUNT: SnapshotRequest = SnapshotRequest::Count(3);

fn request(snapshots: SnapshotRequest) -> OutputRequest {
    OutputRequest {
        history_rows: 100,
        snapshots,
        max_contact_times: 100.0 / EXPECTED.contact_time,
        ..OutputRequest::history()
    }
}

/// A run after 128 steps, of which the velocities of the lower body are multiplied.
fn disturbed_run<'m>(
    model: &'m ExplicitBodies,
    request: &OutputRequest,
    factor: f64,
) -> Run<&'m ExplicitBodies> {
    let mut run = Run::new(model, EXPECTED, request);
    assert_eq!(run.advance(128), None);
    for v in run.restart_state.state.bodies[0].velocity.as_flattened_mut() {
        *v *= factor;
    }
    run
}

fn disturbed(factor: f64) -> Collision {
    let model = model();
    let mut run = disturbed_run(&model, &request(SnapshotRequest::none()), factor);
    run.advance(u64::MAX);
    run.finish()
}

#[test]
fn added_energy_stops_the_run() {
    let run = disturbed(1.1);
    let Some(&Stop::EnergyGrowth { at: StepInstant { time, .. }, ratio, body, place, .. }) =
        run.stop()
    else {
        panic!("{run:?}")
    };
    // The body whose velocities were multiplied, at the contact.
    assert!(body == 0 && place[0].hypot(place[1]) < 0.5, "{body} {place:?}");
    // 1.1² of the kinetic energy, in the frame of the mass centres twice as much.
    assert!(ratio > 1.05 && ratio < 1.5, "{ratio}");
    assert!(run.history.iter().all(|row| row.time < time));
    assert!(run.residual_relative.unwrap() > 0.05, "the residual must fail");
    assert_eq!(run.restitution, None);
    // Without a modification the run ends normally.
    let run = disturbed(1.0);
    assert_eq!(run.ending, Ending::Parted);
    assert!(run.restitution.unwrap() > 0.98, "{:?}", run.restitution);
}

/// A run that fails keeps the last state with a valid energy balance. A run that is interrupted, or without requested
/// fields, keeps none.
#[test]
fn a_failed_run_keeps_its_last_valid_state() {
    let model = model();
    let labels = || request(SnapshotRequest::Labels(vec![SnapshotInstant::LastContact]));
    for (request, is_kept) in [(labels(), true), (request(SnapshotRequest::none()), false)] {
        let mut run = disturbed_run(&model, &request, f64::NAN);
        let disturbed_at = run.restart_state.state.time;
        run.advance(u64::MAX);
        let collision = run.finish();
        assert!(matches!(collision.stop(), Some(Stop::NoNumber { body: 0, .. })));
        assert_eq!(collision.snapshots.len(), usize::from(is_kept));
        for snapshot in &collision.snapshots {
            assert_eq!(snapshot.label, Some(SnapshotInstant::LastValid));
            assert!(snapshot.time <= disturbed_at);
            let mut fields = snapshot.bodies.iter().flat_map(|body| {
                body.displacement.as_flattened().iter().chain(body.velocity.as_flattened())
            });
            assert!(fields.all(|value| value.is_finite()));
        }
    }
    assert!(disturbed_run(&model, &labels(), 1.0).finish().snapshots.is_empty());
}

/// If the state of the stop is valid, it is the last valid one, also in a resumed run.
#[test]
fn a_valid_state_at_a_stop_is_the_last_one() {
    let model = model();
    let request =
        OutputRequest { most_element_updates: 200 * model.n_elements() as u64, ..request(COUNT) };
    let mut run = Run::new(&model, EXPECTED, &request);
    run.advance(128);
    let mut resumed = Run::resume(&model, run.restart_state().clone()).unwrap();
    let collisions = [&mut run, &mut resumed].map(|run| run.advance(u64::MAX).cloned());
    let Some(Ending::Stopped(Stop::TooManyUpdates { at: StepInstant { time, .. }, .. })) =
        collisions[0]
    else {
        panic!()
    };
    let collision = run.finish();
    let last_valid = collision.snapshot(SnapshotInstant::LastValid).unwrap();
    assert_eq!(last_valid.time, time);
    assert_eq!(collision, resumed.finish());
}

#[test]
fn numbers_that_are_not_finite_stop_the_run() {
    for factor in [f64::NAN, f64::INFINITY] {
        let run = disturbed(factor);
        assert!(matches!(run.stop(), Some(Stop::NoNumber { .. })), "{:?}", run.ending);
        assert!(run.residual_since.is_some_and(|since| since.step >= 128));
        let is_sound = |row: &HistoryRow| row.residual.unwrap().is_finite();
        assert!(run.history.iter().all(is_sound), "a bad row is kept");
        assert!(!run.residual_relative.unwrap().is_finite());
    }
}

/// Velocities of a snapshot belong to its time, not half a step before, as the history's do.
#[test]
fn snapshots_and_rows_belong_to_the_same_instant() {
    let model = model();
    let snapshots = SnapshotRequest::Labels(vec![SnapshotInstant::LastContact]);
    let run = collide(&model, EXPECTED, &request(snapshots), &mut ());
    let [snapshot] = &run.snapshots[..] else { panic!("{:?}", run.warnings) };
    let row = run.history.iter().find(|row| row.time == snapshot.time).unwrap();
    let mut approach = 0.0;
    for (side, body) in model.bodies().iter().enumerate() {
        let fields = &snapshot.bodies[side];
        // Rounding of a sum over the nodes; half a step of the last force is 1e-5 of the velocity.
        assert!((body.centre(&fields.velocity) / row.velocity[side] - 1.0).abs() < 1e-12);
        approach += if side == 0 { 1.0 } else { -1.0 } * body.centre(&fields.displacement);
    }
    assert!((approach - row.approach).abs() < 1e-14, "{approach} {row:?}");
    // The approach that steers the recorder is integrated from the contact force alone.
    assert!((snapshot.approach - row.approach).abs() < 1e-13);
}

/// Finds the offset of the upper body at which a contact opens, by bisection.
fn threshold(mut is_closed: impl FnMut(f64) -> bool) -> f64 {
    let (mut closed, mut open) = (0.0, 0.1);
    assert!(is_closed(closed) && !is_closed(open));
    while open - closed > 1e-15 {
        let middle = 0.5 * (closed + open);
        if is_closed(middle) { closed = middle } else { open = middle }
    }
    closed
}

#[test]
fn the_next_contact_is_predicted() {
    let model = model();
    let (mut state, mut scratch) = (State::at_first_touch(&model), Scratch::new(&model));
    for _ in 0..200 {
        update_forces(&model, &state, &mut scratch).unwrap();
        advance(&model, &mut state, &mut scratch);
    }
    let contact = update_forces(&model, &state, &mut scratch).unwrap();
    let forces = || {
        let mut other = Scratch::new(&model);
        other.forces.clone_from(&scratch.forces);
        other
    };
    let lifted = |offset: f64| {
        let mut state = state.clone();
        state.bodies[1].displacement.iter_mut().for_each(|u| u[1] += offset);
        state
    };
    let predicted = threshold(|offset| is_closed_next(&model, &lifted(offset), &scratch, &contact));
    let found = threshold(|offset| {
        let mut next = lifted(offset);
        let mut scratch = forces();
        advance(&model, &mut next, &mut scratch);
        update_forces(&model, &next, &mut scratch).unwrap().n_closed > 0
    });
    let now = threshold(|offset| {
        update_forces(&model, &lifted(offset), &mut Scratch::new(&model)).unwrap().n_closed > 0
    });
    // Rounding; a step moves the threshold by orders more.
    assert!((predicted - found).abs() < 1e-14, "{predicted:e} {found:e}");
    assert!((predicted - now).abs() > 1e-6, "{predicted:e} {now:e}");
}

/// Tens of steps from one balance to the next.
const LONG: Expectation = Expectation { contact_time: 1200.0, ..EXPECTED };

/// Between two balances the share of the contact follows the whole balance at every step: to rounding for bodies that
/// do not relax, with springs between nodes that have mass and with a massless boundary.
#[test]
fn every_step_has_the_energy_of_a_balance() {
    for (method, stiffness) in [
        (SmallStrainContact::Penalty, 5.0),
        (SmallStrainContact::Penalty, 500.0),
        (SmallStrainContact::Massless, 500.0),
        (SmallStrainContact::NodeToSurface, 50.0),
    ] {
        for wall in [false, true] {
            let model = on_springs(stiffness, method, wall);
            let mut run = Run::new(&model, LONG, &request(SnapshotRequest::none()));
            let mut scratch = Scratch::new(&model);
            let (mut worst, mut largest, mut n_closed): (f64, f64, u32) = (0.0, 0.0, 0);
            while run.advance(1).is_none() {
                let state = &run.restart_state.state;
                let contact = update_forces(&model, state, &mut scratch).unwrap();
                let [mut followed, mut balanced] =
                    [(); 2].map(|()| run.restart_state.ledger.clone());
                followed.follow(&model, state, &scratch, &contact).unwrap();
                let row = balanced.balance(&model, state, &scratch, &contact);
                let off = (followed.residual() - row.residual.unwrap()) / balanced.initial_relative;
                (worst, largest) = (worst.max(off.abs()), largest.max(followed.worst_residual));
                n_closed += u32::from(contact.n_closed > 0);
            }
            assert!(n_closed > 100, "{method:?}: {n_closed}");
            // Rounding of sums of a thousand terms.
            assert!(worst < 1e-12, "{method:?} {stiffness}: {worst:e}");
            // There is something to be seen: springs that open and close within a step.
            let seen = run.restart_state.ledger.worst_residual;
            let is_massless = method == SmallStrainContact::Massless;
            assert!(seen >= largest && (seen > 1e-10 || is_massless), "{seen:e}");
        }
    }
}

/// Energy and momentum that a contact adds between two balances do not wait for the next one.
#[test]
fn a_contact_that_adds_energy_is_seen_in_the_step() {
    let model = model();
    let mut run = Run::new(&model, LONG, &request(SnapshotRequest::none()));
    assert_eq!(run.advance(128), None);
    // Two steps that are none of a balance, in the contact.
    let is_due = |run: &Run<&ExplicitBodies>, ahead: u64| {
        run.restart_state.sampled.is_due(run.restart_state.state.step + ahead)
    };
    for _ in 0..20 {
        if (0..3).any(|ahead| is_due(&run, ahead)) {
            run.advance(1);
        }
    }
    assert!((0..3).all(|ahead| !is_due(&run, ahead)));
    let worst_before = run.restart_state.ledger.worst_residual;
    // A node at the pole of the lower body is pushed into the other.
    let pole = model.contact().pushed_nodes(0)[0] as usize;
    run.advance(1);
    run.restart_state.state.bodies[0].displacement[pole][1] += 1e-3;
    run.advance(1);
    let ledger = &run.restart_state.ledger;
    assert!(ledger.worst_residual > 10.0 * worst_before + 1e-6, "{:e}", ledger.worst_residual);
    assert!(ledger.growth > 1e-6 && ledger.growth <= ledger.worst_residual);
}

/// Values that no file can hold.
#[test]
fn a_restart_state_with_nan_or_another_approach_is_refused() {
    let model = model();
    let mut run = Run::new(&model, EXPECTED, &request(COUNT));
    run.advance(100);
    type Damage = (&'static str, fn(&mut RunState));
    let damages: [Damage; 4] = [
        ("nothing", |_| ()),
        ("time", |state| state.state.time = f64::NAN),
        ("first contact", |state| state.log.first_contact = Some(f64::NAN)),
        ("last row", |state| state.sampled.last.as_mut().unwrap().time = f64::NAN),
    ];
    for (what, damage) in damages {
        let mut state = run.restart_state.clone();
        damage(&mut state);
        assert_eq!(state.fits(&model), what == "nothing", "{what}");
    }
}
