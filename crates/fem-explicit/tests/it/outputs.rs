//! Output of a run: history, snapshots, progress, and the reason of a stop.

use crate::common::{COARSE_RUN, Pair, Watcher, quantities};
use fem_collision::{
    Account, Approach, BodyInput, Collision, Ending, HistoryRow, SnapshotInstant, SnapshotRequest,
    StepInstant, Stop,
};
use fem_contact::ContactError;
use fem_explicit::{ExplicitBodies, ModelError, Settings, collide};
use fem_material::ActsOn;

fn assert_times_increase(run: &Collision) {
    let pairs = run.history.windows(2);
    assert!(pairs.clone().all(|pair| pair[0].time < pair[1].time), "{:?}", run.ending);
}

/// A history has about a thousand rows over the contact, first and last contact among them.
fn assert_history(run: &Collision) {
    let (first, last) = (run.first_contact.unwrap(), run.last_contact.unwrap());
    assert_times_increase(run);
    let in_contact = |time: f64| (first..=last).contains(&time);
    let n = run.history.iter().filter(|row| in_contact(row.time)).count();
    // The stride is rounded down from 7.6 steps to 7.
    assert!((900..1300).contains(&n), "{n}");
    let closed: Vec<_> = run.history.iter().filter(|row| row.contact_force > 0.0).collect();
    assert_eq!(closed[0].time, first);
    assert_eq!(closed[closed.len() - 1].time, last);
    // A row belongs to one instant: its energies add up, its approach is that of its velocities.
    let peak = run.history.iter().max_by(|a, b| a.approach.total_cmp(&b.approach)).unwrap();
    assert!((peak.velocity[0] - peak.velocity[1]).abs() < 0.005 * 0.5, "{peak:?}");
    let found = quantities(run);
    assert!((peak.contact_force / found.peak_force - 1.0).abs() < 0.01);
    // The row of the end: after a fifth of the contact time without force.
    let end = run.history.last().unwrap();
    assert!((end.time - last) / found.contact_time >= 0.2);
    assert!((end.time - last) / found.contact_time < 0.21);
    assert_eq!(end.contact_force, 0.0);
    assert_eq!([end.contact_radius, end.centre_pressure], [Some(0.0); 2]);
    assert_eq!(end.energy(Account::Contact), Some(0.0));
    assert_eq!(end.velocity, found.velocity_after);
}

#[test]
fn labelled_snapshots_are_the_named_instants() {
    for relaxation in [None, Some(ActsOn::All)] {
        let snapshots = SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec());
        let pair = Pair { snapshots, relaxation, ..Pair::default() };
        let model = pair.model();
        let run = pair.run_model(&model);
        let found = quantities(&run);
        assert_history(&run);
        let labels: Vec<_> = run.snapshots.iter().map(|s| s.label.unwrap()).collect();
        assert_eq!(labels, SnapshotInstant::OF_CONTACT);
        let [compression, maximum, separation, last] = &run.snapshots[..] else { panic!() };
        for half in [compression, separation] {
            // The promise; 1.5 % is the ladder's, a step's 0.03 %.
            assert!((half.approach / (0.5 * found.max_approach) - 1.0).abs() < 0.02);
        }
        // A step beside the maximum is quadratically near it.
        assert!((maximum.approach / found.max_approach - 1.0).abs() < 1e-6);
        assert!(compression.time < maximum.time && maximum.time < separation.time);
        assert_eq!(Some(last.time), run.last_contact);
        // Approach and fields belong together: the far poles move with the mass centres to 0.7 %
        // of the approach, what a sphere's far side lags behind.
        for snapshot in [compression, maximum, separation] {
            let [lower, upper] = [0, 1].map(|side: usize| {
                let far_pole = *model.bodies()[side].mesh().unwrap().surface().last().unwrap();
                snapshot.bodies[side].displacement[far_pole as usize][1]
            });
            assert!(((lower - upper) / snapshot.approach - 1.0).abs() < 0.01);
        }
        // Under the centre the stress carries the contact pressure, whose nodal values read 3 % low.
        let at_maximum = |row: &&HistoryRow| row.time >= maximum.time;
        let pressure = run.history.iter().find(at_maximum).unwrap().centre_pressure.unwrap();
        // Hertz' −p₀ and −p₀(1 + 2ν)/2 for an elastic body, p₀ ∝ F^(1/3).
        let hertz = 1.0268e9 * (found.peak_force / 107.02).cbrt();
        for side in 0..2 {
            let body = &model.bodies()[side];
            let stress = body.stress(&maximum.bodies[side], Some(&maximum.contact));
            let [rr, yy, tt, ry] = stress.points[body.mesh().unwrap().surface()[0] as usize];
            assert!((yy / -pressure - 1.0).abs() < 0.06, "{yy:e} {pressure:e}");
            assert!(rr == tt && ry == 0.0);
            if relaxation.is_none() {
                // −0.4 and −3 % are measured; the element is a fifth of the contact radius wide.
                assert!((yy / -hertz - 1.0).abs() < 0.03, "{yy:e}");
                assert!((rr / (-0.744 * hertz) - 1.0).abs() < 0.05, "{rr:e}");
            }
        }
    }
}

/// Snapshots change nothing else; the recorder has its own tests of which states they are.
#[test]
fn output_does_not_disturb_the_run() {
    let plain = &*COARSE_RUN;
    for snapshots in [
        SnapshotRequest::Labels(SnapshotInstant::OF_CONTACT.to_vec()),
        SnapshotRequest::Count(6),
        SnapshotRequest::Times(vec![10e-6, 30e-6, 1.0, 70e-6]),
    ] {
        let run = Pair { snapshots: snapshots.clone(), ..Pair::coarse() }.run();
        assert_eq!(run.history, plain.history, "{snapshots:?}");
    }
}

#[test]
fn a_finished_run_reports_its_progress() {
    let pair = Pair::coarse();
    let mut watcher = Watcher { stop_at: u64::MAX, seen: Vec::new() };
    let run = collide(&pair.model(), pair.expected(), &pair.request(), &mut watcher);
    assert_eq!(run.ending, Ending::Parted);
    let found = quantities(&run);
    // Every 64 steps.
    assert_eq!(watcher.seen.len() as u64, found.steps / 64 + 1);
    assert!(watcher.seen.windows(2).all(|pair| pair[0].fraction <= pair[1].fraction));
    // The last tenth is for runs that take longer than expected.
    let last = watcher.seen.last().unwrap().fraction;
    assert!(watcher.seen[0].fraction == 0.0 && last > 0.88 && last < 1.0, "{last}");
    assert!(watcher.seen.iter().any(|progress| progress.contact_force > 0.5 * found.peak_force));
    assert_eq!(run.element_updates, Some(found.steps * pair.model().n_elements() as u64));
}

#[test]
fn contact_beyond_the_candidate_region_stops_the_run() {
    let pair = Pair { candidate_radius: 0.1e-3, ..Pair::coarse() };
    let run = pair.run();
    let Some(&Stop::ContactBeyondCandidates { at: StepInstant { time, .. }, radius, .. }) =
        run.stop()
    else {
        panic!("{:?}", run.ending)
    };
    assert_eq!(run.outgrown_radius(), Some(radius));
    assert_eq!(radius, pair.model().candidate_radius());
    assert_times_increase(&run);
    let last = run.history.last().unwrap();
    assert_eq!(last.time, time);
    let reached = last.contact_radius.unwrap();
    assert!(reached > 0.0 && reached <= radius);
    assert_eq!(run.restitution, None);
    assert!(run.stop().unwrap().to_string().contains("the edge of the region"));
}

#[test]
fn settings_out_of_range_are_refused() {
    let pair = Pair::coarse();
    let model = |approach: Approach, settings: &Settings| {
        ExplicitBodies::new([pair.sphere(0), pair.sphere(1)], approach, settings)
    };
    let (approach, good) = (pair.approach(), pair.settings());
    assert!(model(approach, &good).is_ok());
    let refuses = |refused: Result<ExplicitBodies, ModelError>, name: &str| match refused {
        Err(ModelError::Setting { name: found, .. }) => assert_eq!(found, name),
        other => panic!("{name}: {:?}", other.err()),
    };
    for (settings, name) in [
        (Settings { step_factor: 0.0, ..good }, "step factor"),
        (Settings { step_factor: 1.01, ..good }, "step factor"),
        (Settings { step_factor: f64::NAN, ..good }, "step factor"),
        (Settings { mass_scaling: -0.1, ..good }, "mass scaling"),
        (Settings { mass_scaling: 1.0, ..good }, "mass scaling"),
        (Settings { mass_scaling: f64::NAN, ..good }, "mass scaling"),
    ] {
        refuses(model(approach, &settings), name);
    }
    let refused = model(approach, &Settings { contact_stiffness: 0.0, ..good }).unwrap_err();
    assert!(matches!(refused, ModelError::Contact(ContactError::NotPositive { .. })));
    let walls =
        ExplicitBodies::new([BodyInput::Wall, BodyInput::Wall], approach, &good).unwrap_err();
    assert_eq!(walls, ModelError::Contact(ContactError::BothRigid));
}
