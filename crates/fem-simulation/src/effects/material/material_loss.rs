//! Loss of the material itself, for materials of the library without a relaxation: a collision without it has too large a
//! restitution, by an unknown amount.

use fem_case::Scene;
use fem_collision::QuantityOfInterest;

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::{AdhesionEffect, Effect, MaterialLoss};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

impl Effect for MaterialLoss {
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let warning = scene.unknown_loss();
        Some(Relevance {
            is_needed: warning.is_some(),
            number: format!("no loss of {} is given", scene.materials_without_loss().join(" and ")),
            warning,
            ..Relevance::default()
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
            let is_unknown =
                status.is_lacking && !sticks && quantity == QuantityOfInterest::Restitution;
            (!is_unknown).then_some(0.0)
        })
    }
}

impl MaterialLoss {
    /// Returns whether a scene has such a material.
    pub(crate) fn is_unknown(scene: &Scene) -> bool {
        !scene.materials_without_loss().is_empty()
    }
}
