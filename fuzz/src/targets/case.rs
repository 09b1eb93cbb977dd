//! The text of a case with overrides, from reading to the first steps of a run.

use fem::effects::EFFECTS;
use fem::{Case, Cost, Monitor, Progress, QuantityOfInterest, Simulation};

use super::{cases, root};
use crate::mutate::{Random, change_text};
use crate::trial::{Taken, Target, rejected};

/// Prefix of a line that is an override.
const SET: &str = "#--set ";
/// Largest number of element updates of a run that is started.
const DEAREST: u64 = 3_000_000;
/// Models that replace that of the case.
const MODELS: [&str; 12] = [
    "ting={}",
    "ting={finite_size=true}",
    "hertz={}",
    "auto={}",
    "condensed={}",
    "condensed={vibration_modes=3, penalty_springs=true}",
    "law={tsuji={e=0.9}}",
    "law={linear={k=1e7, c=30}}",
    "law={kuwabara_kono={}}",
    "law={hunt_crossley={e=0.5}}",
    "law={power={k=3e9, gamma=1.5, c=3e4, n=0.5}}",
    "fem={}",
];

pub struct CaseText {
    seeds: Vec<Vec<u8>>,
}

impl CaseText {
    pub fn new() -> Self {
        Self { seeds: cases() }
    }
}

impl Target for CaseText {
    fn make(&self, random: &mut Random) -> Vec<u8> {
        let mut text = self.seeds[random.below(self.seeds.len())].clone();
        change_text(&mut text, &self.seeds, random);
        let mut overrides = format!("\n{SET}model={{{}}}\n", random.one_of(&MODELS));
        if random.once_in(2) {
            overrides += &format!("{SET}mesh.contact_element_size='1 mm'\n");
        }
        if random.once_in(10) {
            let mut strange = b"mesh.growth=2".to_vec();
            change_text(&mut strange, &self.seeds, random);
            overrides +=
                &format!("{SET}{}\n", String::from_utf8_lossy(&strange).replace('\n', " "));
        }
        text.extend(overrides.into_bytes());
        text
    }

    fn take(&self, input: &[u8]) -> Result<Taken, String> {
        let text = String::from_utf8_lossy(input);
        let overrides = text.lines().filter_map(|line| line.strip_prefix(SET));
        // Default limits would allow too long runs.
        let small = ["limits.elements=3000", "limits.memory='300 MB'"].map(String::from);
        let overrides: Vec<String> = overrides.map(String::from).chain(small).collect();
        match Case::parse("fuzzed.toml", &text, &root().join("cases"), &overrides) {
            Err(error) => rejected(&error.to_string()),
            Ok(case) => try_case(case),
        }
    }
}

/// Checks a valid case: it can be written and read again, planned and run.
pub(super) fn try_case(case: Case) -> Result<Taken, String> {
    let written =
        case.file().to_toml().map_err(|error| format!("it cannot be written: {error}"))?;
    let again = Case::parse("again.toml", &written, &root().join("cases"), &[]);
    let again = again.map_err(|error| format!("what it writes is no case: {error}"))?;
    // A valid scene has no NaN, which would not be equal to itself.
    if again.scene().bodies() != case.scene().bodies() {
        return Err("what it writes is another scene".to_string());
    }
    if let Err(error) = Simulation::resolve(&case) {
        return rejected(&error.to_string());
    }
    let simulation = match Simulation::new(case) {
        Err(error) => return rejected(&error.to_string()),
        Ok(simulation) => simulation,
    };
    look_at(&simulation)?;
    let is_cheap = match simulation.setup().cost {
        Cost::Steps { element_updates, .. } => element_updates < DEAREST,
        Cost::Factors { .. } | Cost::ClosedForm { .. } => true,
    };
    if !is_cheap {
        return Ok(Taken::Accepted);
    }
    let mut patience = Patience(2);
    let collision = simulation.run(&mut patience);
    for warning in simulation.warnings(&collision) {
        rejected(&warning)?;
    }
    let numbers = QuantityOfInterest::ALL.map(|quantity| quantity.of(&collision));
    match collision.stop() {
        Some(stop) => rejected(&stop.to_string()),
        None if numbers.into_iter().flatten().any(|number| !number.is_finite()) => {
            Err(format!("a run that ended by itself gives {numbers:?}"))
        }
        None => Ok(Taken::Accepted),
    }
}

/// Checks the plan that a user is shown before the run.
fn look_at(simulation: &Simulation) -> Result<(), String> {
    let setup = simulation.setup();
    for warning in simulation.warnings_before() {
        rejected(&warning)?;
    }
    for decision in &setup.decisions.all {
        if EFFECTS.iter().all(|effect| effect.name() != decision.name) {
            return Err(format!("an effect of no name, {}", decision.name));
        }
        simulation.neglect_error(decision, &setup.estimate);
    }
    let resolved = simulation.resolved().to_toml();
    let resolved = resolved.map_err(|error| format!("no resolved case: {error}"))?;
    let again = Case::parse("resolved.toml", &resolved, &root().join("cases"), &[]);
    let again = again.map_err(|error| format!("the resolved case is none: {error}\n{resolved}"))?;
    let again = Simulation::resolve(&again)
        .map_err(|error| format!("resolved, it is rejected: {error}"))?;
    let again = again.to_toml().map_err(|error| format!("no resolved case: {error}"))?;
    let pairs = again.lines().zip(resolved.lines());
    let differing: Vec<_> = pairs.filter(|(again, first)| again != first).take(3).collect();
    match again == resolved {
        true => Ok(()),
        false => Err(format!("resolved twice it is another case: {differing:?}")),
    }
}

/// Interrupts a run after this number of reports.
pub(super) struct Patience(pub u32);

impl Monitor for Patience {
    fn report(&mut self, _: Progress) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 > 0
    }
}
