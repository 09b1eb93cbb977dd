//! A memory forgets nothing: every field that a run knows is in what is written of it.

use std::collections::BTreeSet;
use std::fmt::Debug;
use std::path::Path;

use fem::{Case, Identity, RestartState, Simulation, checkpoint, restart_state_of};
use serde::Serialize;
use serde_json::Value;

const BALL: &str = include_str!("rubber_ball.toml");
const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
const COARSE: &str = "mesh.contact_element_size='0.1 mm'";

/// Scenes that between them have all that a memory can hold.
fn simulations() -> Vec<(&'static str, Simulation)> {
    let simulation = |text: &str, overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let case = Case::parse("case.toml", text, Path::new("."), &overrides).unwrap();
        Simulation::new(case).unwrap()
    };
    let shear = "material.glass.relaxation={acts_on='shear', terms=[{weight=0.5, decay_rate=2e4}]}";
    let ball = ["model.fem={}", "mesh={contact_element_size='0.6 mm', refined_radius='1.8 mm'}"];
    vec![
        ("glass", simulation(GLASS, &[COARSE])),
        ("shear", simulation(GLASS, &[COARSE, shear, "output.snapshots=5"])),
        ("viscosity", simulation(GLASS, &[COARSE, "effects.bulk_viscosity='on'"])),
        ("finite strain", simulation(GLASS, &[COARSE, shear, "effects.finite_strain='on'"])),
        ("probe", simulation(GLASS, &[COARSE, "output.probe=[{body='striker', r=0, y=0}]"])),
        ("ball", simulation(BALL, &ball)),
    ]
}

/// After this share of the run.
fn memory_at(simulation: &Simulation, fraction: f64) -> RestartState {
    let mut course = simulation.start();
    while course.progress().fraction < fraction && course.advance(&mut ()) {}
    course.restart_state().unwrap()
}

/// The names of fields in a Debug text: words before a colon, at the beginning of a line.
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

/// Fields that the `Debug` of a value shows and that are not in what is written of it.
fn forgotten(value: &(impl Debug + Serialize)) -> Vec<String> {
    let mut written = BTreeSet::new();
    written_fields(&serde_json::to_value(value).unwrap(), &mut written);
    shown_fields(&format!("{value:#?}")).difference(&written).cloned().collect()
}

#[test]
fn a_field_that_is_not_written_is_seen() {
    #[derive(Debug, Serialize)]
    struct Inner {
        kept: Vec<[f64; 2]>,
        #[serde(skip)]
        #[allow(dead_code, reason = "Debug shows it, nothing reads it")]
        lost_too: Vec<f64>,
    }
    #[derive(Debug, Serialize)]
    struct Forgetful {
        inner: [Option<Inner>; 1],
        #[serde(skip)]
        #[allow(dead_code, reason = "Debug shows it, nothing reads it")]
        lost: u64,
    }
    let inner = Inner { kept: vec![[1.0, 2.0]], lost_too: vec![3.0] };
    assert_eq!(forgotten(&Forgetful { inner: [Some(inner)], lost: 1 }), ["lost", "lost_too"]);
}

/// One with `#[serde(skip)]` would come back as it was at the start.
#[test]
fn every_field_of_a_memory_is_written() {
    let mut all = BTreeSet::new();
    for (name, simulation) in simulations() {
        let memory = memory_at(&simulation, 0.6);
        assert_eq!(forgotten(&memory), [""; 0], "{name}: not written");
        all.extend(shown_fields(&format!("{memory:#?}")));
    }
    // The walk sees the innermost ones.
    for name in ["contact", "bounces", "displacement", "history", "recorder", "standstill", "rows"]
    {
        assert!(all.contains(name), "{name} in {all:?}");
    }
}

/// Of a restart file's bytes, and every bit of it.
#[test]
fn a_checkpoint_keeps_every_bit() {
    for (name, simulation) in simulations() {
        let run = Identity::of(simulation.case()).unwrap();
        for fraction in [0.0, 0.3, 0.9] {
            let memory = memory_at(&simulation, fraction);
            let read = restart_state_of(&checkpoint(&run, &memory), &run).unwrap();
            assert_eq!(format!("{read:?}"), format!("{memory:?}"), "{name}");
        }
    }
}

/// Whatever is changed in one, it is refused.
#[test]
fn a_changed_checkpoint_is_refused() {
    let (_, simulation) = simulations().remove(0);
    let run = Identity::of(simulation.case()).unwrap();
    let bytes = checkpoint(&run, &memory_at(&simulation, 0.3));
    let n_head = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    let of_body = (n_head + 1..bytes.len()).step_by(bytes.len() / 20);
    let mut n_same = 0;
    for at in (0..n_head).chain(of_body) {
        let mut changed = bytes.clone();
        changed[at] ^= 1;
        // Whose folder it lies in is not asked here.
        n_same += usize::from(restart_state_of(&changed, &run).is_ok());
        assert!(restart_state_of(&bytes[..at], &run).is_err(), "{at}");
    }
    assert_eq!(n_same, run.case.len());
}
