//! Hard scenes: each axis of `validation/hard` goes from one extreme to the other, with every model that
//! supports the scene.
//!
//! An axis is a file next to the claim, [`Axis`]. The invariants of every run are measured, the worst of all runs as
//! `growth`, `momentum`, `excess`, `no_number` and `cost` ([`Trial`]); a run that may gain energy must warn of it.
//! `endurance.flight` and `endurance.vibration` concern one body ([`endurance`]). `AXIS.difference` is the largest
//! difference of a run from its reference, over the tolerance of its scene; `AXIS.unexpected` counts the runs that did
//! not end as the scene expects, or lack an expected warning.

mod axis;
mod endurance;
mod imported;
mod reference;
mod tables;
mod trial;

use std::path::Path;

use fem_case::CaseError;
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, RunFile, StudyError};
use axis::{Axis, Expected, Scene};
use endurance::endure;
use reference::Reference;
use tables::SceneResult;
use trial::{Outcome, Trial};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Names of the files next to the claim, without their ending.
    axes: Vec<String>,
    /// Whether only runs of milliseconds are made.
    #[serde(default)]
    quick: bool,
}

struct Entry<'a> {
    axis: usize,
    scene: &'a Scene,
    model: &'a str,
    expected: &'a Expected,
}

const ENDURANCE: usize = 1_000_000;

struct Tried {
    trial: Trial,
    reference: Option<Reference>,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let axes = parameters.axes.iter().map(|name| Axis::read(&laboratory.claim().folder, name));
    let axes = axes.collect::<Result<Vec<_>, _>>()?;
    let entries: Vec<Entry> = axes
        .iter()
        .enumerate()
        .flat_map(|(axis, file)| file.scene.iter().map(move |scene| (axis, scene)))
        .flat_map(|(axis, scene)| {
            let models = scene.model.iter();
            models.map(move |(model, expected)| Entry { axis, scene, model, expected })
        })
        .filter(|entry| !parameters.quick || entry.expected.quick)
        .collect();
    let folder = tempfile::tempdir().map_err(|error| StudyError::parameters(error.to_string()))?;
    let tried =
        entries.par_iter().map(|entry| entry.run(laboratory, &axes[entry.axis], folder.path()));
    let tried = tried.collect::<Result<Vec<_>, _>>()?;
    let mut findings = Findings::new();
    let n_steps = if parameters.quick { ENDURANCE / 100 } else { ENDURANCE };
    let [flight, vibration] = laboratory.work(|| endure(n_steps))?;
    findings.measure("endurance.flight", flight);
    findings.measure("endurance.vibration", vibration);
    findings.measure("runs", tried.len() as f64);
    let now = entries.iter().zip(&tried).map(|(entry, tried)| {
        let axis = parameters.axes[entry.axis].clone();
        let row = entry.row(tried, folder.path());
        SceneResult {
            key: [axis, entry.scene.name.clone(), entry.model.to_string()],
            restitution: row[3].clone(),
            outcome: row[10].clone(),
        }
    });
    let now: Vec<SceneResult> = now.collect();
    tables::tabulate_earlier_faults(
        &laboratory.claim().folder,
        &now,
        parameters.quick,
        &mut findings,
    )?;
    tables::tabulate_hostile_inputs(&laboratory.claim().folder, &mut findings)?;
    for (name, (axis, file)) in parameters.axes.iter().zip(axes.iter().enumerate()) {
        let own = || entries.iter().zip(&tried).filter(|(entry, _)| entry.axis == axis);
        findings.measure(format!("{name}.unexpected"), 0.0);
        findings.measure(format!("{name}.difference"), 0.0);
        for (entry, tried) in own() {
            entry.measure(tried, name, &mut findings)?;
        }
        let rows = own().map(|(entry, tried)| entry.row(tried, folder.path()));
        findings.tabulate(file.hard.clone(), HEADER, rows);
    }
    Ok(findings)
}

const HEADER: [&str; 11] = [
    "scene",
    "what is hard",
    "model",
    "e",
    "Δe",
    "ΔT/T",
    "ΔF/F",
    "Δp/p",
    "growth, momentum",
    "cost / announced",
    "outcome",
];

impl Entry<'_> {
    fn run(
        &self,
        laboratory: &Laboratory,
        axis: &Axis,
        folder: &Path,
    ) -> Result<Tried, StudyError> {
        let case = |scene: &Scene, model: &str| {
            let mut set = axis.set.clone();
            set.extend(scene.set.iter().cloned());
            for (k, imported) in scene.imported.iter().enumerate() {
                // Runs are parallel, so each has its own file.
                let run = [&self.scene.name, self.model, &scene.name, model].map(str::as_bytes);
                let name = format!("{}_{k}", &fem::digest_of(run)[..16]);
                let written = imported.write(folder, &name);
                set.push(written.map_err(|error| CaseError::new(name, error.to_string()))?);
            }
            set.push(format!("model={{{model}}}"));
            laboratory.claim().load_case(&RunFile { case: axis.case.clone(), set })
        };
        let trial = Trial::of(laboratory, case(self.scene, self.model))?;
        let reference = match &self.scene.against {
            None => None,
            Some(against) => {
                let other = |name: &str| {
                    let scene = axis.scene.iter().find(|scene| scene.name == name);
                    let missing =
                        || format!("no scene `{name}` to hold `{}` against", self.scene.name);
                    scene.ok_or_else(|| StudyError::parameters(missing()))
                };
                Some(Reference::of(against, self.scene, self.model, laboratory, case, other)?)
            }
        };
        Ok(Tried { trial, reference })
    }

    /// Returns the differences from the reference over the allowed ones.
    fn differences(&self, tried: &Tried) -> Option<[Option<(f64, f64)>; 4]> {
        let (ours, reference) = (tried.trial.numbers()?, tried.reference?);
        let expected = self.expected;
        // No scene restricts the peak pressure, which depends mostly on the mesh at the edge.
        let allowed = [expected.restitution, expected.contact_time, expected.peak_force, None];
        Some([0, 1, 2, 3].map(|k| {
            let off = reference.difference(&ours, k)?;
            Some((off, allowed[k].map_or(0.0, |allowed| off.abs() / allowed)))
        }))
    }

    fn measure(
        &self,
        tried: &Tried,
        axis: &str,
        findings: &mut Findings,
    ) -> Result<(), StudyError> {
        if self.expected.gains.is_some() && self.expected.says.is_empty() {
            let silent = format!("`{}` may gain energy and need not say so", self.scene.name);
            return Err(StudyError::parameters(silent));
        }

        if !self.is_as_expected(tried) {
            *findings.quantities.entry(format!("{axis}.unexpected")).or_default() += 1.0;
        }
        for (_, share) in self.differences(tried).into_iter().flatten().flatten() {
            findings.measure_worst(&format!("{axis}.difference"), share);
        }
        let trial = &tried.trial;
        if let (Some(most), Some(growth)) = (self.expected.gains, trial.growth()) {
            findings.measure_worst(&format!("{axis}.difference"), growth / most);
        }
        let gains = self.expected.gains.is_some();
        for (quantity, value) in [
            ("growth", trial.growth().filter(|_| !gains)),
            ("momentum", trial.momentum()),
            ("excess", trial.excess().filter(|_| !gains)),
            ("no_number", trial.no_number()),
            ("cost", trial.cost().map(|share| share.max(share.recip()))),
        ] {
            if let Some(value) = value {
                findings.measure_worst(quantity, value);
            }
        }
        Ok(())
    }

    /// Whether the run ended as expected and has the expected warnings.
    fn is_as_expected(&self, tried: &Tried) -> bool {
        match (&tried.trial.outcome, &self.expected.refuses) {
            (Outcome::Ran { .. }, Some(_)) => false,
            (Outcome::Ran { warnings, .. }, None) => {
                let says = |text: &String| warnings.iter().any(|warning| warning.contains(text));
                self.expected.says.iter().all(says)
            }
            (Outcome::Rejected(message), Some(text)) => message.contains(text),
            (Outcome::Rejected(_), None) => false,
        }
    }

    fn row(&self, tried: &Tried, folder: &Path) -> [String; 11] {
        let trial = &tried.trial;
        let number =
            |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.1e}"));
        let differences = self.differences(tried).unwrap_or_default();
        let [e, time, force, pressure] = differences.map(|two| number(two.map(|(off, _)| off)));
        let invariants: Vec<String> = [trial.growth(), trial.momentum()]
            .into_iter()
            .flatten()
            .map(|it| number(Some(it)))
            .collect();
        let verdict = if self.is_as_expected(tried) { "" } else { "UNEXPECTED: " };
        [
            self.scene.name.clone(),
            self.scene.hard.clone(),
            self.model.to_string(),
            trial.restitution().map_or(String::new(), |e| format!("{e:.6}")),
            e,
            time,
            force,
            pressure,
            invariants.join(", "),
            trial.cost().map_or(String::new(), |share| format!("{share:.2}")),
            format!("{verdict}{}", trial.words(folder)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::{Observer, ResultCache, evaluate, load_claims};

    struct Nobody;

    impl Observer for Nobody {
        fn clock(&self) -> f64 {
            0.0
        }
        fn is_interrupted(&self) -> bool {
            false
        }
    }

    /// The half of the suite that takes seconds; `fem-validate hard` runs all of it.
    #[test]
    #[ignore = "15 s; .ci/run runs it"]
    fn quick_half_of_the_hard_suite_passes() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut claims = load_claims(folder, &["hard".to_string()]).unwrap();
        let claim = &mut claims[0];
        claim.parameters.insert("quick".to_string(), true.into());
        let result = evaluate(claim, &ResultCache::default(), &Nobody);
        assert!(result.error.is_none(), "{:?}", result.error);
        assert!(result.findings.quantities["runs"] > 40.0);
        let table = || {
            let rows = result.findings.tables.iter().flat_map(|table| &table.rows);
            rows.map(|row| row.join(" | ")).collect::<Vec<_>>().join("\n")
        };
        for check in result.checks.iter().filter(|check| check.check.quantity != "runs") {
            assert!(check.passed, "{check:?}\n{}", table());
        }
    }
}
