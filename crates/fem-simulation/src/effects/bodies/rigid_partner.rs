//! A body that is much stiffer than its partner is computed as rigid, with its own mass and curvature: one degree of
//! freedom replaces its elements. A stiff half-space becomes a wall.
//!
//! Decided by the body's share s of the contact's compliance, s = k/(k₁+k₂), k = (1 − ν²)/E. Neglecting the share
//! multiplies the contact modulus by 1/(1 − s), and Hertz' powers give the change for elastic bodies
//! ([`fem_laws::rigid_partner`]). The relaxation and radiation of the body are neglected, too.

use fem_case::{Body, Scene, Switch};

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::simplified_scene::{Transformation, TransformedScene};
use crate::effects::decision::support::Support;
use crate::effects::decision::{Effect, NamedEffect, RigidPartner};
use crate::effects::ting_prediction::change_between;
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Share of the compliance below which a body is rigid: 4e-5 of the contact time.
const RIGID_SHARE: f64 = 1e-4;

impl Effect for RigidPartner {
    /// It saves work: a scene may allow the effect, but none calls for it.
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let number =
            stiffer(scene).map_or_else(|| "the partner is rigid".to_string(), |s| s.number());
        Some(Relevance { number, ..Relevance::default() })
    }

    fn transform(
        &self,
        scene: &Scene,
        _: &Estimate,
    ) -> Result<Option<TransformedScene>, Rejection> {
        let is_forced = scene.effects().rigid_partner == Some(Switch::On);
        let stiffer = stiffer(scene).filter(|_| scene.effects().rigid_partner != Some(Switch::Off));
        let Some(stiffer) = stiffer.filter(|stiffer| is_forced || stiffer.is_rigid()) else {
            return match is_forced {
                true => Err(rejected("rigid_partner is \"on\", and there is a wall already")),
                false => Ok(None),
            };
        };
        if is_forced && scene.effects().mirror_symmetry == Some(Switch::On) {
            return Err(rejected("rigid_partner and mirror_symmetry are both \"on\""));
        }
        let number = stiffer.number();
        let support =
            Support::decided(true, format!("{number}: it is computed as rigid, with its own mass"));
        let mut shapes = scene.bodies().each_ref().map(|body| body.shape().clone());
        shapes[stiffer.side] = stiffer.body.rigid();
        let scene = RigidPartner.switched(scene, None).with_shapes(shapes);
        Ok(Some(TransformedScene { scene, outcome: Transformation::Decides(support) }))
    }

    fn forced(&self, scene: &Scene, estimate: &Estimate) -> Option<String> {
        let is_forced = scene.effects().rigid_partner == Some(Switch::On);
        let stiffer = stiffer(scene).filter(|stiffer| is_forced && !stiffer.is_rigid())?;
        let (number, change) = (stiffer.number(), change(scene, estimate));
        Some(format!("{number} and is forced to be rigid, which changes {change}"))
    }

    /// Returns the error of taking a body as rigid, in any model.
    fn model_form_error(
        &self,
        _: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        status.neglect_error.unwrap_or_default().of_all_quantities(estimate)
    }

    /// Returns the error of a body that is taken as rigid: its compliance, relaxation and radiation are missing.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let switch = scene.effects().rigid_partner;
        let taken = stiffer(scene).filter(|stiffer| match switch {
            Some(Switch::On) => true,
            Some(Switch::Off) => false,
            _ => stiffer.is_rigid(),
        });
        Some(taken.map_or(NeglectError::NOTHING, |_| change(scene, estimate)))
    }
}

/// Returns the error of taking the stiffer body as rigid.
fn change(scene: &Scene, estimate: &Estimate) -> NeglectError {
    let [rigid, whole] =
        [Switch::On, Switch::Off].map(|switch| RigidPartner.switched(scene, Some(switch)));
    change_between(rigid, whole, estimate)
}

fn rejected(message: &str) -> Rejection {
    Rejection::new("effects.rigid_partner", message)
        .with_help("write \"auto\" or \"off\", or leave it out")
}

/// The stiffer body and its share of the compliance.
struct Stiffer<'a> {
    body: &'a Body,
    side: usize,
    share: f64,
}

/// Returns the stiffer body, or `None` if a body is rigid already.
fn stiffer(scene: &Scene) -> Option<Stiffer<'_>> {
    let [lower, upper] = scene.bodies();
    let [below, above] = [lower, upper].map(|body| body.partner().plane_strain_modulus());
    if below.is_infinite() || above.is_infinite() {
        return None;
    }
    let side = if below > above { 0 } else { 1 };
    let share = scene.compliance_shares()[side];
    Some(Stiffer { body: &scene.bodies()[side], side, share })
}

impl Stiffer<'_> {
    /// A plate that bends is not rigid, however stiff.
    fn is_rigid(&self) -> bool {
        self.share <= RIGID_SHARE && self.body.plate().is_none()
    }

    /// Returns the deciding number, as text.
    fn number(&self) -> String {
        format!("{} contributes {} of the compliance", self.body.name(), percent(self.share))
    }
}
