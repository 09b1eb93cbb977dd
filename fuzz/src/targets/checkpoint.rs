//! Restart files: mutated bytes, often with a valid digest.

use std::path::Path;

use fem::{Case, Identity, RestartState, Simulation, checkpoint, restart_state_of};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::case::Patience;
use crate::mutate::{Random, change_bytes};
use crate::trial::{Taken, Target, rejected};

const GLASS: &str = include_str!("../../../cases/glass_0.5ms.toml");
const BOUNCES: &str = include_str!("../../../cases/three_bounces.toml");

pub struct Checkpoint {
    runs: Vec<Run>,
}

/// A run, and its restart files.
struct Run {
    simulation: Simulation,
    identity: Identity,
    states: Vec<RestartState>,
}

impl Checkpoint {
    /// # Panics
    /// A case of the repository that cannot be begun.
    pub fn new() -> Self {
        let coarse =
            |size: &str| format!("mesh={{contact_element_size='{size}', refined_radius='{size}'}}");
        let runs = [
            (GLASS, vec![coarse("1 mm")]),
            (
                GLASS,
                vec![
                    coarse("1 mm"),
                    "effects.bulk_viscosity='on'".into(),
                    "output.snapshots=3".into(),
                ],
            ),
            (GLASS, vec![coarse("1.5 mm"), "effects.finite_strain='on'".into()]),
            (
                BOUNCES,
                vec![
                    coarse("1.5 mm"),
                    "model.fem={}".into(),
                    "effects.rigid_partner='auto'".into(),
                ],
            ),
        ];
        Self { runs: runs.map(|(text, overrides)| Run::of(text, &overrides)).into() }
    }
}

impl Run {
    fn of(text: &str, overrides: &[String]) -> Self {
        let case = Case::parse("case.toml", text, Path::new("."), overrides).expect("a case");
        let simulation = Simulation::new(case).expect("a simulation");
        let mut stepper = simulation.start();
        let mut states: Vec<RestartState> = stepper.restart_state().into_iter().collect();
        for share in [0.1, 0.5, 0.9] {
            while stepper.progress().fraction < share && stepper.advance(&mut ()) {}
            states.extend(stepper.restart_state());
        }
        let identity = Identity::of(simulation.case()).expect("an identity");
        Self { simulation, identity, states }
    }
}

impl Target for Checkpoint {
    /// Returns one byte for the run, and the restart file.
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let k = random.below(self.runs.len());
        let run = &self.runs[k];
        let state = &run.states[random.below(run.states.len())];
        let mut bytes = match random.below(4) {
            0 => {
                let mut bytes = checkpoint(&run.identity, state);
                change_bytes(&mut bytes, random);
                bytes
            }
            1 | 2 => {
                let mut bytes = checkpoint(&run.identity, state);
                let body = bytes.iter().position(|byte| *byte == b'\n').map_or(0, |end| end + 1);
                let mut changed = bytes.split_off(body);
                for _ in 0..=random.below(3) {
                    change_bytes(&mut changed, random);
                }
                whole(&bytes, &changed)
            }
            _ => {
                let mut value = serde_json::to_value(state).unwrap_or_default();
                for _ in 0..=random.below(3) {
                    change_value(&mut value, random);
                }
                let changed = serde_json::from_value(value).unwrap_or_else(|_| state.clone());
                checkpoint(&run.identity, &changed)
            }
        };
        bytes.insert(0, k as u8);
        bytes
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let Some((k, bytes)) = input.split_first() else { return Ok(Taken::Rejected) };
        let run = &self.runs[usize::from(*k) % self.runs.len()];
        let state = match restart_state_of(bytes, &run.identity) {
            Err(error) => return rejected(&error.to_string().replace(char::is_control, " ")),
            Ok(state) => state,
        };
        match run.simulation.resume(state) {
            Err(error) => rejected(&error.to_string()),
            Ok(mut stepper) => {
                let mut patience = Patience(4);
                for _ in 0..4 {
                    if !stepper.advance(&mut patience) {
                        break;
                    }
                }
                stepper.finish();
                Ok(Taken::Accepted)
            }
        }
    }
}

/// Returns a header with the digest of this body, and the body.
fn whole(head: &[u8], body: &[u8]) -> Vec<u8> {
    let mut value: Value = serde_json::from_slice(head).unwrap_or_default();
    let digest: String = Sha256::digest(body).iter().map(|byte| format!("{byte:02x}")).collect();
    value["sha256"] = digest.into();
    let mut bytes = value.to_string().into_bytes();
    bytes.push(b'\n');
    bytes.extend(body);
    bytes
}

/// Changes a number or the length of a list somewhere in a value.
fn change_value(value: &mut Value, random: &mut Random) {
    match value {
        Value::Object(fields) => {
            let n = fields.len();
            if let Some((_, value)) = fields.iter_mut().nth(random.below(n)) {
                change_value(value, random);
            }
        }
        Value::Array(list) if !list.is_empty() => {
            let k = random.below(list.len());
            match random.below(6) {
                0 => list.truncate(k),
                1 => list.push(list[k].clone()),
                2 => drop(list.remove(k)),
                _ => change_value(&mut list[k], random),
            }
        }
        Value::Number(number) => {
            let other: [Value; 8] = [
                0.into(),
                1.into(),
                u64::MAX.into(),
                u32::MAX.into(),
                1e300.into(),
                (-1.0).into(),
                5e-324.into(),
                (number.as_f64().unwrap_or(1.0) * -2.0).into(),
            ];
            *value = other[random.below(other.len())].clone();
        }
        Value::Bool(flag) => *flag = !*flag,
        Value::Null => *value = 1.into(),
        other => *other = Value::Null,
    }
}
