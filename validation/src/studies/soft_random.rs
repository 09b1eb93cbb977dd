//! Random collisions of soft balls at finite strain: whether tolerance and error bars hold, and whether the estimated effect of
//! finite strain is right.
//!
//! A ball strikes a rigid wall, or one time in three a ball of another size and stiffness. Poisson's ratios are 0 to
//! 0.495, laws all but St Venant and Kirchhoff's, which collapses; half of the scenes relax; the speed is that at which
//! Hertz' contact radius is 0.1 to 0.7 of the effective radius. Each is run as a user runs it, with nothing set, and on
//! elements [`FINER`] times smaller, from which its error is estimated with second order. A scene is `covered` if
//! all six numbers are within their bars, and `met` if restitution, contact time, peak force and pressure are within the
//! default tolerance or its warnings say that one of them may not be; `bar` is the median of a bar over the error, or over
//! a tenth of the tolerance where that is more. A scene is `foretold` if contact time and force at small strain differ by at most
//! [`FORETOLD_WITHIN`] times the estimate of the plan, plus [`NOISE`] of two meshes.

use std::f64::consts::PI;

use fem::Simulation;
use fem::accuracy::Setting;
use fem::effects::{EFFECTS, FiniteStrain};
use fem_case::{Accuracy, Case, CaseError};
use fem_collision::{Collision, QuantityOfInterest};
use rayon::prelude::*;
use serde::Deserialize;

use super::hard::scenes::Random;
use crate::claim::RunFile;
use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Ratio of the element sizes from which errors are estimated.
const FINER: f64 = 1.6;
/// Factor within which the estimate must be right.
const FORETOLD_WITHIN: f64 = 3.0;
/// Relative difference of two meshes.
const NOISE: f64 = 0.01;
/// Largest number of scenes drawn per scene that is run.
const MOST_DRAWN: usize = 12;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    scenes: usize,
    /// Scenes that need more element updates on the mesh under test are skipped.
    element_updates: f64,
}

/// One scene.
struct Trial {
    scene: String,
    /// Errors and bars over the value, of the restitution as they are.
    numbers: Vec<(QuantityOfInterest, f64, f64)>,
    has_warned: bool,
    is_foretold: bool,
}

/// Runs the study.
pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let Parameters { seed, scenes, element_updates } = laboratory.parameters()?;
    let base = laboratory.claim().runs.get("base").ok_or_else(|| {
        StudyError::parameters("the claim has no [run.base], which the study needs")
    })?;
    let mut random = Random::new(seed);
    let sets: Vec<Vec<String>> = (0..MOST_DRAWN * scenes).map(|_| overrides(&mut random)).collect();
    let mut trials: Vec<Trial> = Vec::new();
    for sets in sets.chunks(scenes) {
        let tried = sets.par_iter().map(|set| {
            let file = RunFile { case: base.case.clone(), set: [&base.set[..], set].concat() };
            let case = laboratory.claim().load_case(&file)?;
            laboratory.work(|| Ok((compute(&case, element_updates)?, 0)))
        });
        let tried = tried.collect::<Result<Vec<_>, StudyError>>()?;
        let tried = tried.into_iter().zip(sets);
        trials.extend(
            tried.filter_map(|(trial, set)| {
                trial.map(|trial| Trial { scene: set.join(" "), ..trial })
            }),
        );
        trials.truncate(scenes);
        if trials.len() == scenes {
            break;
        }
    }
    let mut findings = Findings::new();
    let count = |is: fn(&Trial) -> bool| trials.iter().filter(|trial| is(trial)).count() as f64;
    findings.measure("scenes", trials.len() as f64);
    findings.measure("covered", count(|trial| trial.share() <= 1.0));
    findings.measure("met", count(Trial::is_met));
    findings.measure("foretold", count(|trial| trial.is_foretold));
    let mut ratios: Vec<f64> = trials.iter().flat_map(Trial::ratios).collect();
    ratios.sort_by(f64::total_cmp);
    findings.measure("bar", ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN));
    trials.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let rows = trials.iter().map(|trial| {
        let cell =
            |(_, error, bar): &(QuantityOfInterest, f64, f64)| format!("{error:+.1e} ± {bar:.1e}");
        let cells: Vec<String> = trial.numbers.iter().map(cell).collect();
        let mut row = vec![trial.scene.clone(), format!("{:.2}", trial.share())];
        row.extend(cells);
        row
    });
    let header = ["scene", "over the bar", "e", "T", "F", "approach", "a", "p0"];
    findings.tables.push(crate::findings::Table {
        caption: format!("Errors and bars of soft scenes, seed {seed}."),
        header: header.map(String::from).to_vec(),
        rows: rows.collect(),
    });
    Ok(findings)
}

/// A scene's keys.
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
    // Of the pair: radius, mass and modulus, the other ball beside the first.
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
    // Hertz: 2.94 δ/v, δ = a²/R*.
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

/// Returns nothing for a scene that is too expensive or whose run is stopped.
fn compute(case: &Case, element_updates: f64) -> Result<Option<Trial>, StudyError> {
    if Simulation::price(case)? as f64 > element_updates {
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
    let numbers = QuantityOfInterest::ALL.into_iter().filter_map(|headline| {
        let (value, fine) = (headline.of(collision)?, headline.of(&fine)?);
        let bar = errors.discretisation(headline)?;
        let scale = headline.scale(fine);
        let error = (value - fine) / (1.0 - FINER.powi(-2));
        Some((headline, error / scale, bar / scale))
    });
    let numbers: Vec<_> = numbers.collect();
    let has_warned =
        computed.warnings().iter().any(|warning| warning.contains("above the tolerance"));
    let is_foretold = is_foretold(simulation, collision, &small).unwrap_or(true);
    // A contact without an end has neither time nor bars.
    let is_whole = numbers.len() == QuantityOfInterest::ALL.len();
    let scene = String::new();
    Ok(is_whole.then_some(Trial { scene, numbers, has_warned, is_foretold }))
}

/// Whether time and force of a run without finite strain are as far from those with it as the plan says; nothing where
/// that run has none.
fn is_foretold(simulation: &Simulation, with: &Collision, without: &Collision) -> Option<bool> {
    let effect = EFFECTS.iter().find(|effect| effect.name() == FiniteStrain::NAME)?;
    let estimate = &simulation.setup().estimate;
    let foretold = effect.neglect_error(simulation.case().scene(), estimate)?;
    let hertz = &estimate.hertz;
    let is_within = |of: fn(&Collision) -> Option<f64>, foretold: Option<f64>, whole: f64| {
        let change = (of(without)? / of(with)? - 1.0).abs();
        Some(change <= FORETOLD_WITHIN * foretold? / whole + NOISE)
    };
    let time = is_within(|it| it.contact_time, foretold.contact_time_s, hertz.contact_time())?;
    let force = is_within(|it| it.peak_force, foretold.peak_force_n, hertz.peak_force())?;
    Some(time && force)
}

/// Returns the default tolerance of a quantity; approach and contact radius have none.
fn tolerance(headline: QuantityOfInterest) -> Option<f64> {
    let accuracy = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
    match headline {
        QuantityOfInterest::Restitution => Some(accuracy.restitution),
        QuantityOfInterest::ContactTime => Some(accuracy.contact_time),
        QuantityOfInterest::PeakForce => Some(accuracy.peak_force),
        QuantityOfInterest::PeakPressure => Some(accuracy.peak_pressure),
        QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => None,
    }
}

impl Trial {
    fn is_met(&self) -> bool {
        let is_within = |(headline, error, _): &(QuantityOfInterest, f64, f64)| {
            tolerance(*headline).is_none_or(|tolerance| error.abs() <= tolerance)
        };
        self.has_warned || self.numbers.iter().all(is_within)
    }

    /// The worst error over its bar.
    fn share(&self) -> f64 {
        let shares = self.numbers.iter().map(|(_, error, bar)| error.abs() / bar);
        shares.fold(0.0, fem_collision::nan_aware_max_abs)
    }

    fn ratios(&self) -> impl Iterator<Item = f64> {
        let least = 0.1 * Accuracy::DEFAULT_TOLERANCE;
        self.numbers.iter().map(move |(_, error, bar)| bar / error.abs().max(least))
    }
}
