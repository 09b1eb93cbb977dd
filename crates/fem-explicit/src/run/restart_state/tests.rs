//! Restart states that no run has written: rejected, or a run without panic.

use fem_collision::{BodyInput, SnapshotInstant, SnapshotRequest};
use fem_material::ActsOn;
use fem_mesh::Side;
use serde_json::Value;

use super::*;
use crate::error::ModelError;
use crate::run::Run;
use crate::test_support::{relaxing_glass, settings, sphere, unit_glass};

const EXPECTED: Expectation = Expectation { contact_time: 12.0, approach: 0.05 };

/// An elastic unit sphere below one that relaxes, at a hundredth of the wave's speed.
fn model() -> ExplicitBodies {
    let glasses = [unit_glass(), relaxing_glass(&[(0.5, 10.0)], ActsOn::Shear)];
    let mut glasses = glasses.into_iter();
    let bodies = [Side::Below, Side::Above].map(|side| BodyInput::Sphere {
        mesh: sphere(0.1, 0.15, side),
        material: glasses.next().unwrap(),
    });
    ExplicitBodies::new(bodies, Approach::at(0.01).unwrap(), &settings()).unwrap()
}

fn requests() -> [SnapshotRequest; 3] {
    let labels = SnapshotRequest::Labels(SnapshotInstant::ALL.to_vec());
    [labels, SnapshotRequest::Count(3), SnapshotRequest::Times(vec![0.5, 3.0, 1e3])]
}

fn request(snapshots: SnapshotRequest) -> OutputRequest {
    OutputRequest { history_rows: 20, snapshots, give_up_after: 5.0, ..OutputRequest::history() }
}

/// Returns the restart state after a number of steps, or at the end of the run.
fn state_after(model: &ExplicitBodies, snapshots: SnapshotRequest, n_steps: u64) -> RestartState {
    let mut run = Run::new(model, EXPECTED, &request(snapshots));
    run.advance(n_steps);
    run.restart_state().clone()
}

/// Calls with the place of every value, of long lists with those of the first and the last.
fn visit(value: &Value, place: &str, look: &mut dyn FnMut(&str, &Value)) {
    look(place, value);
    match value {
        Value::Array(list) => {
            for (k, one) in list.iter().enumerate() {
                if k == 0 || k + 1 == list.len() {
                    visit(one, &format!("{place}/{k}"), look);
                }
            }
        }
        Value::Object(fields) => {
            fields.iter().for_each(|(key, one)| visit(one, &format!("{place}/{key}"), look));
        }
        _ => {}
    }
}

/// Values to which a number could be damaged.
fn damages(value: &Value) -> Vec<Value> {
    match value {
        Value::Array(list) => {
            let without_last = &list[..list.len().saturating_sub(1)];
            let twice: Vec<_> = list.iter().chain(list).cloned().collect();
            vec![Value::Array(Vec::new()), without_last.into(), twice.into()]
        }
        Value::Number(number) if number.is_f64() => {
            vec![0.0.into(), (-1.0).into(), 1e300.into()]
        }
        Value::Number(_) => vec![0.into(), 1.into(), u64::MAX.into(), (u64::MAX / 2).into()],
        Value::Bool(is) => vec![Value::Bool(!is)],
        Value::Null => vec![],
        Value::String(_) | Value::Object(_) => vec![Value::Null],
    }
}

/// Every array truncated, emptied or doubled, every number another, one by one.
#[test]
fn a_damaged_restart_state_is_refused_or_runs() {
    let model = model();
    let n_end = state_after(&model, SnapshotRequest::none(), u64::MAX).step();
    let (mut n_refused, mut n_run) = (0, 0);
    let [labels, count, times] = requests();
    for (snapshots, n_steps) in [(labels, n_end / 2), (count, u64::MAX), (times, 0)] {
        let whole = serde_json::to_value(state_after(&model, snapshots, n_steps)).unwrap();
        let mut damaged = Vec::new();
        visit(&whole, "", &mut |place, value| {
            damaged.extend(damages(value).into_iter().map(|other| (place.to_string(), other)));
        });
        for (place, other) in damaged {
            let mut damaged_state = whole.clone();
            *damaged_state.pointer_mut(&place).unwrap() = other;
            let Ok(read) = serde_json::from_value(damaged_state) else { continue };
            match Run::resume(&model, read) {
                Err(refused) => {
                    assert_eq!(refused, ModelError::ForeignRestartState);
                    n_refused += 1;
                }
                Ok(mut run) => {
                    run.advance(10);
                    run.finish();
                    n_run += 1;
                }
            }
        }
    }
    // Both happen, many times; an error in the walk over the values is seen here.
    assert!(n_refused > 100 && n_run > 100, "{n_refused} {n_run}");
}

/// Entries that are stored twice or follow from the model: a contradiction is found.
#[test]
fn parts_that_contradict_each_other_are_refused() {
    let model = model();
    let whole = state_after(&model, SnapshotRequest::Times(vec![3.0, 0.5]), 100);
    assert!(whole.fits(&model));
    let mut text = serde_json::to_value(&whole).unwrap();
    for (place, other) in [
        ("/sampled/standstill/speed", 0.02.into()),
        ("/sampled/standstill/reduced_mass", 1.0.into()),
        ("/request/history_rows", 0.into()),
        ("/request/snapshots/Times/0", 0.25.into()),
        ("/recorder/request/Times/0", 0.25.into()),
    ] {
        let before = std::mem::replace(text.pointer_mut(place).unwrap(), other);
        let read: RestartState = serde_json::from_value(text.clone()).unwrap();
        assert!(!read.fits(&model), "{place}");
        *text.pointer_mut(place).unwrap() = before;
    }
    assert!(serde_json::from_value::<RestartState>(text).unwrap().fits(&model));
}

/// Values that JSON cannot represent.
#[test]
fn a_time_that_is_no_number_is_refused() {
    let model = model();
    let whole = state_after(&model, SnapshotRequest::Count(3), 100);
    assert!(whole.fits(&model));
    type Damage = (&'static str, fn(&mut RestartState));
    let damages: [Damage; 5] = [
        ("time", |state| state.state.time = f64::NAN),
        ("longest time", |state| state.request.give_up_after = f64::NAN),
        ("first contact", |state| state.log.first_contact = Some(f64::NAN)),
        ("last row", |state| state.sampled.last.as_mut().unwrap().time = f64::NAN),
        ("approach", |state| state.approach = Approach::at(0.02).unwrap()),
    ];
    for (what, damage) in damages {
        let mut damaged_state = whole.clone();
        damage(&mut damaged_state);
        assert!(!damaged_state.fits(&model), "{what}");
    }
}

/// The restart state contains what a restart needs and nothing else: no buffers, and no rows that are not requested.
#[test]
fn a_restart_state_grows_by_the_requested_output() {
    let model = model();
    let n_bytes = |state: &RestartState| postcard::to_stdvec(state).unwrap().len();
    let n_nodes: usize = model.bodies().iter().map(|body| body.n_nodes()).sum();
    let bare = |n_steps: u64| {
        let request = OutputRequest { history_rows: 0, ..request(SnapshotRequest::none()) };
        let mut run = Run::new(&model, EXPECTED, &request);
        run.advance(n_steps);
        run.restart_state().clone()
    };
    // Numbers of the state that differ in length, a row, and the pulse: four numbers an instant observed.
    let n_observed = 2 * OutputRequest::ROWS;
    assert!(n_bytes(&bare(u64::MAX)) < n_bytes(&bare(0)) + 500 + 32 * n_observed);
    // One state: two fields of each body, a third of the one that relaxes.
    let ended =
        state_after(&model, SnapshotRequest::Labels(vec![SnapshotInstant::LastContact]), u64::MAX);
    let rows = size_of_val(ended.history.as_ref().unwrap().rows());
    assert!(n_bytes(&ended) < n_bytes(&bare(u64::MAX)) + 3 * 16 * n_nodes + rows + 1000);
}
