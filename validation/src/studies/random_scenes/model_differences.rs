//! Differences of explicit elements, condensed bodies and Ting's model of finite spheres in random scenes.
//!
//! Two models may differ by the tolerances of the claim, plus three times the estimated changes by effects that one
//! model has and the other lacks (closed forms that are good within a factor of three), plus a share of the energy of
//! waves that a model has only as a term. Scenes of `default_seeds` and `extreme_seeds` have the default settings, and
//! both error bars take the place of the tolerances; bodies of `extreme_seeds` differ much. Scenes with larger
//! differences count as `unexplained`, those with default settings as `beyond_bars`, unless the cheaper model warned of
//! its result. `NAME.median` is the median |Δe| of a pair of models.

use fem::effects::{EffectDecision, NeglectError, PartnerWaves};
use fem::{Estimate, Simulation};
use fem_case::{Case, CaseError};
use fem_collision::{Collision, QuantityOfInterest};
use rayon::prelude::*;
use serde::Deserialize;

use super::{
    Random,
    linear_scenes::{Ratios, overrides},
    load,
};
use crate::{Findings, Laboratory, StudyError};

/// Factor within which the closed forms of neglected effects are accurate.
const ESTIMATED_WITHIN: f64 = 3.0;
/// Relative accuracy of the terms for waves that do not return (docs/theory.md).
const RADIATION_WITHIN: f64 = 0.15;
/// The models, from the most complete to the cheapest.
const MODELS: [&str; 3] = ["fem={}", "condensed={}", "ting={finite_size=true}"];
/// Number of worst scenes in the table of each pair.
const N_SHOWN: usize = 5;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seeds: Vec<u64>,
    /// Seeds of scenes with the default settings.
    default_seeds: Vec<u64>,
    /// Seeds of scenes with the default settings whose bodies differ much.
    extreme_seeds: Vec<u64>,
    /// Number of scenes per seed.
    scenes: usize,
    /// Number of scenes per seed of `extreme_seeds`.
    extreme_scenes: usize,
    /// Tolerances for explicit against condensed, and condensed against Ting's model.
    explicit: Tolerance,
    ting: Tolerance,
}

/// Allowed difference of two models with the same effects: |Δe|, relative contact time and peak force.
#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    restitution: f64,
    contact_time: f64,
    peak_force: f64,
}

/// Source of mesh and time step of a scene.
#[derive(Clone, Copy, PartialEq)]
enum Settings {
    Claim,
    Default,
}

impl Tolerance {
    fn shares(self) -> [f64; 3] {
        [self.restitution, self.contact_time, self.peak_force]
    }
}

struct Ran {
    simulation: Simulation,
    collision: Collision,
}

/// Difference of two models in one scene.
struct Difference {
    scene: String,
    settings: Settings,
    off: [f64; 3],
    /// Largest difference over the allowed one.
    share: f64,
    /// Whether the difference is too large and the cheaper model warned.
    warns: bool,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let mut scenes = Vec::new();
    for (seeds, settings, ratios, n) in [
        (&parameters.seeds, Settings::Claim, Ratios::Usual, parameters.scenes),
        (&parameters.default_seeds, Settings::Default, Ratios::Usual, parameters.scenes),
        (&parameters.extreme_seeds, Settings::Default, Ratios::Extreme, parameters.extreme_scenes),
    ] {
        for &seed in seeds {
            let mut random = Random::new(seed);
            scenes.extend((0..n).map(|_| (settings, overrides(&mut random, ratios))));
        }
    }
    let pairs = [("explicit", [0, 1], parameters.explicit), ("ting", [1, 2], parameters.ting)];
    // The models and fields of a scene are not kept.
    let compared = scenes.par_iter().map(|(settings, set)| {
        let [fem, condensed, ting] = MODELS.map(|model| run(laboratory, *settings, set, model));
        let runs = [fem?, condensed?, ting?];
        let differences = pairs.map(|(_, pair, tolerance)| {
            let [ours, theirs] = pair.map(|k| runs[k].as_ref().ok());
            Some(difference(set, *settings, [ours?, theirs?], tolerance))
        });
        let stopped: Vec<String> = runs.into_iter().filter_map(Result::err).collect();
        Ok::<_, StudyError>((differences, stopped))
    });
    let compared = compared.collect::<Result<Vec<_>, _>>()?;
    let (differences, stopped): (Vec<_>, Vec<_>) = compared.into_iter().unzip();
    let mut findings = Findings::new();
    findings.measure("scenes", scenes.len() as f64);
    for (k, (name, ..)) in pairs.into_iter().enumerate() {
        let mut differences: Vec<&Difference> =
            differences.iter().filter_map(|pairs| pairs[k].as_ref()).collect();
        findings.measure(format!("{name}.compared"), differences.len() as f64);
        // A NaN is beyond every limit.
        let is_within = |one: &&Difference| one.share <= 1.0;
        let beyond = differences.iter().copied().filter(|one| !is_within(one));
        let (warned, beyond): (Vec<&Difference>, Vec<&Difference>) =
            beyond.partition(|one| one.warns);
        let (unexplained, beyond_bars): (Vec<&Difference>, Vec<&Difference>) =
            beyond.into_iter().partition(|one| one.settings == Settings::Claim);
        findings.measure(format!("{name}.warned"), warned.len() as f64);
        findings.measure(format!("{name}.unexplained"), unexplained.len() as f64);
        findings.measure(format!("{name}.beyond_bars"), beyond_bars.len() as f64);
        differences.sort_by(|a, b| a.off[0].abs().total_cmp(&b.off[0].abs()));
        let median =
            differences.get(differences.len() / 2).map_or(f64::NAN, |one| one.off[0].abs());
        findings.measure(format!("{name}.median"), median);
        differences.sort_by(|a, b| b.share.total_cmp(&a.share));
        let rows = differences.iter().take(N_SHOWN).map(|one| {
            let [e, time, force] = one.off.map(|off| format!("{off:.1e}"));
            let verdict = if one.warns { "warned of" } else { "" };
            [one.scene.clone(), e, time, force, format!("{:.2}", one.share), verdict.to_string()]
        });
        findings.tabulate(
            format!("{name}: the scenes with the largest differences over the explained ones."),
            ["scene", "Δe", "ΔT/T", "ΔF/F", "over the allowed", ""],
            rows,
        );
    }
    let mut messages: Vec<String> = stopped.into_iter().flatten().collect();
    findings.measure("stopped", messages.len() as f64);
    messages.sort();
    messages.dedup();
    let rows = messages.into_iter().map(|message| [message]);
    findings.tabulate(
        "Messages about the scenes that a model does not compute.",
        ["message"],
        rows,
    );
    Ok(findings)
}

/// Runs a collision; returns the message if it is rejected or stopped.
fn run(
    laboratory: &Laboratory,
    settings: Settings,
    set: &[String],
    model: &str,
) -> Result<Result<Ran, String>, StudyError> {
    let mut all = Vec::new();
    if let Settings::Default = settings {
        all.push("accuracy={}".to_string());
    }
    all.extend_from_slice(set);
    all.push(format!("model={{{model}}}"));
    let case = load(laboratory, &all)?;
    laboratory.work(|| {
        let ran = case.and_then(collide).unwrap_or_else(|error| Err(error.to_string()));
        let updates = ran.as_ref().ok().and_then(|ran| ran.collision.element_updates);
        Ok((ran, updates.unwrap_or(0)))
    })
}

fn collide(case: Case) -> Result<Result<Ran, String>, CaseError> {
    let simulation = Simulation::new(case)?.without_snapshots();
    let collision = simulation.run(&mut ());
    if let Some(stop) = collision.stop() {
        return Ok(Err(stop.to_string()));
    }
    Ok(Ok(Ran { simulation, collision }))
}

/// Returns the difference of the cheaper model (`theirs`), over the allowed one.
fn difference(
    set: &[String],
    settings: Settings,
    [ours, theirs]: [&Ran; 2],
    tolerance: Tolerance,
) -> Difference {
    let base = match settings {
        Settings::Claim => tolerance.shares(),
        Settings::Default => bars(ours, theirs),
    };
    let hertz = &ours.simulation.setup().estimate.hertz;
    let numbers = |ran: &Ran| {
        let collision = &ran.collision;
        // A contact without an end has no time to compare.
        let time = collision.contact_time.map(|time| time / hertz.contact_time());
        [collision.restitution, time, collision.peak_force.map(|force| force / hertz.peak_force())]
    };
    let (a, b) = (numbers(ours), numbers(theirs));
    let (explained, waves) = (explained(ours, theirs), waves(theirs));
    let off = [0, 1, 2].map(|k| match (a[k], b[k]) {
        (Some(ours), Some(theirs)) => theirs - ours,
        // The restitution shows whether a contact has no end.
        _ => 0.0,
    });
    let share =
        [0, 1, 2].map(|k| off[k].abs() / (base[k] + ESTIMATED_WITHIN * explained[k] + waves[k]));
    let share = share.into_iter().fold(0.0, fem_collision::nan_aware_max_abs);
    // Warnings need reference runs, which take longer than the collision: they are not computed if not needed.
    let is_within = share <= 1.0;
    let warns = !is_within && theirs.warns();
    Difference { scene: set.join(" "), settings, off, share, warns }
}

/// Returns the sum of both error bars, contact time and peak force over Hertz' values.
fn bars(ours: &Ran, theirs: &Ran) -> [f64; 3] {
    let hertz = &ours.simulation.setup().estimate.hertz;
    let of = |ran: &Ran| {
        let bars = ran.simulation.summary(&ran.collision).uncertainty;
        let scales = [1.0, hertz.contact_time(), hertz.peak_force()];
        let quantities = [
            QuantityOfInterest::Restitution,
            QuantityOfInterest::ContactTime,
            QuantityOfInterest::PeakForce,
        ];
        [0, 1, 2].map(|k: usize| bars.of(quantities[k]).discretisation.unwrap_or(0.0) / scales[k])
    };
    let (ours, theirs) = (of(ours), of(theirs));
    [0, 1, 2].map(|k: usize| ours[k] + theirs[k])
}

/// Returns the uncertainty of the terms for waves, contact time and peak force over Hertz' values.
fn waves(theirs: &Ran) -> [f64; 3] {
    let decisions = theirs.decisions();
    let waves = decisions.iter().find(|one| one.name == PartnerWaves::NAME && one.active);
    let Some(estimate) = theirs.simulation.estimate(&theirs.collision.approach) else {
        return [0.0; 3];
    };
    let effect = waves.and_then(|waves| theirs.simulation.neglect_error(waves, &estimate));
    let effect =
        effect.map_or([0.0; 3], |effect| shares(&effect, &estimate).map(Option::unwrap_or_default));
    effect.map(|share| RADIATION_WITHIN * share)
}

/// Returns the changes of restitution, and of contact time and peak force over Hertz' values.
fn shares(neglect_error: &NeglectError, estimate: &Estimate) -> [Option<f64>; 3] {
    let hertz = &estimate.hertz;
    [
        neglect_error.restitution,
        neglect_error.contact_time_s.map(|time| time / hertz.contact_time()),
        neglect_error.peak_force_n.map(|force| force / hertz.peak_force()),
    ]
}

/// Returns the estimated changes by effects that only one of two models has, over Hertz' values.
fn explained(ours: &Ran, theirs: &Ran) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (has, lacks) in [(ours, theirs), (theirs, ours)] {
        let Some(estimate) = has.simulation.estimate(&has.collision.approach) else { continue };
        let lacking = lacks.decisions();
        let is_lacking = |name: &str| !lacking.iter().any(|one| one.name == name && one.active);
        for decision in has.decisions().iter().filter(|one| one.active && is_lacking(one.name)) {
            let Some(neglect_error) = has.simulation.neglect_error(decision, &estimate) else {
                continue;
            };
            for (sum, share) in sum.iter_mut().zip(shares(&neglect_error, &estimate)) {
                *sum += share.unwrap_or(0.0);
            }
        }
    }
    sum
}

impl Ran {
    fn warns(&self) -> bool {
        !self.simulation.warnings(&self.collision).is_empty()
    }

    fn decisions(&self) -> Vec<EffectDecision> {
        self.simulation.decisions(&self.collision).all
    }
}
