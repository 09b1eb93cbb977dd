//! Loss of the material itself, for materials without a relaxation. A case that gives its own elastic material asks for a
//! collision without it. A material of the library has a loss that is not known: the restitution is too large, by an unknown
//! amount, which the effect says, with the measured restitutions of the material where there are some. It does not warn: the
//! user has no relaxation to give.

use fem_case::{Body, ModelChoice, Scene};
use fem_collision::QuantityOfInterest;

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::{AdhesionEffect, Effect, MaterialLoss};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

impl Effect for MaterialLoss {
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let bodies: Vec<&str> = scene.elastic_bodies().map(Body::name).collect();
        if bodies.is_empty() {
            let number = "a material flows, but not in this collision".to_string();
            let if_not_needed = "computed as elastic".to_string();
            return Some(Relevance { number, if_not_needed, ..Relevance::default() });
        }
        let names = scene.materials_without_loss();
        let number = match names.is_empty() {
            true => format!("the case gives no relaxation for {}", bodies.join(" and ")),
            false => format!("the library has no relaxation for {}", names.join(" and ")),
        };
        Some(Relevance {
            is_needed: !names.is_empty(),
            number,
            if_not_needed: "computed as elastic, without a loss of the material".to_string(),
            open_error: scene.too_high_a_restitution(),
            warning: None,
        })
    }

    /// The restitution is unknown, unless the bodies stick. The other quantities depend on the moduli.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let sticks = AdhesionEffect::surely_sticks(scene, estimate.hertz.approach_speed());
        QuantityErrors::from_fn(|quantity| {
            let is_unknown = Self::is_unknown(scene)
                && status.is_lacking
                && !sticks
                && quantity == QuantityOfInterest::Restitution;
            (!is_unknown).then_some(0.0)
        })
    }
}

impl MaterialLoss {
    /// Returns whether a scene has such a material.
    fn is_unknown(scene: &Scene) -> bool {
        !scene.materials_without_loss().is_empty()
    }

    /// Returns whether a model has no loss of a material. The loss of a contact law is the user's.
    pub(crate) fn is_lacking(scene: &Scene) -> bool {
        let is_law = matches!(scene.model(), ModelChoice::Law { .. });
        !is_law && scene.elastic_bodies().next().is_some()
    }
}
