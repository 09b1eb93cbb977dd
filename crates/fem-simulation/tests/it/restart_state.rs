//! Restart states: every field of a run is written, and a run that is resumed gives the same results and files.

use fem_collision::{Collision, Expectation, OutputRequest};
use fem_explicit::Run;
use fem_simulation::results::{contact_csv, history_columns, history_csv, write_snapshots};
use fem_simulation::{Explicit, Identity, RestartState, Simulation, checkpoint, restart_state_of};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Debug;

use crate::scene::{DENTED_BALL, GLASS, RUBBER_BALL as BALL, simulation_of as simulation};

const COARSE: &str = "mesh={contact_element_size='0.4 mm', refined_radius='0.4 mm'}";

/// Returns scenes that together have everything that a restart state can hold.
fn simulations() -> Vec<(&'static str, Simulation)> {
    let shear = "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, decay_rate=2e4}]}";
    let ball = ["model.fem={}", "mesh={contact_element_size='0.6 mm', refined_radius='1.8 mm'}"];
    vec![
        ("glass", simulation(GLASS, &[COARSE])),
        ("shear", simulation(GLASS, &[COARSE, shear, "output.snapshots=5"])),
        ("viscosity", simulation(GLASS, &[COARSE, "effects.bulk_viscosity='on'"])),
        ("finite strain", simulation(GLASS, &[COARSE, shear, "effects.finite_strain='on'"])),
        ("probe", simulation(GLASS, &[COARSE, "output.probe=[{body='striker', r=0, y=0}]"])),
        ("ball", simulation(BALL, &ball)),
        ("dent", simulation(DENTED_BALL, &["gravity.spot='same'"])),
    ]
}

/// Returns the restart states of one run at these shares of it.
fn states(simulation: &Simulation, fractions: &[f64]) -> Vec<RestartState> {
    let mut stepper = simulation.start();
    let state = |fraction: &f64| {
        while stepper.progress().fraction < *fraction && stepper.advance(&mut ()) {}
        stepper.restart_state().unwrap()
    };
    fractions.iter().map(state).collect()
}

/// Returns the field names in a `Debug` text: words before a colon at the beginning of a line.
fn shown_fields(text: &str) -> BTreeSet<String> {
    let name = |line: &str| {
        let (name, _) = line.trim_start().split_once(": ")?;
        let is_name =
            name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        (is_name && !name.is_empty()).then(|| name.to_string())
    };
    text.lines().filter_map(name).collect()
}

fn written_fields(value: &Value, names: &mut BTreeSet<String>) {
    match value {
        Value::Array(list) => list.iter().for_each(|one| written_fields(one, names)),
        Value::Object(fields) => fields.iter().for_each(|(name, one)| {
            names.insert(name.clone());
            written_fields(one, names);
        }),
        _ => {}
    }
}

/// Returns the fields that `Debug` shows and that are not serialized.
fn unwritten_fields(value: &(impl Debug + Serialize)) -> Vec<String> {
    let mut written = BTreeSet::new();
    written_fields(&serde_json::to_value(value).unwrap(), &mut written);
    shown_fields(&format!("{value:#?}")).difference(&written).cloned().collect()
}

#[test]
fn an_unwritten_field_is_detected() {
    #[derive(Debug, Serialize)]
    struct Inner {
        kept: Vec<[f64; 2]>,
        #[serde(skip)]
        #[allow(dead_code, reason = "Debug shows it, nothing reads it")]
        lost_too: Vec<f64>,
    }
    #[derive(Debug, Serialize)]
    struct Outer {
        inner: [Option<Inner>; 1],
        #[serde(skip)]
        #[allow(dead_code, reason = "Debug shows it, nothing reads it")]
        lost: u64,
    }
    let inner = Inner { kept: vec![[1.0, 2.0]], lost_too: vec![3.0] };
    assert_eq!(unwritten_fields(&Outer { inner: [Some(inner)], lost: 1 }), ["lost", "lost_too"]);
}

/// Every field of a restart state is written (one with `#[serde(skip)]` would come back as at the start), and a checkpoint
/// keeps every bit.
#[test]
fn a_checkpoint_keeps_every_field_and_bit() {
    let mut all = BTreeSet::new();
    for (name, simulation) in simulations() {
        let run = Identity::of(simulation.case()).unwrap();
        let states = states(&simulation, &[0.0, 0.3, 0.6]);
        for state in &states {
            let bytes = checkpoint(&run, state);
            let read = restart_state_of(&bytes, &run).unwrap();
            assert!(read == *state && checkpoint(&run, &read) == bytes, "{name}");
        }
        assert_eq!(unwritten_fields(&states[2]), [""; 0], "{name}: not written");
        all.extend(shown_fields(&format!("{:#?}", states[2])));
    }
    // The innermost fields are among those that were compared.
    for name in
        ["contact", "bounces", "displacement", "history", "recorder", "rest_criterion", "rows"]
    {
        assert!(all.contains(name), "{name} in {all:?}");
    }
}

#[test]
fn a_changed_checkpoint_is_refused() {
    let simulation = simulation(GLASS, &[COARSE]);
    let run = Identity::of(simulation.case()).unwrap();
    let bytes = checkpoint(&run, &states(&simulation, &[0.3])[0]);
    let n_head = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    let of_body = (n_head + 1..bytes.len()).step_by(bytes.len() / 20);
    let mut n_same = 0;
    for at in (0..n_head).chain(of_body) {
        let mut changed = bytes.clone();
        changed[at] ^= 1;
        // The identity of the case is not compared here.
        n_same += usize::from(restart_state_of(&changed, &run).is_ok());
        assert!(restart_state_of(&bytes[..at], &run).is_err(), "{at}");
    }
    assert_eq!(n_same, run.case.len());
}

/// A rubber ball at finite strain on a plastic ball at small strain: kept snapshots have stresses of one body only, and a
/// run that is stopped and resumed writes the same files.
#[test]
fn a_resumed_pair_with_one_body_at_finite_strain_writes_the_same_files() {
    const PAIR: &str = "
        material.rubber = { density = 1100, youngs_modulus = '5 MPa', poissons_ratio = 0.4, hyperelastic = 'neo-hooke' }
        material.plastic = { density = 1100, youngs_modulus = '1 GPa', poissons_ratio = 0.4 }
        body = [{ name = 'plastic', sphere.diameter = '2 cm', material = 'plastic' },
                { name = 'rubber', sphere.diameter = '2 cm', material = 'rubber', approach_speed = '5 m/s' }]
        model.fem = {}
        effects.rigid_partner = 'off'
        mesh.contact_element_size = '0.8 mm'
        output.snapshots = 6";
    let simulation = simulation::<&str>(PAIR, &[]);
    let explicit = Explicit::new(simulation.case().scene()).unwrap();
    let is_finite = explicit.bodies().bodies().each_ref().map(|body| body.n_finite_elements() > 0);
    assert_eq!(is_finite, [false, true]);

    let state = states(&simulation, &[0.6]).remove(0);
    let run = Identity::of(simulation.case()).unwrap();
    let state = restart_state_of(&checkpoint(&run, &state), &run).unwrap();
    let mut resumed = simulation.resume(state).unwrap();
    while resumed.advance(&mut ()) {}
    let (resumed, whole) = (resumed.finish(), simulation.run(&mut ()));
    assert_eq!(resumed, whole);
    assert_eq!(whole.snapshots.len(), 6);
    assert!(whole.snapshots.iter().all(|snapshot| {
        snapshot.bodies[0].stress.is_empty() && !snapshot.bodies[1].stress.is_empty()
    }));
    let files = |collision: &Collision| {
        let folder = tempfile::tempdir().unwrap();
        let (names, _) = write_snapshots(folder.path(), "pair", &simulation, collision).unwrap();
        let mut files: Vec<Vec<u8>> =
            names.iter().map(|name| std::fs::read(folder.path().join(name)).unwrap()).collect();
        let (mut history, mut contact) = (Vec::new(), Vec::new());
        history_csv(&mut history, &history_columns(simulation.case().scene(), &collision.history))
            .unwrap();
        contact_csv(&mut contact, &simulation, collision).unwrap();
        files.extend([history, contact]);
        files
    };
    assert_eq!(files(&resumed), files(&whole));
}

/// A ball that falls onto its own dent has the bodies of its first contact, whose parts depend on the speed.
#[test]
fn a_fall_onto_a_dent_is_resumed() {
    let simulation = simulation(DENTED_BALL, &["gravity.spot='same'"]);
    let run = Identity::of(simulation.case()).unwrap();
    let whole = simulation.run(&mut ());
    for state in states(&simulation, &[0.2, 0.45, 0.6, 0.8, 0.95]) {
        let state = restart_state_of(&checkpoint(&run, &state), &run).unwrap();
        let mut resumed = simulation.resume(state).unwrap();
        while resumed.advance(&mut ()) {}
        assert_eq!(resumed.finish(), whole);
    }
}

/// Calls with the place of every value, of lists with those of the first and the last.
fn visit(value: &Value, place: &str, look: &mut dyn FnMut(&str, &Value)) {
    look(place, value);
    let mut inside = |key: &str, one: &Value| visit(one, &format!("{place}/{key}"), look);
    match value {
        Value::Array(list) => {
            let ends = [0, list.len().saturating_sub(1)];
            let distinct = &ends[..if ends[1] > 0 { 2 } else { list.len() }];
            distinct.iter().for_each(|&k| inside(&k.to_string(), &list[k]));
        }
        Value::Object(fields) => fields.iter().for_each(|(key, one)| inside(key, one)),
        _ => {}
    }
}

/// Every array emptied, truncated or doubled, every number another, one by one.
#[test]
fn a_damaged_restart_state_is_refused_or_runs() {
    let simulation = simulation(GLASS, &[COARSE, "output.snapshots=3"]);
    let explicit = Explicit::new(simulation.case().scene()).unwrap();
    let hertz = &simulation.setup().estimate.hertz;
    let expected =
        Expectation { contact_time: hertz.contact_time(), approach: hertz.max_approach() };
    let request = OutputRequest { history_rows: 20, ..simulation.request().clone() };
    let mut run = Run::new(explicit.bodies(), expected, &request);
    while run.progress().fraction < 0.4 {
        run.advance(64);
    }
    let whole = serde_json::to_value(run.restart_state()).unwrap();
    let mut damaged: Vec<(String, Value)> = Vec::new();
    visit(&whole, "", &mut |place, value| {
        let others: Vec<Value> = match value {
            Value::Array(list) => {
                let without_last = &list[..list.len().saturating_sub(1)];
                vec![json!([]), without_last.into(), [&list[..], list].concat().into()]
            }
            Value::Number(number) if number.is_f64() => vec![json!(0.0), json!(-1.0), json!(1e300)],
            Value::Number(_) => vec![json!(0), json!(1), json!(u64::MAX)],
            Value::Bool(is) => vec![json!(!is)],
            _ => vec![Value::Null],
        };
        damaged.extend(others.into_iter().map(|other| (place.to_string(), other)));
    });
    let (mut n_refused, mut n_run) = (0, 0);
    for (place, other) in damaged {
        let mut state = whole.clone();
        *state.pointer_mut(&place).unwrap() = other;
        let Ok(read) = serde_json::from_value(state) else { continue };
        let Ok(mut run) = Run::resume(explicit.bodies(), read) else {
            n_refused += 1;
            continue;
        };
        run.advance(10);
        run.finish();
        n_run += 1;
    }
    // Both happen, many times; an error in the walk over the values is seen here.
    assert!(n_refused > 50 && n_run > 50, "{n_refused} {n_run}");
}

/// Entries that are stored twice or follow from the model: a contradiction is found.
#[test]
fn parts_that_contradict_each_other_are_refused() {
    let simulation = simulation(GLASS, &[COARSE, "output.snapshots=['30 us', '10 us']"]);
    let whole = serde_json::to_value(&states(&simulation, &[0.3])[0]).unwrap();
    let resume = |state: &Value| simulation.resume(serde_json::from_value(state.clone()).unwrap());
    assert!(resume(&whole).is_ok());
    for (end, other) in [
        ("/sampled/rest_criterion/speed", 0.02.into()),
        ("/sampled/rest_criterion/reduced_mass", 1.0.into()),
        ("/request/history_rows", 0.into()),
        ("/recorder/request/Times/0", 2.5e-5.into()),
        ("/approach/gap", 1.0.into()),
    ] {
        let mut damaged = whole.clone();
        visit(&whole, "", &mut |place, _| {
            if place.ends_with(end) {
                *damaged.pointer_mut(place).unwrap() = Value::clone(&other);
            }
        });
        assert!(damaged != whole && resume(&damaged).is_err(), "{end}");
    }
}
