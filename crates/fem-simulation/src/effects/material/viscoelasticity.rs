//! Relaxation of the materials, computed by elements and by Ting's model.
//!
//! Decided by the share of the modulus that is lost over one contact time, Σ g (1 − exp(−T/τ)). Single terms that are much
//! faster or slower than the contact are folded into the moduli ([`FastSlowLimits`]).

use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_laws::{FastSlowLimits, RelativeError};
use fem_material::Material;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::simplified_scene::{
    SimplifiedScene, Transformation, TransformedScene,
};
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, NamedEffect, Viscoelasticity};
use crate::effects::ting_prediction::{TingPrediction, change_between};
use crate::estimate::Estimate;
use crate::estimate::quasi_static::ting_of;
use crate::models::Reduced;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Largest error by all folded terms in restitution (absolute), contact time and peak force: a hundredth of the default
/// tolerance.
const MAX_FOLDED: f64 = 1e-4;
/// Largest error by folded terms over the loss of restitution by relaxation, which keeps small losses accurate.
const SHARE_OF_LOSS: f64 = 0.01;
/// Smallest tolerance of the folded terms.
const MIN_FOLDED: f64 = 1e-7;
/// Accuracy of the loss that decides on the tolerance.
const LOSS_TOLERANCE: f64 = 1e-5;

impl Effect for Viscoelasticity {
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        model.with_or_without(self)
    }

    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let relaxing = relaxing(scene);
        if relaxing.is_empty() {
            return Some(Relevance {
                number: "no material relaxes".to_string(),
                ..Relevance::default()
            });
        }
        let number = format!(
            "{} relax{}: {} of the modulus is lost over one contact time",
            relaxing.join(" and "),
            if relaxing.len() == 1 { "es" } else { "" },
            percent(estimate.relaxed),
        );
        Some(Relevance { is_needed: true, number, ..Relevance::default() })
    }

    /// Makes the materials elastic if the effect is switched off, and folds the terms that do not matter within the contact
    /// if the plan decides.
    fn transform(
        &self,
        scene: &Scene,
        estimate: &Estimate,
    ) -> Result<Option<TransformedScene>, Rejection> {
        if relaxing(scene).is_empty() {
            return Ok(None);
        }
        Ok(match scene.effects().viscoelasticity {
            Some(Switch::On) => None,
            Some(Switch::Off) => {
                let number = self.relevance(scene, estimate).unwrap_or_default().number;
                let support = Support::decided(false, format!("{number}; switched off"));
                let outcome = Transformation::Decides(support);
                let scene = elastic(scene, materials(scene));
                Some(TransformedScene { scene, outcome })
            }
            Some(Switch::Auto) | None => self.folded(scene, estimate).map(|folded| {
                let outcome = Transformation::LeavesToModel(in_words(&folded, estimate));
                TransformedScene { scene: scene.clone().with_materials(folded.materials), outcome }
            }),
        })
    }

    fn forced(&self, scene: &Scene, estimate: &Estimate) -> Option<String> {
        let is_off = scene.effects().viscoelasticity == Some(Switch::Off);
        let neglect_error =
            (is_off && !relaxing(scene).is_empty()).then(|| self.neglect_error(scene, estimate));
        neglect_error.map(|neglect_error| neglect_error.unwrap_or_default().warning(Self::NAME))
    }

    /// Difference between Ting's impacts of relaxing and of elastic bodies, with the waves radiated by
    /// each. Elastic bodies of a model without relaxation have the moduli with the folded terms.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        if relaxing(scene).is_empty() {
            return Some(NeglectError::NOTHING);
        }
        let followed = match scene.effects().viscoelasticity {
            Some(Switch::Off) => Some(Switch::Auto),
            own => own,
        };
        let with = self.switched(scene, followed);
        let is_elastic =
            matches!(scene.model(), ModelChoice::Hertz { .. } | ModelChoice::Law { .. });
        let folded = self.transform(scene, estimate).ok().flatten().filter(|_| is_elastic);
        let without = match folded {
            Some(folded) => elastic(&folded.scene, materials(&folded.scene)),
            None => self.switched(scene, Some(Switch::Off)),
        };
        Some(change_between(with, without, estimate))
    }

    /// A law whose damping is the slow limit of the materials differs from them where they do not relax within the contact.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        match scene.model() {
            ModelChoice::Law { law, .. } if law.is_slow_limit() && !relaxing(scene).is_empty() => {
                error_of_slow_limit(scene, estimate).unwrap_or_default()
            }
            _ => status.error(self, scene, estimate),
        }
    }
}

/// Returns the distances of a law's quantities from those of Ting's model of the same bodies.
fn error_of_slow_limit(scene: &Scene, estimate: &Estimate) -> Option<QuantityErrors> {
    let speed = estimate.hertz.approach_speed();
    let computed = SimplifiedScene::quiet(scene.clone(), estimate)?;
    let ting = TingPrediction::of(&computed, false).ok()?;
    let own = TingPrediction::from(&Reduced::of(&computed).ok()?.impact(speed).ok()?);
    Some(own.change_from(&ting).of_all_quantities(estimate))
}

impl Viscoelasticity {
    /// Returns the materials without the folded terms, or `None` if no term is folded.
    fn folded(&self, scene: &Scene, estimate: &Estimate) -> Option<FastSlowLimits> {
        // Terms that are too slow for an impact still act on a ball at rest.
        if scene.gravity().is_some() {
            return None;
        }
        let fold = |share: f64| {
            let tolerance =
                RelativeError { restitution: share, contact_time: share, peak_force: share };
            let contact_time = estimate.hertz.contact_time();
            let folded = FastSlowLimits::new(materials(scene), contact_time, &tolerance).ok()?;
            let n_folded: usize = folded.n_fast.into_iter().chain(folded.n_slow).sum();
            (n_folded > 0).then_some(folded)
        };
        // The loss is expensive to compute, and most scenes have no term to fold.
        fold(MAX_FOLDED)?;
        let loss = loss(scene, estimate)?;
        fold((SHARE_OF_LOSS * loss).clamp(MIN_FOLDED, MAX_FOLDED))
    }
}

/// Returns the loss of restitution of half-spaces by all relaxation terms.
fn loss(scene: &Scene, estimate: &Estimate) -> Option<f64> {
    let hertz = &estimate.hertz;
    let ting =
        ting_of(scene, hertz.pair(), true, None).ok()?.with_tolerance(LOSS_TOLERANCE).ok()?;
    let relaxing = estimate.impacts.impact(ting, hertz.approach_speed()).ok()?.restitution;
    Some((relaxing - hertz.restitution()).abs())
}

/// Returns the numbers of remaining and folded terms and the error of folding, as text.
fn in_words(folded: &FastSlowLimits, estimate: &Estimate) -> String {
    let sum = |counts: [usize; 2]| counts.iter().sum::<usize>();
    let (n_fast, n_slow) = (sum(folded.n_fast), sum(folded.n_slow));
    let n_kept: usize = folded.materials.iter().map(n_terms).sum();
    let RelativeError { restitution, contact_time, peak_force } = folded.error;
    let error = NeglectError {
        restitution: Some(restitution.abs()),
        ..NeglectError::shares(estimate, contact_time, peak_force)
    };
    format!(
        "{n_kept} of {} terms remain; {n_fast} faster and {n_slow} slower than the contact are folded into the moduli, \
         which changes {error}",
        n_kept + n_fast + n_slow
    )
}

/// Returns the scene with these materials as elastic ones.
fn elastic(scene: &Scene, materials: [Option<&Material>; 2]) -> Scene {
    let elastic = materials.map(|material| material.map(Material::without_relaxation));
    scene.clone().with_materials(elastic)
}

fn n_terms(material: &Option<Material>) -> usize {
    let series = material.as_ref().and_then(Material::relaxation);
    series.map_or(0, |series| series.terms().len())
}

fn materials(scene: &Scene) -> [Option<&Material>; 2] {
    scene.bodies().each_ref().map(Body::material)
}

/// Returns the names of the relaxing bodies.
fn relaxing(scene: &Scene) -> Vec<&str> {
    let relaxes = |body: &&Body| body.material().and_then(Material::relaxation).is_some();
    scene.bodies().iter().filter(relaxes).map(Body::name).collect()
}
