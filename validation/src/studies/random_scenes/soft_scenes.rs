//! Random collisions of soft balls at finite strain: whether tolerance and error bars hold, and whether the estimated
//! effect of finite strain is right.
//!
//! A ball strikes a rigid wall, or one time in three a ball of another size and stiffness. Poisson's ratios are 0 to
//! 0.495. Laws are all but that of St Venant and Kirchhoff, which collapses. Half of the scenes relax. At the speed of a
//! scene Hertz' contact radius is 0.1 to 0.7 of the effective radius. Each is run with the default settings, and on
//! elements [`FINER`] times smaller. Both give the limit with second order; its distance from the finer run is its
//! uncertainty, which is added to the bar before the comparison. A scene is `covered` if all six quantities are within
//! their bars, and `met` if restitution, contact time, peak force and pressure are within the
//! default tolerance or its warnings say that one of them may not be; `bar` is the median of a bar over the error, or over
//! a tenth of the tolerance if that is larger. A scene is `foretold` if contact time and force at small strain differ by at
//! most [`ESTIMATED_WITHIN`] times the estimate of the plan, plus [`NOISE`] of two meshes.

use std::f64::consts::PI;

use fem::Simulation;
use fem::effects::{Effect, FiniteStrain};
use fem::error::Setting;
use fem_case::{Case, CaseError};
use fem_collision::{Collision, QuantityOfInterest};

use super::{
    NumberTrial, Parameters, Parted, Random, Trial, computed, load, quantile, tabulate,
    tabulate_constants,
};
use crate::{Findings, Laboratory, StudyError};

/// Ratio of the element sizes from which errors are estimated.
const FINER: f64 = 1.6;
/// Factor within which the estimate must be right.
const ESTIMATED_WITHIN: f64 = 3.0;
/// Relative difference of two meshes.
const NOISE: f64 = 0.01;
/// Largest number of scenes drawn per scene that is run.
const MAX_DRAWN: usize = 12;

struct SoftTrial {
    parted: Parted,
    has_warned: bool,
    is_estimated: bool,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { seed, scenes, element_updates } = laboratory.parameters()?;
    let mut random = Random::new(seed);
    let trials = computed(
        scenes,
        MAX_DRAWN,
        || overrides(&mut random),
        |set| {
            let case = load(laboratory, set)??;
            laboratory.work(|| Ok((compute(&case, set.join(" "), element_updates)?, 0)))
        },
    )?;
    let mut findings = Findings::new();
    let count = |is: fn(&SoftTrial) -> bool| trials.iter().filter(|one| is(one)).count() as f64;
    findings.measure("scenes", trials.len() as f64);
    findings.measure("covered", count(|one| one.parted.0.share() <= 1.0));
    findings.measure("met", count(|one| one.has_warned || one.parted.0.is_met()));
    findings.measure("foretold", count(|one| one.is_estimated));
    let least = 0.1 * fem_case::defaults::TOLERANCE;
    let all = trials.iter().flat_map(|one| &one.parted.0.numbers);
    let ratios = all.map(|NumberTrial { error, bar, .. }| bar / error.abs().max(least));
    findings.measure("bar", quantile(ratios, 0.5));
    let caption = format!("Errors and bars of soft scenes, seed {seed}.");
    let trials: Vec<Parted> = trials.into_iter().map(|one| one.parted).collect();
    tabulate(&mut findings, caption, trials.iter().map(|(trial, _)| trial).collect(), scenes);
    tabulate_constants(&mut findings, &[&trials]);
    Ok(findings)
}

fn overrides(random: &mut Random) -> Vec<String> {
    const RADIUS: f64 = 0.01;
    const DENSITY: f64 = 1000.0;
    let modulus = 10f64.powf(random.within(5.5, 7.5));
    let laws = ["neo-hooke", "neo-hooke-ln", "hencky"];
    let law = laws[random.order(laws.len())[0]];
    let is_pair = random.within(0.0, 3.0) < 1.0;
    let relaxes = random.within(0.0, 2.0) < 1.0;
    let nu = random.within(0.0, 0.495);
    let strain = random.within(0.1, 0.7);
    let (ratio, harder) = (random.within(0.5, 2.0), random.within(1.0, 3.0));
    let weight = random.within(0.05, 0.5);
    let decades = random.within(-1.0, 0.5);
    // Effective radius, mass and modulus of the pair.
    let ball = 4.0 / 3.0 * PI * DENSITY * RADIUS.powi(3);
    let plane = modulus / (1.0 - nu * nu);
    let [radius, mass, stiffness] = match is_pair {
        true => {
            let other = ball * ratio.powi(3);
            [
                RADIUS * ratio / (1.0 + ratio),
                ball * other / (ball + other),
                plane * harder / (1.0 + harder),
            ]
        }
        false => [RADIUS, ball, plane],
    };
    // (a/R*)⁵ = 15 m* v²/(16 E* R*³).
    let speed = (strain.powi(5) * 16.0 * stiffness * radius.powi(3) / (15.0 * mass)).sqrt();
    // Hertz' contact time is 2.94 δ/v, with δ = a²/R*.
    let time = decades.exp2() * 2.94 * strain * strain * radius / speed;
    let relaxation = match relaxes {
        true => format!(
            ",relaxation={{acts_on='shear',terms=[{{weight={weight:.3},relaxation_time={time:.4e}}}]}}"
        ),
        false => String::new(),
    };
    let material = |name: &str, modulus: f64| {
        format!(
            "material.{name}={{density={DENSITY},youngs_modulus={modulus:.4e},poissons_ratio={nu:.3},\
             hyperelastic='{law}'{relaxation}}}"
        )
    };
    let partner = match is_pair {
        true => format!(
            "body.0={{name='partner',sphere={{diameter={:.4e}}},material='harder'}}",
            2.0 * RADIUS * ratio
        ),
        false => "body.0={name='partner',wall={}}".to_string(),
    };
    let mut set = vec![material("rubber", modulus)];
    if is_pair {
        set.push(material("harder", harder * modulus));
    }
    set.push(partner);
    set.push(format!("body.1.sphere.diameter={}", 2.0 * RADIUS));
    set.push(format!("body.1.approach_speed={speed:.4e}"));
    set
}

/// Returns the trial of a scene; `None` if it is too expensive, its run is stopped or its contact has no end.
fn compute(
    case: &Case,
    scene: String,
    element_updates: f64,
) -> Result<Option<SoftTrial>, StudyError> {
    if Simulation::expected_of(case)?.element_updates as f64 > element_updates {
        return Ok(None);
    }
    let run = |case: Case| Ok::<_, CaseError>(Simulation::new(case)?.run_within_tolerance(&mut ()));
    let computed = run(case.clone())?;
    let fem::ComputedCollision { simulation, collision, .. } = &computed;
    let updates = collision.element_updates.map_or(f64::INFINITY, |updates| updates as f64);
    if updates > element_updates {
        return Ok(None);
    }
    let Some(elements) = simulation.setup().elements.as_ref() else { return Ok(None) };
    let size = elements.plan.contact_element_size;
    let finer = case.edited(|file| Setting::ElementSize(size / FINER).apply(file))?;
    let fine = Simulation::new(finer)?.run(&mut ());
    let small = case.edited(|file| {
        file.effects.get_or_insert_default().finite_strain = Some(fem_case::Switch::Off);
        Setting::ElementSize(size).apply(file);
    })?;
    let small = Simulation::new(small)?.run(&mut ());
    if ![collision, &fine].into_iter().all(Collision::is_complete) {
        return Ok(None);
    }
    let errors = &computed.errors;
    let measured = QuantityOfInterest::ALL.into_iter().filter_map(|quantity| {
        let (value, fine) = (quantity.of(collision)?, quantity.of(&fine)?);
        let bar = errors.discretisation(quantity)?;
        let scale = quantity.scale(fine);
        let limit = fine + (fine - value) / (FINER * FINER - 1.0);
        let number = NumberTrial {
            quantity,
            error: (value - limit) / scale,
            bar: bar / scale,
            reference_uncertainty: (fine - limit).abs() / scale,
        };
        Some((number, errors.parts(quantity)?))
    });
    let (numbers, parts) = measured.unzip();
    let trial = Trial { scene, numbers };
    let has_warned =
        computed.warnings().iter().any(|warning| warning.contains("above the tolerance"));
    let is_estimated = is_estimated(simulation, collision, &small).unwrap_or(true);
    Ok(trial.is_whole().then_some(SoftTrial { parted: (trial, parts), has_warned, is_estimated }))
}

/// Whether contact time and peak force without finite strain differ from those with it by as much as the plan
/// estimates; `None` if that run has none.
fn is_estimated(simulation: &Simulation, with: &Collision, without: &Collision) -> Option<bool> {
    let estimate = &simulation.setup().estimate;
    let estimated = FiniteStrain.neglect_error(simulation.case().scene(), estimate)?;
    let hertz = &estimate.hertz;
    let is_within = |of: fn(&Collision) -> Option<f64>, estimated: Option<f64>, whole: f64| {
        let change = (of(without)? / of(with)? - 1.0).abs();
        Some(change <= ESTIMATED_WITHIN * estimated? / whole + NOISE)
    };
    let time = is_within(|it| it.contact_time, estimated.contact_time_s, hertz.contact_time())?;
    let force = is_within(|it| it.peak_force, estimated.peak_force_n, hertz.peak_force())?;
    Some(time && force)
}
