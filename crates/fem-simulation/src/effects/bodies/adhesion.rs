//! Adhesion of the surfaces, which no model computes: the speed below which the bodies stick, and an estimate of the loss
//! above it.
//!
//! Decided by the loss of restitution ([`Adhesion`]). A case without a surface energy is judged by a typical one, with a
//! warning if that would matter. Bodies of a case that gives one stay together below their sticking speed
//! ([`crate::models`]).

use fem_case::engineering::{number, show};
use fem_case::{ModelChoice, Scene, WorkOfAdhesion};
use fem_collision::{Collision, QuantityOfInterest};
use fem_laws::Adhesion;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::simplified_scene::SimplifiedScene;
use crate::effects::decision::{
    AdhesionEffect, Effect, FiniteStrain, MaterialLoss, PartnerWaves, Vibration, is_needed,
};
use crate::effects::ting_prediction::TingPrediction;
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// Factor on the separation energy, and its inverse, between which it is open whether bodies stick.
const UNCERTAINTY_OF_ENERGY: f64 = 3.0;
/// Share of the energy by adhesion in all contacts above which it is warned of.
const LEAST_SHARE: f64 = 0.05;

impl Effect for AdhesionEffect {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let (adhesion, work) = (adhesion_of(scene)?, scene.work_of_adhesion());
        let (speed, sticking) = (estimate.hertz.approach_speed(), adhesion.sticking_speed());
        let (shown, below) = (show(work.value(), "J/m^2"), show(sticking, "m/s"));
        let loss = loss_above(scene, &largest(scene, &adhesion), estimate);
        let sticks = speed < sticking;
        let lost = format!(
            "{} {} of the restitution",
            if adhesion.is_jkr() && scene.adhesion_uncertainty() == 0.0 {
                "about"
            } else {
                "at most"
            },
            number(loss.unwrap_or_default(), 2)
        );
        let warning = match work {
            WorkOfAdhesion::Given(_) if is_open(shares(scene, &adhesion, speed)) => Some(format!(
                "the bodies may stay together by adhesion{}: by closed forms they stick below {below}, and the approach speed is \
                 {}; history and fields are those without adhesion",
                if sticks { ", as in this run" } else { "" },
                show(speed, "m/s")
            )),
            WorkOfAdhesion::Given(_) if sticks => Some(format!(
                "the bodies stay together by adhesion: they stick below {below}, and the approach speed is {}; history and \
                 fields are those without adhesion",
                show(speed, "m/s")
            )),
            WorkOfAdhesion::Given(_) => loss.map(|_| {
                format!("adhesion takes {lost} (sticking speed {below}), which no model computes")
            }),
            WorkOfAdhesion::Typical(_) if sticks => Some(format!(
                "the bodies would stick: with a typical work of adhesion of {shown} they do below {below}, and the \
                 approach speed is {}; set material.NAME.surface_energy, or contact.work_of_adhesion for the pair",
                show(speed, "m/s")
            )),
            WorkOfAdhesion::Typical(_) => loss.map(|_| {
                format!(
                    "bodies with a typical work of adhesion of {shown} would stick below {below}, and adhesion would take \
                     {lost}: set material.NAME.surface_energy, or contact.work_of_adhesion for the pair"
                )
            }),
        };
        let is_typical = matches!(work, WorkOfAdhesion::Typical(_));
        let number = match work.value() > 0.0 {
            true => format!(
                "approach speed / sticking speed = {} ({}work of adhesion {shown}, Tabor's number {})",
                number(speed / sticking, 2),
                if is_typical { "typical " } else { "" },
                number(adhesion.tabor(), 2),
            ),
            false => "no work of adhesion".to_string(),
        };
        Some(Relevance {
            is_needed: loss.is_some(),
            number,
            if_not_needed: String::new(),
            open_error: format!("closed forms take {lost}"),
            warning,
        })
    }

    /// Bodies that stick have no other losses.
    fn silences(&self, scene: &Scene, estimate: &Estimate) -> &'static [&'static str] {
        let speed = estimate.hertz.approach_speed();
        match adhesion_of(scene).is_some_and(|adhesion| speed < adhesion.sticking_speed()) {
            true => &[MaterialLoss::NAME, FiniteStrain::NAME, PartnerWaves::NAME, Vibration::NAME],
            false => &[],
        }
    }

    /// Difference between the impacts of Johnson, Kendall and Roberts and of Hertz, where the case gives a surface energy.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let adhesion = Self::given(scene)?;
        Some(NeglectError::of_changes(estimate, changes(scene, &adhesion, estimate)))
    }

    /// Later contacts of a ball that bounces: what they lose by adhesion adds up, and slow ones may stick.
    fn warnings_of_result(
        &self,
        scene: &Scene,
        _: &Estimate,
        collision: &Collision,
    ) -> Vec<String> {
        let Some(adhesion) = Self::given(scene).filter(|_| collision.bounces.len() > 1) else {
            return Vec::new();
        };
        let sticking = adhesion.sticking_speed();
        let numbered =
            || collision.bounces.iter().enumerate().map(|(k, one)| (k + 1, one.speed_before));
        let mut lost = 0.0;
        let spent = numbered().find(|(_, speed)| {
            lost += (sticking / speed).powi(2);
            lost >= 1.0
        });
        let near = numbered().find(|(_, speed)| is_open(shares(scene, &adhesion, *speed)));
        let near = near.filter(|(k, _)| *k > 1 && spent.is_none_or(|(rests, _)| *k < rests));
        let near = near.map(|(k, speed)| {
            format!(
                "contact {k}, at {}, is near the sticking speed of {}: the ball may stay there",
                show(speed, "m/s"),
                show(sticking, "m/s")
            )
        });
        let all = match spent {
            Some((k, _)) => Some(format!(
                "adhesion takes energy in each contact, which the run leaves out: with it the ball comes to rest in about {k} contacts"
            )),
            None => (lost > LEAST_SHARE).then(|| {
                format!(
                    "adhesion takes energy in each contact, which the run leaves out: in all {} of that of the ball",
                    percent(lost)
                )
            }),
        };
        near.into_iter().chain(all).collect()
    }

    /// The neglect error of all quantities. Near the sticking speed, bodies may stick or part, and all of the restitution is
    /// open; far below it they stick.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let Some(adhesion) = Self::given(scene).filter(|_| status.is_lacking) else {
            return match status.is_lacking && is_needed(self, scene, estimate) {
                true => QuantityErrors::default(),
                false => QuantityErrors::ZERO,
            };
        };
        let speed = estimate.hertz.approach_speed();
        let changes = changes(scene, &largest(scene, &adhesion), estimate);
        let errors = NeglectError::errors_of(estimate, changes);
        let share = (adhesion.sticking_speed() / speed).powi(2);
        let open = match is_open(shares(scene, &adhesion, speed)) {
            true => restitution_without(scene, estimate),
            false if share > 1.0 => 0.0,
            false => return errors,
        };
        errors.with(QuantityOfInterest::Restitution, open)
    }

    fn is_dissipative(&self) -> bool {
        true
    }
}

impl AdhesionEffect {
    /// Returns the adhesion of a scene's bodies, if the case gives it.
    pub(crate) fn given(scene: &Scene) -> Option<Adhesion> {
        let is_given = matches!(scene.work_of_adhesion(), WorkOfAdhesion::Given(_));
        adhesion_of(scene).filter(|_| is_given)
    }

    /// Returns whether the case's adhesion holds the bodies together for certain.
    pub(in crate::effects) fn surely_sticks(scene: &Scene, speed: f64) -> bool {
        let shares = |adhesion: Adhesion| shares(scene, &adhesion, speed);
        Self::given(scene).map(shares).is_some_and(|shares| shares[0] > 1.0 && !is_open(shares))
    }

    /// Returns whether a model lacks the effect. The loss of a contact law is the user's, unless the case gives a surface
    /// energy or bodies like these would stick.
    pub(crate) fn is_lacking(scene: &Scene, speed: f64) -> bool {
        let sticks = |it: Adhesion| speed < it.sticking_speed();
        !matches!(scene.model(), ModelChoice::Law { .. })
            || Self::given(scene).is_some()
            || adhesion_of(scene).is_some_and(sticks)
    }
}

/// Returns the adhesion that is larger by the uncertainty of its work.
fn largest(scene: &Scene, adhesion: &Adhesion) -> Adhesion {
    let most = adhesion.work_of_adhesion() + scene.adhesion_uncertainty();
    Adhesion::new(adhesion.pair(), most)
}

/// Returns whether it is open whether bodies stick, for a range of the separation energy over the kinetic one.
fn is_open([least, most]: [f64; 2]) -> bool {
    least <= UNCERTAINTY_OF_ENERGY && most >= UNCERTAINTY_OF_ENERGY.recip()
}

/// Returns the least and the largest separation energy over the kinetic one at an approach speed, m/s, by the uncertainty of the work of
/// adhesion.
fn shares(scene: &Scene, adhesion: &Adhesion, speed: f64) -> [f64; 2] {
    let uncertainty = scene.adhesion_uncertainty();
    [-uncertainty, uncertainty].map(|change| {
        let work = (adhesion.work_of_adhesion() + change).max(0.0);
        (Adhesion::new(adhesion.pair(), work).sticking_speed() / speed).powi(2)
    })
}

fn adhesion_of(scene: &Scene) -> Option<Adhesion> {
    Some(Adhesion::new(&scene.pair().ok()?, scene.work_of_adhesion().value()))
}

/// Returns the change of the quantities by adhesion in the order of a summary, that of the restitution absolute.
fn changes(scene: &Scene, adhesion: &Adhesion, estimate: &Estimate) -> [f64; 6] {
    if adhesion.work_of_adhesion() == 0.0 {
        return [0.0; 6];
    }
    let [_, others @ ..] = adhesion.change(&estimate.hertz);
    let mut changes = [loss(scene, adhesion, estimate); 6];
    changes[1..].copy_from_slice(&others);
    changes
}

/// Returns the loss of restitution by adhesion if it is above the tolerance of the case.
fn loss_above(scene: &Scene, adhesion: &Adhesion, estimate: &Estimate) -> Option<f64> {
    let tolerance = scene.accuracy().restitution;
    // No restitution loses more than that; the one without adhesion takes milliseconds.
    let is_possible = adhesion.sticking_speed() / estimate.hertz.approach_speed() > tolerance;
    is_possible.then(|| loss(scene, adhesion, estimate)).filter(|loss| *loss > tolerance)
}

/// Returns the loss of restitution by adhesion.
fn loss(scene: &Scene, adhesion: &Adhesion, estimate: &Estimate) -> f64 {
    let without = restitution_without(scene, estimate);
    without - adhesion.restitution(estimate.hertz.approach_speed(), without)
}

/// Returns the restitution without adhesion by Ting's prediction; 1 if it has none.
fn restitution_without(scene: &Scene, estimate: &Estimate) -> f64 {
    let computed = SimplifiedScene::quiet(scene.clone(), estimate);
    let prediction = computed.and_then(|regime| TingPrediction::of(&regime, false).ok());
    prediction.map_or(1.0, |prediction| prediction.restitution)
}
