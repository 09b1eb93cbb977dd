//! Tests whether the limit of a model is within the error bars of its results and within the tolerance of the case, and
//! tabulates the constants of the error estimate.
//!
//! The scenes are those of [`scenes`](super::hard::scenes): half of them are the same each time, half are drawn anew. The
//! limit is the Richardson limit of condensed bodies; for explicit elements it includes their difference from condensed
//! bodies on a mesh finer than the tested one ([`Limit`]). Its own uncertainty is allowed. The tested runs have the mesh
//! and the added mass of the default tolerance. A scene is `covered` if all six quantities are within their bars, and
//! `met` if restitution, contact time, peak force and pressure are within the tolerance. `MODEL.bar` is the median of a
//! bar over the error, or over the uncertainty of the limit if that is larger.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};

use fem::accuracy::{BarParts, Limit, Setting};
use fem_case::{Accuracy, Case, CaseError};
use fem_collision::QuantityOfInterest;
use rayon::prelude::*;
use serde::Deserialize;

use super::hard::scenes::{Random, overrides};
use crate::claim::RunFile;
use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Added mass of the runs that make a limit, and their elements across the contact.
const LITTLE_MASS: f64 = 2e-4;
const EXPLICIT: [f64; 2] = [8.0, 11.0];
const CONDENSED: [f64; 5] = [8.0, 11.0, 16.0, 23.0, 32.0];
/// Number of listed scenes, the worst first.
const N_SHOWN: usize = 8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Seed of the scenes that are the same each time.
    seed: u64,
    /// Number of scenes of each half.
    scenes: usize,
    /// Most element updates on the finest mesh; scenes above are skipped.
    element_updates: f64,
}

/// The errors and bars of one model in one scene.
struct Trial {
    scene: String,
    measured: Vec<Measured>,
}

/// One quantity of a trial: the restitution's errors absolute, others relative.
#[derive(Clone, Copy)]
struct Measured {
    headline: QuantityOfInterest,
    /// Signed error.
    error: f64,
    bar: f64,
    /// Uncertainty of the limit that the error is measured from.
    limit_uncertainty: f64,
    parts: BarParts,
}

impl Measured {
    /// Returns the error over the bar and the uncertainty of the limit.
    fn share(&self) -> f64 {
        self.error.abs() / (self.bar + self.limit_uncertainty)
    }

    /// Returns the bar over the error, or over the uncertainty of the limit if that is more.
    fn width(&self) -> f64 {
        self.bar / self.error.abs().max(self.limit_uncertainty)
    }

    /// Returns the constant of the edge, times (a/h)², with which the bar would hold.
    fn edge_needed(&self) -> f64 {
        let BarParts { reference_error, safety_factor, across, floor, .. } = self.parts;
        let known = safety_factor * reference_error + floor + self.limit_uncertainty;
        (self.error.abs() - known).max(0.0) * across * across
    }
}

type Numbers = [Option<f64>; 6];

/// Tests the bars of explicit elements and of condensed bodies.
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
    let measured: Vec<Measured> =
        trials.iter().flatten().flat_map(|trial| trial.measured.clone()).collect();
    findings.tabulate(
        "Constants of the error estimate (crates/fem-simulation/src/error/calibration.rs). The edge constant needed is that \
         with which the bars of 98 % of these scenes hold.",
        ["constants", "quantity", "covered", "median bar", "bar over error", "edge constant", "edge constant needed"],
        calibration_rows(&measured),
    );
    for (name, mut trials) in ["explicit", "condensed"].into_iter().zip(trials) {
        findings.measure(format!("{name}.scenes"), trials.len() as f64);
        let covered = trials.iter().filter(|trial| trial.share() <= 1.0).count();
        findings.measure(format!("{name}.covered"), covered as f64);
        let met = trials.iter().filter(|trial| trial.is_met()).count();
        findings.measure(format!("{name}.met"), met as f64);
        let all = trials.iter().flat_map(|trial| &trial.measured);
        let mut ratios: Vec<f64> = all.map(Measured::width).collect();
        ratios.sort_by(f64::total_cmp);
        findings.measure(
            format!("{name}.bar"),
            ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN),
        );
        trials.sort_by(|a, b| b.share().total_cmp(&a.share()));
        let rows = trials.iter().take(N_SHOWN).map(|trial| {
            let number = |headline: QuantityOfInterest| {
                let mut all = trial.measured.iter();
                let Measured { error, bar, .. } = all.find(|it| it.headline == headline)?;
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

/// Returns, for each row of constants and each quantity, how often the bars hold, how wide they are, the edge constant and
/// the one that is needed.
fn calibration_rows(measured: &[Measured]) -> Vec<[String; 7]> {
    let mut names: Vec<&str> = measured.iter().map(|it| it.parts.constants).collect();
    names.sort_unstable();
    names.dedup();
    let keys = names.into_iter().flat_map(|name| QuantityOfInterest::ALL.map(|key| (name, key)));
    let row = |(name, quantity): (&str, QuantityOfInterest)| {
        let is_it = |it: &&Measured| it.parts.constants == name && it.headline == quantity;
        let all: Vec<&Measured> = measured.iter().filter(is_it).collect();
        let quantile = |of: &dyn Fn(&Measured) -> f64, share: f64| {
            let mut values: Vec<f64> = all.iter().map(|it| of(it)).collect();
            values.sort_by(f64::total_cmp);
            let k = (share * values.len() as f64) as usize;
            values.get(k.min(values.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
        };
        let covered = all.iter().filter(|it| it.share() <= 1.0).count();
        let edge = |it: &Measured| it.parts.edge * it.parts.across.max(1.0).powi(2);
        [
            name.to_string(),
            quantity.key().to_string(),
            format!("{covered} of {}", all.len()),
            format!("{:.1e}", quantile(&|it| it.bar, 0.5)),
            format!("{:.1}", quantile(&Measured::width, 0.5)),
            format!("{:.3}", quantile(&edge, 0.5)),
            format!("{:.3}", quantile(&Measured::edge_needed, 0.98)),
        ]
    };
    keys.map(row).collect()
}

/// Returns the trials of both models in the scenes of a seed.
fn half(
    laboratory: &Laboratory,
    parameters: &Parameters,
    seed: u64,
) -> Result<[Vec<Trial>; 2], StudyError> {
    /// Most scenes that are drawn for each one that is tested.
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

/// Tests both models in a scene; `None` for a scene that is too expensive or that a model rejects.
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
        Ok((trials.map(|both| both.map(|measured| Trial { scene: set.join(" "), measured })), 0))
    })
}

/// Computes errors, bars and the limits' uncertainties, for explicit elements and for condensed bodies.
fn compute(case: &Case, parameters: &Parameters) -> Result<Option<[Vec<Measured>; 2]>, CaseError> {
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
        let errors = simulation.estimate_errors(&collision);
        let measured = QuantityOfInterest::ALL.into_iter().filter_map(|headline| {
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
            let bar = errors.discretisation(headline)?;
            let scale = headline.scale(limit.value);
            Some(Measured {
                headline,
                error: (value - limit.value) / scale,
                bar: bar / scale,
                limit_uncertainty: limit.uncertainty / scale,
                parts: errors.parts(headline)?,
            })
        });
        Ok::<_, CaseError>(measured.collect::<Vec<_>>())
    };
    let judged = [judge(&[Setting::Explicit], true)?, judge(&[condensed(false)], false)?];
    // Bodies that stay together have neither a contact time nor bars.
    Ok(judged
        .iter()
        .all(|measured| measured.len() == QuantityOfInterest::ALL.len())
        .then_some(judged))
}

impl Trial {
    /// Returns whether the quantities are within the default tolerance, with the uncertainty of their limits.
    fn is_met(&self) -> bool {
        let accuracy = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
        let Accuracy { restitution, contact_time, peak_force, peak_pressure } = accuracy;
        self.measured.iter().all(|it| {
            let tolerance = match it.headline {
                QuantityOfInterest::Restitution => restitution,
                QuantityOfInterest::ContactTime => contact_time,
                QuantityOfInterest::PeakForce => peak_force,
                QuantityOfInterest::PeakPressure => peak_pressure,
                // Approach and contact radius have no tolerance.
                QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => {
                    return true;
                }
            };
            it.error.abs() <= tolerance + it.limit_uncertainty
        })
    }

    /// Returns the largest error over its bar and the uncertainty of the limit.
    fn share(&self) -> f64 {
        let shares = self.measured.iter().map(Measured::share);
        shares.fold(0.0, fem_collision::nan_aware_max_abs)
    }
}
