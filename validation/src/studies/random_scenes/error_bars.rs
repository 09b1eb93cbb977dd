//! Whether the limit of a model is within the error bars of its results, and within the default tolerance.
//!
//! Half of the scenes are the same each time, half are drawn anew. The limit is that of condensed bodies over the
//! element size. For explicit elements it includes their difference to condensed bodies on a mesh that is finer than
//! the one under test ([`Limit`]); its uncertainty is added to the bar before the comparison. The result under test has
//! the mesh and the mass scaling of the default tolerance. A scene is `covered` if all six quantities are within their
//! bars, and `met` if restitution, contact time, peak force and pressure are within the tolerance. `MODEL.bar` is the
//! median of bar / max(error, uncertainty of the limit).

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};

use fem::accuracy::Limit;
use fem::error::Setting;
use fem_case::{Case, CaseError};
use fem_collision::QuantityOfInterest;

use super::{
    NumberTrial, Parameters, Parted, Random, Trial, computed,
    linear_scenes::{Ratios, overrides},
    load, quantile, tabulate, tabulate_constants,
};
use crate::{Findings, Laboratory, StudyError};

/// Mass scaling of the explicit elements that give a limit.
const LITTLE_MASS: f64 = 2e-4;
/// Elements across the contact of the explicit elements that give a limit.
const EXPLICIT: [f64; 2] = [8.0, 11.0];
/// Elements across the contact of the condensed bodies that give a limit.
const CONDENSED: [f64; 5] = [8.0, 11.0, 16.0, 23.0, 32.0];
/// Number of scenes in each table.
const N_SHOWN: usize = 8;
/// Largest number of scenes drawn per scene that is computed.
const MAX_DRAWN: usize = 8;

type Numbers = [Option<f64>; 6];

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { seed, scenes, element_updates } = laboratory.parameters()?;
    // The only random number that is available without a clock: the seed of hash tables.
    let drawn = RandomState::new().build_hasher().finish();
    let (mut explicit, mut condensed): (Vec<Parted>, Vec<Parted>) = Default::default();
    for seed in [seed, drawn] {
        let mut random = Random::new(seed);
        let draw = || overrides(&mut random, Ratios::Usual);
        let both = computed(scenes, MAX_DRAWN, draw, |set| {
            let Ok(case) = load(laboratory, set)? else { return Ok(None) };
            let compute = || compute(&case, &set.join(" "), element_updates).ok().flatten();
            laboratory.work(|| Ok((compute(), 0)))
        })?;
        for [first, second] in both {
            explicit.push(first);
            condensed.push(second);
        }
    }
    let mut findings = Findings::new();
    tabulate_constants(&mut findings, &[&explicit, &condensed]);
    for (name, trials) in [("explicit", explicit), ("condensed", condensed)] {
        let count = |is: fn(&Trial) -> bool| trials.iter().filter(|one| is(&one.0)).count() as f64;
        findings.measure(format!("{name}.scenes"), trials.len() as f64);
        findings.measure(format!("{name}.covered"), count(|trial| trial.share() <= 1.0));
        findings.measure(format!("{name}.met"), count(Trial::is_met));
        let all = trials.iter().flat_map(|(trial, _)| &trial.numbers);
        findings.measure(format!("{name}.bar"), quantile(all.map(NumberTrial::width), 0.5));
        let caption = format!(
            "{name}: errors and bars of the scenes that come nearest to their bars; seed of the second half {drawn}."
        );
        tabulate(&mut findings, caption, trials.iter().map(|one| &one.0).collect(), N_SHOWN);
    }
    Ok(findings)
}

/// Returns the errors and the bars of explicit elements and of condensed bodies; `None` for a scene that is too
/// expensive or whose contact has no end.
fn compute(
    case: &Case,
    scene: &str,
    element_updates: f64,
) -> Result<Option<[Parted; 2]>, CaseError> {
    let Ok(estimate) = fem::Estimate::of(case.scene()) else { return Ok(None) };
    let radius = estimate.contact_radius;
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
    if fem::Simulation::expected_of(&finest)?.element_updates as f64 > element_updates {
        return Ok(None);
    }
    let levels = |settings: &[Setting], across: &[f64]| {
        let level = |across: &f64| {
            let (_, collision) = run(settings, Some(*across))?;
            let values: Numbers = QuantityOfInterest::ALL.map(|quantity| quantity.of(&collision));
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
        let measured = QuantityOfInterest::ALL.into_iter().filter_map(|quantity| {
            let pick = |levels: &[(f64, Numbers)]| -> Vec<(f64, f64)> {
                let level =
                    |(size, values): &(f64, Numbers)| Some((*size, values[quantity as usize]?));
                levels.iter().filter_map(level).collect()
            };
            let none: &[(f64, Numbers)] = &[];
            let (springs, explicit) =
                if has_inertia { (&springs[..], &explicit[..]) } else { (none, none) };
            let limit = Limit::of(&pick(&bodies), &pick(springs), &pick(explicit))?;
            let value = quantity.of(&collision)?;
            let bar = errors.discretisation(quantity)?;
            let scale = quantity.scale(limit.value);
            let number = NumberTrial {
                quantity,
                error: (value - limit.value) / scale,
                bar: bar / scale,
                reference_uncertainty: limit.uncertainty / scale,
            };
            Some((number, errors.parts(quantity)?))
        });
        let (numbers, parts) = measured.unzip();
        Ok::<_, CaseError>((Trial { scene: scene.to_string(), numbers }, parts))
    };
    let judged = [judge(&[Setting::Explicit], true)?, judge(&[condensed(false)], false)?];
    Ok(judged.iter().all(|(trial, _)| trial.is_whole()).then_some(judged))
}
