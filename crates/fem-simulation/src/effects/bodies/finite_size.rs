//! A sphere is stiffer than the half-space of Hertz: its own compliance, in series, to first order.

use fem_case::{Body, Scene};
use fem_collision::QuantityOfInterest;

use crate::effects::effect::computed_scene::ComputedScene;
use crate::effects::effect::model_form_error::{EffectStatus, ModelFormError};
use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::relevance::percent;
use crate::effects::effect::support::Support;
use crate::effects::effect::{Effect, FiniteSizeEffect, Vibration};
use crate::effects::ting_prediction::{TingPrediction, relaxed_loss};
use crate::estimate::Estimate;

/// Second order of the contact's size over the spheres', of contact time and peak force: Ting's with
/// finite size is within 0.02 % of finite elements at a/R* = 0.05.
const SECOND_ORDER: f64 = 0.1;

const PRESSURE: f64 = 0.15;

/// What the spheres' own compliance adds to Hertz' approach, over it, up to which its first order is
/// right to 1 % in contact time and force, and half-spaces without it to 5 %. Materials that are harder
/// to shear than to compress go beyond, at Poisson's ratios below −0.9.
const LARGEST_SHARE: f64 = 0.1;

/// The same up to which what it changes is told at all: spheres of up to 0.18 were compared.
const LARGEST_KNOWN: f64 = 0.25;

impl FiniteSizeEffect {
    /// Returns the answer of a model that includes the first order of the effect, or does not, with the
    /// reason.
    pub(crate) fn of_first_order(
        scene: &Scene,
        estimate: &Estimate,
        (is_there, reason): (bool, &str),
    ) -> Support {
        let share = Self::share(scene, estimate).unwrap_or_default();
        let warning = (share > LARGEST_SHARE).then(|| {
            let model_form_error = match is_there {
                true => "its first order, which is all that this model has, is in doubt",
                false => "half-spaces, which this model takes the spheres for, are in doubt",
            };
            format!(
                "the spheres' own compliance adds {} to Hertz' approach; above {} {model_form_error}: use model {}",
                percent(share),
                percent(LARGEST_SHARE),
                Vibration::models_that_serve(estimate)
            )
        });
        Support::is(is_there, reason).warning(warning)
    }

    /// What it changes where its first order does not go through the collision, as of contacts that relaxation makes
    /// wide: a share s of the approach makes a contact stiffer or softer by (1 − s)^(−3/2), of which contact time and
    /// force follow with the power 2/5. Spheres that relax to 3 % and less are 5 to 10 % off without it where this
    /// has 6 to 12 %. What relaxation takes of the restitution changes with the time it has.
    fn by_stiffness(scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let share = Self::share(scene, estimate).filter(|share| *share < LARGEST_KNOWN)?;
        let change = 0.6 * share;
        let restitution = Some(change * relaxed_loss(scene, estimate));
        Some(NeglectError { restitution, ..NeglectError::shares(estimate, change, change) })
    }

    /// Returns the largest relative error of the half-space pressure.
    fn of_pressure(scene: &Scene, estimate: &Estimate) -> f64 {
        let materials = scene.bodies().iter().filter_map(Body::material);
        let sideways =
            materials.map(|material| 1.0 - 2.0 * material.instantaneous().poissons_ratio());
        PRESSURE * sideways.fold(0.0, f64::max) * estimate.strain
    }

    /// Returns the share of the spheres' own compliance in Hertz' approach, with the effective moduli.
    fn share(scene: &Scene, estimate: &Estimate) -> Option<f64> {
        let hertz = &estimate.effective.hertz;
        let size = estimate.effective.elastic_equivalent(scene).finite_size().ok()?;
        let added = size.added_approach(hertz.peak_force(), hertz.max_contact_radius());
        Some((added / hertz.max_approach()).abs())
    }
}

impl Effect for FiniteSizeEffect {
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let scene = ComputedScene::quiet(scene)?;
        let speed = estimate.hertz.approach_speed();
        let [with, without] =
            [true, false].map(|size| TingPrediction::of(&scene, speed, size).ok());
        match with.zip(without) {
            Some((with, without)) => Some(with.change_from(&without)),
            None => Self::by_stiffness(&scene, estimate),
        }
    }

    /// Where it is a term it is its first order; of the pressure no model of half-spaces has it.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> ModelFormError {
        let second_order = SECOND_ORDER * estimate.strain.powi(2);
        let of_size = match status.is_lacking {
            true => ModelFormError::of(&status.neglect_error.unwrap_or_default(), estimate),
            false => ModelFormError::of(
                &NeglectError::shares(estimate, second_order, second_order),
                estimate,
            ),
        };
        let pressure = Self::of_pressure(scene, estimate) * estimate.effective.sizes.peak_pressure;
        match of_size.size(QuantityOfInterest::PeakPressure) {
            Some(size) => of_size.with(QuantityOfInterest::PeakPressure, size + pressure),
            None => of_size,
        }
    }
}
