//! Random scenes: explicit elements, condensed bodies and Ting's impact of finite spheres side by side.
//!
//! Two models may differ by what the tolerances of the claim say, and by what the effects that one has
//! and the other lacks are worth by the plan's own closed forms, which are good within a factor of
//! three, and by a share of what waves take that a model has as a term only. Scenes of `default_seeds` have the
//! default settings, and what two models may differ by are both error bars; so have those of `extreme_seeds`, whose
//! bodies are far from alike. What is beyond is `unexplained`, of
//! scenes with default settings `beyond_bars`, unless the cheaper model warned of its result. `NAME.median` is
//! the median |Δe| of a pair of models.

use fem::effects::{LeftOut, PartnerWaves, Verdict};
use fem::{Estimate, Simulation};
use fem_case::{Case, CaseError};
use fem_collision::{Collision, Headline};
use rayon::prelude::*;
use serde::Deserialize;

use super::scenes::{Random, Ratios, overrides_of};
use crate::claim::RunFile;
use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Closed forms of what is left out are good within this factor.
const FORETOLD_WITHIN: f64 = 3.0;
/// Terms for waves that do not come back are within this share of what they take (docs/theory.md).
const RADIATION_WITHIN: f64 = 0.15;
/// From the most complete to the cheapest.
const MODELS: [&str; 3] = ["fem={}", "condensed={}", "ting={finite_size=true}"];
/// Worst scenes that are shown of each pair.
const N_SHOWN: usize = 5;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seeds: Vec<u64>,
    /// Of scenes with the default settings.
    default_seeds: Vec<u64>,
    /// Of scenes with the default settings whose bodies are far from alike.
    extreme_seeds: Vec<u64>,
    /// Of each seed.
    scenes: usize,
    /// Of each seed of those that are far from alike.
    extreme_scenes: usize,
    /// Of two pairs of models: explicit and condensed, condensed and Ting's.
    explicit: Tolerance,
    ting: Tolerance,
}

/// What two models may differ by, having the same effects: |Δe|, shares of contact time and force.
#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    restitution: f64,
    contact_time: f64,
    peak_force: f64,
}

/// Where mesh and steps of a scene come from.
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

/// A collision of one model.
struct Ran {
    simulation: Simulation,
    collision: Collision,
}

/// Two models of a scene.
struct Difference {
    scene: String,
    settings: Settings,
    off: [f64; 3],
    /// Over what is allowed.
    share: f64,
    /// Whether the cheaper model warned, of a share that is beyond what is allowed.
    warns: bool,
}

/// Runs random scenes.
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
            scenes.extend((0..n).map(|_| (settings, overrides_of(&mut random, ratios))));
        }
    }
    let pairs = [("explicit", [0, 1], parameters.explicit), ("ting", [1, 2], parameters.ting)];
    // What a scene takes, its bars too, is done at once, and its models and fields are not kept.
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
        // A share that is no number is beyond every limit.
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
            format!("{name}: the scenes that differ most, over what effects explain."),
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
        "What is said of the scenes that a model does not compute.",
        ["message"],
        rows,
    );
    Ok(findings)
}

/// A collision, or what the user is told instead.
fn run(
    laboratory: &Laboratory,
    settings: Settings,
    set: &[String],
    model: &str,
) -> Result<Result<Ran, String>, StudyError> {
    let base = laboratory.claim().runs.get("base").ok_or_else(|| {
        StudyError::parameters("the claim has no [run.base], which the study needs")
    })?;
    let mut all = base.set.clone();
    if let Settings::Default = settings {
        all.push("accuracy={}".to_string());
    }
    all.extend_from_slice(set);
    all.push(format!("model={{{model}}}"));
    let file = RunFile { case: base.case.clone(), set: all };
    let case = laboratory.claim().load_case(&file);
    laboratory.work(|| {
        let ran = case.and_then(collide).unwrap_or_else(|error| Err(error.to_string()));
        let updates = ran.as_ref().ok().and_then(|ran| ran.collision.element_updates);
        Ok((ran, updates.unwrap_or(0)))
    })
}

fn collide(case: Case) -> Result<Result<Ran, String>, CaseError> {
    let mut simulation = Simulation::new(case)?;
    simulation.skip_snapshots();
    let collision = simulation.run(&mut ());
    if let Some(stop) = collision.stop() {
        return Ok(Err(stop.to_string()));
    }
    Ok(Ok(Ran { simulation, collision }))
}

/// What the cheaper model (`theirs`) is off, over what is allowed.
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
        // A contact without an end has none; whether it has one the restitution tells.
        _ => 0.0,
    });
    let share =
        [0, 1, 2].map(|k| off[k].abs() / (base[k] + FORETOLD_WITHIN * explained[k] + waves[k]));
    let share = share.into_iter().fold(0.0, fem_collision::worst);
    // What warnings need to know, companions tell, which take longer than the collision.
    let is_within = share <= 1.0;
    let warns = !is_within && theirs.warns();
    Difference { scene: set.join(" "), settings, off, share, warns }
}

/// What both models say that mesh and steps leave open; shares as of Hertz.
fn bars(ours: &Ran, theirs: &Ran) -> [f64; 3] {
    let hertz = &ours.simulation.setup().estimate.hertz;
    let of = |ran: &Ran| {
        let bars = ran.simulation.summary(&ran.collision).uncertainty;
        let scales = [1.0, hertz.contact_time(), hertz.peak_force()];
        let headlines = [Headline::Restitution, Headline::ContactTime, Headline::PeakForce];
        [0, 1, 2].map(|k: usize| bars.parts(headlines[k]).discretisation.unwrap_or(0.0) / scales[k])
    };
    let (ours, theirs) = (of(ours), of(theirs));
    [0, 1, 2].map(|k: usize| ours[k] + theirs[k])
}

/// What a model without fields of waves may be off by in what they take; shares as of Hertz.
fn waves(theirs: &Ran) -> [f64; 3] {
    let verdicts = theirs.verdicts();
    let waves = verdicts.iter().find(|one| one.name == PartnerWaves::NAME && one.active);
    let Some(estimate) = theirs.simulation.estimate(&theirs.collision) else { return [0.0; 3] };
    let worth = waves.and_then(|waves| theirs.simulation.left_out(waves, &estimate));
    let worth =
        worth.map_or([0.0; 3], |worth| shares(&worth, &estimate).map(Option::unwrap_or_default));
    worth.map(|share| RADIATION_WITHIN * share)
}

/// Of the restitution as it is, of contact time and peak force over Hertz'.
fn shares(left_out: &LeftOut, estimate: &Estimate) -> [Option<f64>; 3] {
    let hertz = &estimate.hertz;
    [
        left_out.restitution,
        left_out.contact_time_s.map(|time| time / hertz.contact_time()),
        left_out.peak_force_n.map(|force| force / hertz.peak_force()),
    ]
}

/// What the effects are worth that one of two models has and the other lacks; shares as of Hertz.
fn explained(ours: &Ran, theirs: &Ran) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (has, lacks) in [(ours, theirs), (theirs, ours)] {
        let Some(estimate) = has.simulation.estimate(&has.collision) else { continue };
        let lacking = lacks.verdicts();
        let is_lacking = |name: &str| !lacking.iter().any(|one| one.name == name && one.active);
        for verdict in has.verdicts().iter().filter(|one| one.active && is_lacking(one.name)) {
            let Some(left_out) = has.simulation.left_out(verdict, &estimate) else { continue };
            for (sum, share) in sum.iter_mut().zip(shares(&left_out, &estimate)) {
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

    fn verdicts(&self) -> Vec<Verdict> {
        self.simulation.decisions(&self.collision).verdicts
    }
}
