//! Whether the limit of a model is within the error bars that its results print, and within the tolerance that
//! their case asks for.
//!
//! Scenes are those of [`scenes`](super::hard::scenes), half of them the same each time, half drawn anew
//! when the claim is tried. The limit is that of condensed bodies over the size of their elements, and of
//! explicit elements beside it what they add to condensed bodies on a finer mesh than the one that is
//! tried ([`Limit`]): its own uncertainty is allowed. What is tried has the mesh and the moved mass of the default
//! tolerance. A scene is `covered` if all six numbers are within their bars, and `met` if restitution, contact
//! time, peak force and pressure are within the tolerance;
//! `MODEL.bar` is the median of a bar over the error, or over what is known of the limit where that is more.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};

use fem::accuracy::{Limit, Setting};
use fem_case::{Accuracy, Case, CaseError};
use fem_collision::QuantityOfInterest;
use rayon::prelude::*;
use serde::Deserialize;

use super::hard::scenes::{Random, overrides};
use crate::claim::RunFile;
use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Elements across the contact of what a limit is made of, and the mass that is moved there.
const LITTLE_MASS: f64 = 2e-4;
const EXPLICIT: [f64; 2] = [8.0, 11.0];
const CONDENSED: [f64; 5] = [8.0, 11.0, 16.0, 23.0, 32.0];
/// Scenes that are shown, the worst first.
const N_SHOWN: usize = 8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Of the scenes that are the same each time.
    seed: u64,
    /// Scenes of each half.
    scenes: usize,
    /// Scenes that need more element updates on the finest mesh are passed over.
    element_updates: f64,
}

/// One model in one scene.
struct Trial {
    scene: String,
    /// Errors and bars over the value, of the restitution as they are, and what is known of the limit.
    numbers: Vec<(QuantityOfInterest, f64, f64, f64)>,
}

type Numbers = [Option<f64>; 6];

/// Tries the bars of explicit elements and of condensed bodies.
pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    // The only source of chance without a clock: what hash tables are seeded with.
    let drawn = RandomState::new().build_hasher().finish();
    let mut findings = Findings::new();
    let mut trials: [Vec<Trial>; 2] = Default::default();
    for seed in [parameters.seed, drawn] {
        for (all, trials) in trials.iter_mut().zip(half(laboratory, &parameters, seed)?) {
            all.extend(trials);
        }
    }
    for (name, mut trials) in ["explicit", "condensed"].into_iter().zip(trials) {
        findings.measure(format!("{name}.scenes"), trials.len() as f64);
        let covered = trials.iter().filter(|trial| trial.share() <= 1.0).count();
        findings.measure(format!("{name}.covered"), covered as f64);
        let met = trials.iter().filter(|trial| trial.is_met()).count();
        findings.measure(format!("{name}.met"), met as f64);
        let numbers = trials.iter().flat_map(|trial| &trial.numbers);
        let mut ratios: Vec<f64> =
            numbers.map(|(_, error, bar, known)| bar / error.abs().max(*known)).collect();
        ratios.sort_by(f64::total_cmp);
        findings.measure(
            format!("{name}.bar"),
            ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN),
        );
        trials.sort_by(|a, b| b.share().total_cmp(&a.share()));
        let rows = trials.iter().take(N_SHOWN).map(|trial| {
            let number = |headline: QuantityOfInterest| {
                let mut numbers = trial.numbers.iter();
                let (_, error, bar, _) = numbers.find(|(other, ..)| *other == headline)?;
                Some(format!("{error:+.1e} ± {bar:.1e}"))
            };
            let [e, t, f, approach, a, p] =
                QuantityOfInterest::ALL.map(|headline| number(headline).unwrap_or_default());
            [trial.scene.clone(), format!("{:.2}", trial.share()), e, t, f, approach, a, p]
        });
        findings.tabulate(
            format!("{name}: errors and bars of the scenes that come nearest to their bars; seed of the second half {drawn}."),
            ["scene", "over the bar", "e", "T", "F", "approach", "a", "p0"],
            rows,
        );
    }
    Ok(findings)
}

/// Trials of both models in the scenes of a seed.
fn half(
    laboratory: &Laboratory,
    parameters: &Parameters,
    seed: u64,
) -> Result<[Vec<Trial>; 2], StudyError> {
    /// Scenes that are drawn for one that is tried, at most.
    const MOST_DRAWN: usize = 8;
    let mut random = Random::new(seed);
    let mut both: [Vec<Trial>; 2] = Default::default();
    for _ in 0..MOST_DRAWN {
        let sets: Vec<Vec<String>> =
            (0..parameters.scenes).map(|_| overrides(&mut random)).collect();
        let trials = sets.par_iter().map(|set| try_scene(laboratory, parameters, set));
        for pair in trials.collect::<Result<Vec<_>, StudyError>>()?.into_iter().flatten() {
            if both[0].len() < parameters.scenes {
                let [explicit, condensed] = pair;
                both[0].push(explicit);
                both[1].push(condensed);
            }
        }
        if both[0].len() == parameters.scenes {
            break;
        }
    }
    Ok(both)
}

/// Both models in a scene; none of one that is too dear, or that a model refuses.
fn try_scene(
    laboratory: &Laboratory,
    parameters: &Parameters,
    set: &[String],
) -> Result<Option<[Trial; 2]>, StudyError> {
    let base = laboratory.claim().runs.get("base").ok_or_else(|| {
        StudyError::parameters("the claim has no [run.base], which the study needs")
    })?;
    let file = RunFile { case: base.case.clone(), set: [&base.set[..], set].concat() };
    let Ok(case) = laboratory.claim().load_case(&file) else { return Ok(None) };
    laboratory.work(|| {
        let trials = compute(&case, parameters).ok().flatten();
        Ok((
            trials.map(|numbers| numbers.map(|numbers| Trial { scene: set.join(" "), numbers })),
            0,
        ))
    })
}

/// Errors, bars and what is known of the limits, of explicit elements and of condensed bodies.
#[allow(clippy::type_complexity, reason = "two of what a trial holds")]
fn compute(
    case: &Case,
    parameters: &Parameters,
) -> Result<Option<[Vec<(QuantityOfInterest, f64, f64, f64)>; 2]>, CaseError> {
    let radius = match fem::Estimate::of(case.scene()) {
        Ok(estimate) => estimate.contact_radius,
        Err(_) => return Ok(None),
    };
    let run = |settings: &[Setting], across: Option<f64>| {
        let case = case.edited(|file| {
            for setting in settings {
                setting.apply(file);
            }
            if let Some(across) = across {
                Setting::ElementSize(radius / across).apply(file);
            }
        })?;
        let simulation = fem::Simulation::new(case)?;
        let mut collision = simulation.run(&mut ());
        collision.snapshots.clear();
        Ok::<_, CaseError>((simulation, collision))
    };
    let finest = case.edited(|file| {
        Setting::Explicit.apply(file);
        Setting::MassScaling(LITTLE_MASS).apply(file);
        Setting::ElementSize(radius / EXPLICIT[1]).apply(file);
    })?;
    if fem::Simulation::price(&finest)? as f64 > parameters.element_updates {
        return Ok(None);
    }
    let levels = |settings: &[Setting], across: &[f64]| {
        let level = |across: &f64| {
            let (_, collision) = run(settings, Some(*across))?;
            let values: Numbers = QuantityOfInterest::ALL.map(|headline| headline.of(&collision));
            Ok::<_, CaseError>((radius / across, values))
        };
        across.iter().map(level).collect::<Result<Vec<_>, _>>()
    };
    let condensed = |penalty_springs| Setting::Condensed { vibration_modes: 0, penalty_springs };
    let bodies = levels(&[condensed(false)], &CONDENSED)?;
    let springs = levels(&[condensed(true)], &EXPLICIT)?;
    let little = [Setting::Explicit, Setting::MassScaling(LITTLE_MASS)];
    let explicit = levels(&little, &EXPLICIT)?;
    let judge = |settings: &[Setting], has_inertia: bool| {
        let (simulation, collision) = run(settings, None)?;
        let bars = simulation.summary(&collision).uncertainty;
        let numbers = QuantityOfInterest::ALL.into_iter().filter_map(|headline| {
            let pick = |levels: &[(f64, Numbers)]| -> Vec<(f64, f64)> {
                let level =
                    |(size, values): &(f64, Numbers)| Some((*size, values[headline as usize]?));
                levels.iter().filter_map(level).collect()
            };
            let none: &[(f64, Numbers)] = &[];
            let (springs, explicit) =
                if has_inertia { (&springs[..], &explicit[..]) } else { (none, none) };
            let limit = Limit::of(&pick(&bodies), &pick(springs), &pick(explicit))?;
            let value = headline.of(&collision)?;
            let bar = bars.parts(headline).discretisation?;
            let scale = headline.scale(limit.value);
            Some((headline, (value - limit.value) / scale, bar / scale, limit.uncertainty / scale))
        });
        Ok::<_, CaseError>(numbers.collect::<Vec<_>>())
    };
    let judged = [judge(&[Setting::Explicit], true)?, judge(&[condensed(false)], false)?];
    // A contact without an end has neither time nor bars.
    Ok(judged
        .iter()
        .all(|numbers| numbers.len() == QuantityOfInterest::ALL.len())
        .then_some(judged))
}

impl Trial {
    /// Whether the numbers are within the default tolerance, by what is known of their limits.
    fn is_met(&self) -> bool {
        let accuracy = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
        let Accuracy { restitution, contact_time, peak_force, peak_pressure } = accuracy;
        self.numbers.iter().all(|(headline, error, _, known)| {
            let tolerance = match headline {
                QuantityOfInterest::Restitution => restitution,
                QuantityOfInterest::ContactTime => contact_time,
                QuantityOfInterest::PeakForce => peak_force,
                QuantityOfInterest::PeakPressure => peak_pressure,
                // Nothing is asked for of approach and contact radius.
                QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => {
                    return true;
                }
            };
            error.abs() <= tolerance + known
        })
    }

    /// The worst error over its bar and what is known of the limit.
    fn share(&self) -> f64 {
        let shares = self.numbers.iter().map(|(_, error, bar, known)| error.abs() / (bar + known));
        shares.fold(0.0, fem_collision::nan_aware_max_abs)
    }
}
