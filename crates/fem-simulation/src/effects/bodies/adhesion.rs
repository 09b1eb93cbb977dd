//! Adhesion of the surfaces, which no model computes: the speed below which the bodies stick, and an estimate of the loss
//! above it.
//!
//! Decided by the loss of restitution ([`Adhesion`]). A case without a surface energy is judged by a typical one, with a
//! warning if that would matter. Bodies of a case that gives one stay together below their sticking speed
//! ([`crate::models`]).

use fem_case::engineering::{number, show};
use fem_case::{ModelChoice, Scene, WorkOfAdhesion};
use fem_collision::QuantityOfInterest;
use fem_laws::Adhesion;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::simplified_scene::SimplifiedScene;
use crate::effects::decision::{
    AdhesionEffect, Effect, FiniteStrain, MaterialLoss, PartnerWaves, Vibration, is_needed,
};
use crate::effects::ting_prediction::TingPrediction;
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// Factor on the separation energy, and its inverse, between which it is open whether bodies stick.
const UNCERTAINTY_OF_ENERGY: f64 = 3.0;

impl Effect for AdhesionEffect {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let (adhesion, work) = (adhesion_of(scene)?, scene.work_of_adhesion());
        let (speed, sticking) = (estimate.hertz.approach_speed(), adhesion.sticking_speed());
        let (shown, below) = (show(work.value(), "J/m^2"), show(sticking, "m/s"));
        let loss = loss_above(scene, &adhesion, speed, scene.accuracy().restitution);
        let sticks = speed < sticking;
        let lost = format!(
            "{} {} of the restitution",
            if adhesion.is_jkr() { "about" } else { "at most" },
            number(loss.unwrap_or_default(), 2)
        );
        let warning = match work {
            WorkOfAdhesion::Given(_) if sticks && is_open((sticking / speed).powi(2)) => {
                Some(format!(
                    "the bodies may stay together by adhesion, as in this run: by closed forms they stick below {below}, and \
                     the approach speed is {}; history and fields are those without adhesion",
                    show(speed, "m/s")
                ))
            }
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
        let errors = NeglectError::errors_of(estimate, changes(scene, &adhesion, estimate));
        let share = (adhesion.sticking_speed() / speed).powi(2);
        let open = match is_open(share) {
            true => restitution_without(scene, speed),
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
        let share = |adhesion: Adhesion| (adhesion.sticking_speed() / speed).powi(2);
        Self::given(scene).map(share).is_some_and(|share| share > 1.0 && !is_open(share))
    }

    /// Returns whether a model lacks the effect. The loss of a contact law is the user's, unless the case gives a surface
    /// energy.
    pub(crate) fn is_lacking(scene: &Scene) -> bool {
        !matches!(scene.model(), ModelChoice::Law { .. }) || Self::given(scene).is_some()
    }
}

/// Returns whether it is open whether bodies stick, at a separation energy over the kinetic one.
fn is_open(share: f64) -> bool {
    (UNCERTAINTY_OF_ENERGY.recip()..=UNCERTAINTY_OF_ENERGY).contains(&share)
}

fn adhesion_of(scene: &Scene) -> Option<Adhesion> {
    Some(Adhesion::new(&scene.pair().ok()?, scene.work_of_adhesion().value()))
}

/// Returns the change of the quantities by adhesion in the order of a summary, that of the restitution absolute.
fn changes(scene: &Scene, adhesion: &Adhesion, estimate: &Estimate) -> [f64; 6] {
    let speed = estimate.hertz.approach_speed();
    if adhesion.work_of_adhesion() == 0.0 {
        return [0.0; 6];
    }
    let [_, others @ ..] = adhesion.change(&estimate.hertz);
    let mut changes = [loss(scene, adhesion, speed); 6];
    changes[1..].copy_from_slice(&others);
    changes
}

/// Returns the loss of restitution by adhesion if it is above a tolerance.
fn loss_above(scene: &Scene, adhesion: &Adhesion, speed: f64, tolerance: f64) -> Option<f64> {
    // No restitution loses more than that; the one without adhesion takes milliseconds.
    let is_possible = adhesion.sticking_speed() / speed > tolerance;
    is_possible.then(|| loss(scene, adhesion, speed)).filter(|loss| *loss > tolerance)
}

/// Returns the loss of restitution by adhesion.
fn loss(scene: &Scene, adhesion: &Adhesion, speed: f64) -> f64 {
    let without = restitution_without(scene, speed);
    without - adhesion.restitution(speed, without)
}

/// Returns the restitution without adhesion by Ting's prediction; 1 if it has none.
fn restitution_without(scene: &Scene, speed: f64) -> f64 {
    let computed = SimplifiedScene::quiet(scene);
    let prediction = computed.and_then(|scene| TingPrediction::of(&scene, speed, false).ok());
    prediction.map_or(1.0, |prediction| prediction.restitution)
}
