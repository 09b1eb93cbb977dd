//! A run that continues from a wrong motion stops at once and says when, where and why.

use fem::{Identity, RestartState, checkpoint, restart_state_of};
use serde_json::Value;

use crate::common::Place;

const RESTART_FILE: &str = "fem-run.restart";

/// Small strain with massless contact nodes, with penalty springs, and finite strain.
const SCENES: [&str; 3] = [
    "--set mesh.contact_element_size=1e-4",
    "--set mesh.contact_element_size=1e-4 --set contact.method=penalty",
    "--set effects.finite_strain=on --set body.0.approach_speed=20 --set mesh.contact_element_size=4e-4",
];

/// Returns the restart state that a killed run of this scene leaves, and its identity.
fn left_in(place: &Place, set: &str) -> (RestartState, Identity) {
    let mut bytes = Vec::new();
    // The file of a short run may exist too briefly to be read.
    for _ in 0..100 {
        let keep = "case.toml --out out --checkpoint-every 0 --quiet";
        let mut run = place.command((keep, set)).spawn().unwrap();
        while bytes.is_empty() && run.try_wait().unwrap().is_none() {
            bytes = std::fs::read(place.path("out").join(RESTART_FILE)).unwrap_or_default();
        }
        let _ = run.kill();
        run.wait().unwrap();
        let _ = std::fs::remove_dir_all(place.path("out"));
        if !bytes.is_empty() {
            break;
        }
    }
    let line = bytes.iter().position(|byte| *byte == b'\n').expect("a restart file");
    let head: Value = serde_json::from_slice(&bytes[..line]).unwrap();
    let text = |key: &str| head[key].as_str().unwrap().to_string();
    let identity = Identity { case: text("case"), result: text("result") };
    (restart_state_of(&bytes, &identity).unwrap(), identity)
}

/// Returns the velocities of the lower body in a restart state, in the order of its bytes.
fn velocities(state: &RestartState) -> Vec<f64> {
    let state = serde_json::to_value(state).unwrap();
    let list = state["contact"]["state"]["bodies"][0]["velocity"].as_array().unwrap();
    list.iter().flat_map(|v| v.as_array().unwrap()).map(|v| v.as_f64().unwrap()).collect()
}

/// Changes a velocity by its index.
type Change = fn(usize, f64) -> f64;

/// Returns a restart state with other velocities of the lower body; NaN can only be set in its bytes.
fn with(state: &RestartState, change: Change) -> RestartState {
    let mut bytes = postcard::to_stdvec(state).unwrap();
    let old = velocities(state);
    let as_bytes = |values: &[f64]| -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    };
    let there = as_bytes(&old);
    let at = bytes.windows(there.len()).position(|window| window == there).unwrap();
    let new: Vec<f64> = old.iter().enumerate().map(|(k, v)| change(k, *v)).collect();
    bytes[at..at + there.len()].copy_from_slice(&as_bytes(&new));
    postcard::from_bytes(&bytes).unwrap()
}

/// Continues from a restart state; returns the messages and the summary.
fn gone_on(place: &Place, set: &str, state: &RestartState, identity: &Identity) -> (String, Value) {
    let _ = std::fs::remove_dir_all(place.path("out"));
    std::fs::create_dir(place.path("out")).unwrap();
    std::fs::write(place.path("out").join(RESTART_FILE), checkpoint(identity, state)).unwrap();
    let ran = place.run(("case.toml --out out --restart", set));
    ran.tells("continuing from step");
    let summary = place.json("out/summary.json");
    assert_eq!(ran.code, Some(if summary["complete"] == true { 0 } else { 1 }), "{}", ran.stderr);
    (ran.stderr, summary)
}

/// Returns the number after "step" in the reason of a stop.
fn step_of(stopped: &str) -> u64 {
    let number = stopped.split("(step ").nth(1).and_then(|rest| rest.split(')').next());
    number.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{stopped}"))
}

#[test]
fn restart_with_altered_velocities_stops_with_energy_error() {
    for name in SCENES {
        let place = Place::new();
        let (state, identity) = left_in(&place, name);
        // Without a change the run completes, so the others stop because of theirs.
        let (stderr, summary) = gone_on(&place, name, &with(&state, |_, v| v), &identity);
        assert_eq!(summary["complete"], true, "{name}: {stderr}");
        let whole = summary["steps"].as_u64().unwrap();
        let faults: [(&str, Change); 3] = [
            ("times the initial energy: the time integration is unstable", |_, v| 1.5 * v),
            ("is not a number", |k, v| if k == 41 { f64::NAN } else { v }),
            ("is not a number", |k, v| if k == 40 { f64::INFINITY } else { v }),
        ];
        for (cause, change) in faults {
            let (stderr, summary) = gone_on(&place, name, &with(&state, change), &identity);
            let stopped = summary["stopped_because"].as_str().unwrap_or_else(|| panic!("{name}"));
            for word in [cause, "at ", "node ", "of the lower body", " position is r = "] {
                assert!(stopped.contains(word), "{name}: no “{word}” in {stopped}");
            }
            assert!(stderr.contains("at ") && stderr.contains("lower body"), "{name}: {stderr}");
            assert!(stderr.contains("help: "), "{name}, no remedy: {stderr}");
            // Within a few hundredths of the collision, since energies are checked at intervals.
            let after = step_of(stopped) - state.step();
            assert!(after <= 16 + whole / 30, "{name}: {after} steps later of {whole}: {stopped}");
            // The results so far are kept, with the last valid state.
            for key in ["restitution", "contact_time_s"] {
                assert!(summary[key].is_null(), "{name}: {key} = {}", summary[key]);
            }
            let files = place.list("out");
            let ends = |end: &str| files.iter().any(|file| file.ends_with(end));
            assert!(ends("history.csv") && ends(".pvd"), "{name}: {files:?}");
            assert!(ends("last-sound.vtu") && ends("last-sound.svg"), "{name}: {files:?}");
            let history = place.text("out/history.csv");
            assert!(!history.contains("NaN") && !history.contains("inf"), "{name}: {history}");
        }
    }
}
