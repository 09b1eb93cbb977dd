//! Relaxation of the materials: a part of the step of models that have fields, and of Ting's.
//!
//! Decided by the share of the modulus that is lost over one contact time, Σ g (1 − exp(−T/τ)).

use fem_case::{Body, EffectsTable, Scene, Switch};
use fem_material::Material;

use super::answer::Answer;
use super::effect::Effect;
use super::left_out::LeftOut;
use super::need::{Need, percent};
use super::transformed::Transformed;
use crate::estimate::Estimate;
use crate::quasi_static::estimated;
use crate::refusal::Refusal;

/// Relaxation of the materials.
#[derive(Clone, Copy, Debug)]
pub struct Viscoelasticity;

impl Viscoelasticity {
    /// Its name in results.
    pub const NAME: &'static str = "viscoelasticity";
}

impl Effect for Viscoelasticity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.viscoelasticity
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let relaxing = relaxing(scene);
        if relaxing.is_empty() {
            return Some(Need { number: "no material relaxes".to_string(), ..Need::default() });
        }
        let number = format!(
            "{} relax{}: {} of the modulus is lost over one contact time",
            relaxing.join(" and "),
            if relaxing.len() == 1 { "es" } else { "" },
            percent(estimate.relaxed),
        );
        Some(Need { is_called_for: true, number, ..Need::default() })
    }

    /// What is switched off is not there: the materials are elastic.
    fn transform(
        &self,
        scene: &Scene,
        estimate: &Estimate,
    ) -> Result<Option<Transformed>, Refusal> {
        if scene.effects().viscoelasticity != Some(Switch::Off) || relaxing(scene).is_empty() {
            return Ok(None);
        }
        let elastic = scene.bodies().each_ref().map(|body| match body.material() {
            Some(material) => body.shape_of(material.without_relaxation()),
            None => body.shape().clone(),
        });
        let need = self.need(scene, estimate).unwrap_or_default();
        let left_out = self.left_out(scene, estimate).unwrap_or_default();
        let answer = Answer::is(false, format!("{}; switched off", need.number))
            .warning([left_out.warning(Self::NAME)]);
        Ok(Some(Transformed { scene: scene.clone().with_shapes(elastic), answer }))
    }

    /// The difference of Ting's impacts of relaxing and of elastic half-spaces.
    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        if relaxing(scene).is_empty() {
            return Some(LeftOut::NOTHING);
        }
        let with = estimated(scene, estimate, true, None)?;
        Some(LeftOut::between(&with, &estimate.hertz.impact()))
    }
}

/// Names of the bodies that relax.
fn relaxing(scene: &Scene) -> Vec<&str> {
    let relaxes = |body: &&Body| body.material().and_then(Material::relaxation).is_some();
    scene.bodies().iter().filter(relaxes).map(Body::name).collect()
}
