//! Runs that are stopped, resumed from a restart state, or ended.

use std::sync::Arc;

use crate::common::{CONTACT_MODULUS, Pair, Watcher, assert_foreign, n_nodes, quantities, stored};
use fem_collision::{
    BodyInput, Collision, Ending, HistoryRow, OutputRequest, SnapshotInstant, SnapshotRequest,
    StepInstant, Stop,
};
use fem_explicit::{ExplicitBodies, Run, Settings, SmallStrainContact, collide};
use fem_material::ActsOn;
use fem_material::finite::HyperelasticLaw;
use fem_mesh::SphereMesh;

/// Elastic, relaxing with constant Poisson's ratio, relaxing in shear with two terms, that at finite strain and on a
/// massless boundary, and flowing.
fn materials() -> [Pair; 6] {
    let shear = Pair {
        relaxation: Some(ActsOn::Shear),
        terms: &[(0.3, 2e-5), (0.5, 1e-3)],
        ..Pair::small()
    };
    let finite = Pair { law: Some(HyperelasticLaw::NeoHooke), ..shear.clone() };
    let massless = Pair { method: SmallStrainContact::Massless, ..shear.clone() };
    let flowing =
        Pair { law: Some(HyperelasticLaw::Hencky), yield_strength: Some(3e8), ..Pair::small() };
    let all = Pair { relaxation: Some(ActsOn::All), ..Pair::small() };
    [Pair::small(), all, shear, finite, massless, flowing]
}

fn requests() -> [SnapshotRequest; 3] {
    let times = vec![1e-6, 30e-6, 1.0, 70e-6];
    let labels = SnapshotInstant::ALL.to_vec();
    [SnapshotRequest::Labels(labels), SnapshotRequest::Count(5), SnapshotRequest::Times(times)]
}

/// Everything is a number, so that equality is that of the bits but for the sign of zero.
fn assert_same(one: &Collision, other: &Collision) {
    assert!(one.history.iter().all(|row| row.residual.unwrap().is_finite()));
    assert_eq!(one, other);
}

/// Bodies and requests of every kind, before the first force, in compression, in separation and in flight.
#[test]
fn a_resumed_run_is_the_same_to_the_bit() {
    let requests = requests().into_iter().cycle();
    for (pair, snapshots) in materials().into_iter().zip(requests) {
        let pair = Pair { snapshots, gap: 1e-6, ..pair };
        let model = pair.model();
        let whole = pair.run_model(&model);
        let last = whole.last_contact.unwrap();
        let (mut seen, mut force) = ([0; 4], 0.0);
        let mut run = Run::new(&model, pair.expected(), &pair.request());
        while run.advance(97).is_none() {
            let now = run.progress().contact_force;
            let phase = match now {
                0.0 if run.restart_state().time() > last => 3,
                0.0 => 0,
                now => 1 + usize::from(now < force),
            };
            seen[phase] += 1;
            force = now;
            run = Run::resume(&model, stored(run.restart_state())).unwrap();
        }
        let resumed = run.finish();
        assert_same(&whole, &resumed);
        assert!(seen[1..].iter().all(|&n| n >= 2), "{seen:?}");
    }
}

/// The first steps have no force yet, the first snapshot of a gap lies before first touch.
#[test]
fn a_run_resumes_from_its_first_steps() {
    let times = SnapshotRequest::Times(vec![1e-6, 2.1e-6]);
    let pair = Pair { gap: 1e-6, snapshots: times, ..Pair::small() };
    let model = pair.model();
    let whole = pair.run_model(&model);
    assert_eq!(whole.snapshots[0].time, 1e-6);
    for n_steps in 0..5 {
        let mut run = Run::new(&model, pair.expected(), &pair.request());
        assert_eq!(run.advance(n_steps), None);
        assert_eq!(run.restart_state().step(), n_steps);
        let mut resumed = Run::resume(&model, stored(run.restart_state())).unwrap();
        assert_eq!(resumed.advance(u64::MAX), Some(&Ending::Parted));
        assert_same(&whole, &resumed.finish());
    }
}

/// A history that is thinned, a wall that moves, a contact that stops the run or does not end.
#[test]
fn stopped_thinned_and_moving_wall_runs_resume_to_the_bit() {
    let wall = Pair { velocities: [1.5, 1.0], ..Pair::small() };
    let wall_model = wall.model_of(wall.on_wall(0));
    let thinned = Pair { history_rows: 16, max_time: 150e-6, ..Pair::small() };
    let (outgrown, endless) = (Pair::outgrown(), Pair::endless());
    for (pair, model) in [
        (&wall, &wall_model),
        (&thinned, &thinned.model()),
        (&outgrown, &outgrown.model()),
        (&endless, &endless.model()),
    ] {
        assert_same(&pair.run_model(model), &pair.in_pieces(model, 211));
    }
    assert!(outgrown.run().outgrown_radius().is_some());
    let Some(&Stop::NoSeparation { at, .. }) = endless.run().stop() else { panic!("it parts") };
    assert!(at.time > 30e-6 && at.time < 31e-6, "{at:?}");
}

#[test]
fn a_restart_state_of_another_model_is_refused() {
    let pair = Pair::small();
    let model = pair.model();
    let mut run = Run::new(&model, pair.expected(), &pair.request());
    assert_eq!(run.advance(300), None);
    assert!(Run::resume(&model, run.restart_state().clone()).is_ok());
    let massless = Pair { method: SmallStrainContact::Massless, ..Pair::small() };
    for (other, what) in [
        (Pair { element_size: 100e-6, ..Pair::small() }.model(), "a finer mesh"),
        (Pair { step_factor: 0.8, ..Pair::small() }.model(), "a shorter step"),
        (Pair { candidate_radius: 0.6e-3, ..Pair::small() }.model(), "a larger region of contact"),
        (Pair { relaxation: Some(ActsOn::All), ..Pair::small() }.model(), "a relaxing body"),
        (Pair { velocities: [0.6, 0.0], ..Pair::small() }.model(), "another speed"),
        (Pair { gap: 1e-9, ..Pair::small() }.model(), "another gap"),
        (pair.model_of(pair.on_wall(0)), "a wall"),
        (massless.model(), "a boundary without mass"),
    ] {
        assert_foreign(what, &other, run.restart_state());
    }
}

/// Changes that leave sizes, step and approach as they are, and still change results.
#[test]
fn a_restart_state_of_a_slightly_different_model_is_refused() {
    let pair = Pair::small();
    let soft =
        Settings { contact_stiffness: CONTACT_MODULUS, mass_scaling: 0.0, ..pair.settings() };
    // The mesh with the node that is nearest to a place moved outward, m.
    let moved = |mesh: &SphereMesh, [r, y]: [f64; 2], by: f64| {
        let mut nodes = mesh.nodes().to_vec();
        let distance = |node: &[f64; 2]| (node[0] - r).hypot(node[1] - y);
        nodes.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()[0] += by;
        SphereMesh::import(mesh.radius(), nodes, mesh.quads().to_vec()).unwrap()
    };
    // A narrow element two layers below the surface sets the step, not the springs.
    let upper = moved(pair.sphere(1).mesh().unwrap(), [0.1e-3, 0.22e-3], 60e-6);
    let model = |mesh: &SphereMesh, settings: &Settings| {
        let sphere = BodyInput::Sphere { mesh: mesh.clone(), material: pair.material() };
        ExplicitBodies::new([BodyInput::Wall, sphere], pair.approach(), settings).unwrap()
    };
    let plain = model(&upper, &soft);
    let mut run = Run::new(&plain, pair.expected(), &pair.request());
    assert_eq!(run.advance(300), None);
    assert!(Run::resume(&model(&upper, &soft), stored(run.restart_state())).is_ok());

    let stiffness = 1.001 * soft.contact_stiffness;
    let stiffer = model(&upper, &Settings { contact_stiffness: stiffness, ..soft });
    let other_mesh = model(&moved(&upper, [3e-3, 8e-3], 1e-7), &soft);
    for (other, what) in [(stiffer, "stiffer springs"), (other_mesh, "another mesh")] {
        assert_eq!(other.time_step().to_bits(), plain.time_step().to_bits(), "{what}");
        assert_eq!(other.n_elements(), plain.n_elements());
        assert_foreign(what, &other, run.restart_state());
    }
}

/// Rows and snapshots as the whole run has them; the row of the stop is the last. The contact opens
/// for a moment at its beginning, which is not the last contact of a run that is left later.
#[test]
fn an_interrupted_run_is_the_beginning_of_the_whole() {
    for snapshots in requests() {
        let pair = Pair { snapshots, ..Pair::small() };
        let model = pair.model();
        let whole = pair.run_model(&model);
        let n_half = quantities(&whole).steps / 2;
        let mut watcher = Watcher { stop_at: n_half, seen: Vec::new() };
        let run = collide(&model, pair.expected(), &pair.request(), &mut watcher);
        assert!(run.is_interrupted());
        let (stop, rows) = run.history.split_last().unwrap();
        assert!(stop.time >= rows.last().unwrap().time);
        assert_eq!(rows, &whole.history[..rows.len()]);
        assert!(rows.len() > whole.history.len() / 3);
        let times: Vec<_> = run.snapshots.iter().map(|snapshot| snapshot.time).collect();
        if matches!(pair.snapshots, SnapshotRequest::Count(_)) {
            // Evenly over the contact as far as it went.
            assert_eq!(times.len(), 5);
            assert!(times[4] > 0.45 * whole.last_contact.unwrap(), "{times:?}");
        } else {
            assert!(run.snapshots.iter().all(|snapshot| whole.snapshots.contains(snapshot)));
            assert_eq!((times.len(), run.warnings.len()), (2, 2));
        }
    }
}

/// Runs that part, outgrow their region of contact, or do not part in time.
#[test]
fn an_ended_run_does_no_step_more() {
    let mut names = Vec::new();
    for pair in [Pair::small(), Pair::outgrown(), Pair::endless()] {
        let model = pair.model();
        let mut run = Run::new(&model, pair.expected(), &pair.request());
        assert_eq!(run.advance(10), None);
        assert_eq!(run.restart_state().ending(), None);
        let ending = run.advance(u64::MAX).unwrap().clone();
        let state = run.restart_state().clone();
        assert_eq!(state.ending(), Some(&ending));
        for n_steps in [0, 1, u64::MAX] {
            assert_eq!(run.advance(n_steps), Some(&ending));
            assert_eq!(run.restart_state(), &state);
        }
        // Nor does one that is resumed.
        let mut resumed = Run::resume(&model, stored(&state)).unwrap();
        assert_eq!(resumed.advance(100), Some(&ending));
        assert_eq!(resumed.restart_state(), &state);
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
fn run_finished_early_is_interrupted_at_its_step() {
    let pair = Pair::small();
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
            let at = StepInstant { time, step };
            assert_eq!(left.ending, Ending::Stopped(Stop::Interrupted { at }));
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
fn run_owning_its_model_moves_to_another_thread() {
    fn begun(pair: &Pair) -> Run<Arc<ExplicitBodies>> {
        Run::new(Arc::new(pair.model()), pair.expected(), &pair.request())
    }
    fn finished(mut run: Run<Arc<ExplicitBodies>>) -> Collision {
        while run.advance(64).is_none() {}
        assert_eq!(run.model().n_elements(), Pair::small().model().n_elements());
        run.finish()
    }
    let run = begun(&Pair::small());
    let elsewhere = std::thread::spawn(|| finished(run)).join().unwrap();
    assert_eq!(elsewhere, Pair::small().run());
}

/// The restart state contains what a restart needs and nothing else: no buffers, and no rows that are not requested.
#[test]
fn a_restart_state_grows_by_the_requested_output() {
    let pair = Pair::small();
    let model = pair.model();
    let run = |history_rows: usize, snapshots: SnapshotRequest, n_steps: u64| {
        let request = OutputRequest { history_rows, snapshots, ..pair.request() };
        let mut run = Run::new(&model, pair.expected(), &request);
        run.advance(n_steps);
        let n_bytes = postcard::to_stdvec(run.restart_state()).unwrap().len();
        (n_bytes, run.finish().history.len() * size_of::<HistoryRow>())
    };
    let [start, end] = [0, u64::MAX].map(|n_steps| run(0, SnapshotRequest::none(), n_steps).0);
    // Displacement and velocity of each node, and a few hundred bytes beside: parts that are off are absent.
    let n_state = 2 * 16 * n_nodes(&model);
    assert!((n_state..n_state + 700).contains(&start), "{start} {n_state}");
    // Numbers of the state that differ in length, a row, and the pulse: four numbers an instant observed.
    assert!(end < start + 500 + 32 * 2 * OutputRequest::ROWS, "{start} {end}");
    // One state: two fields of each body.
    let label = SnapshotRequest::Labels(vec![SnapshotInstant::LastContact]);
    let (ended, rows) = run(20, label, u64::MAX);
    assert!(ended < end + 3 * 16 * n_nodes(&model) + rows + 1000, "{ended} {end} {rows}");
}
