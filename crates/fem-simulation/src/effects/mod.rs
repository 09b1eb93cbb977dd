//! Effects: which of them a run computes, and the error of those that it neglects.
//!
//! ```text
//! Relevance  does the scene call for the effect?       ─┐
//! Support    does the model include the effect?         ├─ decide ─ EffectDecision, warnings or a rejection
//! Switch     what does the case say: auto, on, off?    ─┘
//! ```
//!
//! An effect acts in the cheapest place. It transforms the scene (a rigid partner, folded relaxation terms), is a
//! decision of the plan (mass scaling), is a part of the step (relaxation, gravity), or continues after the collision
//! (gravity, from bounce to bounce). Mirror symmetry transforms the scene too, but the results of both bodies have to be
//! restored, so methods with meshes call it themselves. [`EFFECTS`] lists all effects.

mod bodies;
mod decision;
mod material;
mod numerics;
pub(crate) mod ting_prediction;

use fem_case::{ModelChoice, Scene, Shape, Switch};
use fem_collision::Collision;
use fem_material::Material;
use serde::Serialize;

use crate::estimate::Estimate;
use crate::estimate::plastic_flow::{FlowingImpact, mean_pressure_impact};
use crate::estimate::plate_impact::PlateImpact;
use crate::rejection::Rejection;

pub(crate) use decision::effect_named;
pub use decision::neglect_error::{EffectStatus, NeglectError};
pub(crate) use decision::relevance::MACH_LIMIT;
pub use decision::relevance::{QUASI_STATIC_LIMIT, Relevance, percent};
pub(crate) use decision::simplified_scene::SimplifiedScene;
pub use decision::simplified_scene::{Transformation, TransformedScene};
pub use decision::support::{Adequacy, ConsideredModel, Support};
pub use decision::{
    AdhesionEffect, BulkViscosity, ContactSearch, DashpotEffect, EFFECTS, Effect, EffectKind,
    FiniteSizeEffect, FiniteStrain, FrictionEffect, Gravity, HourglassControl, MassScaling,
    MaterialLoss, MirrorSymmetry, NamedEffect, PartnerWaves, PenaltySprings, PlasticFlow,
    PlateBending, RateDependence, RigidPartner, SurfaceSlip, TangentialCoupling, Vibration,
    Viscoelasticity,
};
pub(crate) use numerics::mass_scaling::MAX_MOVED_MASS;

/// The decision on one effect, with its reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct EffectDecision {
    /// The effect's name.
    pub name: &'static str,
    /// Whether the run computes it.
    pub active: bool,
    /// The deciding number, as text.
    pub reason: String,
    /// Whether the effect matters to what a reader should know: it is physics that the run computes, one that the scene needs
    /// and the run lacks, or one that is warned of.
    pub matters: bool,
    /// Whether the run lacks the effect: it is off in a model that could leave it out.
    #[serde(skip)]
    pub is_lacking: bool,
}

/// The decisions on all effects of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EffectDecisions {
    /// Decisions on the effects that the model supports or lacks, in the order of [`EFFECTS`].
    pub all: Vec<EffectDecision>,
    /// Warnings in the same order.
    pub warnings: Vec<String>,
    /// Warnings of the finished collision.
    pub(crate) warnings_of_result: Vec<String>,
    /// Names of effects whose warnings are pointless beside one that the run lacks.
    silenced: Vec<&'static str>,
}

impl EffectDecisions {
    /// Returns whether the effect of this name is on.
    pub(crate) fn is_active(&self, name: &str) -> bool {
        self.all.iter().any(|decision| decision.name == name && decision.active)
    }

    /// Replaces decisions by those that the finished collision shows, and adds the warnings of its result. An effect that is
    /// warned of matters.
    pub(crate) fn update_from_result(
        &mut self,
        scene: &Scene,
        estimate: Option<&Estimate>,
        collision: &Collision,
    ) {
        for decision in &mut self.all {
            let found = effect_named(decision.name)
                .and_then(|effect| effect.support_in_result(scene, collision));
            if let Some(Support::Is { active, reason, .. }) = found {
                (decision.active, decision.reason) = (active, reason);
                let kind = effect_named(decision.name).map(|effect| effect.kind());
                decision.matters |= active && kind == Some(EffectKind::Physical);
            }
        }
        let Some(estimate) = estimate else { return };
        for effect in EFFECTS.iter().filter(|effect| !self.silenced.contains(&effect.name())) {
            let warnings = effect.warnings_of_result(scene, estimate, collision);
            let own = self.all.iter_mut().find(|decision| decision.name == effect.name());
            if let (Some(decision), false) = (own, warnings.is_empty()) {
                decision.matters = true;
            }
            self.warnings_of_result.extend(warnings);
        }
    }
}

/// Decides on all effects of a scene. `support` returns the model's support for an effect, if
/// it has a use for it.
///
/// # Errors
/// An effect that the case forces on and the model lacks, or forces off and the model cannot leave out.
pub fn decide(
    scene: &Scene,
    estimate: &Estimate,
    support: impl Fn(&dyn Effect) -> Option<Support>,
) -> Result<EffectDecisions, Rejection> {
    let mut decisions = EffectDecisions::default();
    let mut relevances = Vec::new();
    for effect in EFFECTS {
        let own = support(effect);
        let switch = effect.switch(scene.effects());
        if switch == Some(Switch::On) && matches!(own, None | Some(Support::Lacks)) {
            return Err(lacking(scene, effect));
        }
        let Some(own) = own else { continue };
        let relevance = effect.relevance(scene, estimate).unwrap_or_default();
        relevances.push((effect, own, switch, relevance));
    }
    let is_lacking =
        |own: &Support, relevance: &Relevance| relevance.is_needed && *own == Support::Lacks;
    let lacked = relevances.iter().filter(|(_, own, _, relevance)| is_lacking(own, relevance));
    let silenced = lacked.flat_map(|(effect, ..)| effect.silences(scene, estimate));
    decisions.silenced = silenced.copied().collect();
    let mut warnings_of = Vec::new();
    for (effect, own, switch, relevance) in relevances {
        let obeys = own.obeys();
        let (is_needed, note) = (relevance.is_needed, relevance.warning.clone());
        let is_inherent = matches!(own, Support::Inherent { .. });
        let (active, reason, warnings) = own.of(relevance, switch);
        if switch == Some(Switch::Off) && active {
            return Err(inherent(scene, effect, &reason));
        }
        let is_lacking = !active && !is_inherent;
        let is_physics = active && effect.kind() == EffectKind::Physical;
        let is_warned = !warnings.is_empty() && !decisions.silenced.contains(&effect.name());
        let matters = is_physics || is_lacking && is_needed || is_warned;
        let name = effect.name();
        decisions.all.push(EffectDecision { name, active, reason, matters, is_lacking });
        warnings_of.extend(warnings.into_iter().filter(|_| is_warned).map(|text| (name, text)));
        if switch == Some(Switch::On) && obeys && !is_needed {
            let neglect_error = effect.neglect_error(scene, estimate).unwrap_or_default();
            let name = effect.name();
            let warning = format!(
                "{name} is switched on although the scene does not need it, which changes {neglect_error}"
            );
            warnings_of.push((name, warning));
        }
        if switch == Some(Switch::Off) && obeys && is_needed {
            let neglect_error = effect.neglect_error(scene, estimate).unwrap_or_default();
            let mut warning = neglect_error.warning(effect.name());
            if let Some(note) = note {
                warning += &format!(": {note}");
            }
            warnings_of.push((name, warning));
        }
    }
    decisions.warnings = warnings_of.into_iter().map(|(_, text)| text).collect();
    Ok(decisions)
}

/// Returns why the restitution of a scene at a speed (m/s) is a bound where closed forms compute it: its contact law, or Ting's
/// model and, for bodies that flow, the mean-pressure law in place of another model. It is a computed number if the list is
/// empty.
pub fn bounds_of_closed_forms(scene: &Scene, speed: f64) -> Vec<String> {
    let Ok(estimate) = Estimate::at(scene, speed) else { return Vec::new() };
    if AdhesionEffect::surely_sticks(scene, speed) {
        return Vec::new();
    }
    let is_law = matches!(scene.model(), ModelChoice::Law { .. });
    let flows = PlasticFlow::is_on(scene, &estimate)
        && PlasticFlow::of_elements(scene, &estimate) != Support::Lacks;
    // Waves from the edge of a plate give energy back that closed forms leave out.
    let returns = PlateImpact::of(scene, &estimate).is_some_and(|plate| plate.edge_return <= 1.0);
    let is_missing = |effect: &&&dyn Effect| match effect.name() {
        AdhesionEffect::NAME => {
            AdhesionEffect::is_lacking(scene, speed) && AdhesionEffect::given(scene).is_none()
        }
        // All other losses of a contact law are the user's.
        _ if is_law => false,
        PlasticFlow::NAME => !flows,
        PlateBending::NAME => returns,
        _ => effect.is_dissipative(),
    };
    let warning = |effect: &&dyn Effect| {
        let relevance = effect.relevance(scene, &estimate).filter(|it| it.is_needed)?;
        effect.forced(scene, &estimate).or(relevance.warning)
    };
    EFFECTS.iter().filter(is_missing).filter_map(warning).collect()
}

/// Returns the impact of a scene at a speed (m/s) by the mean-pressure law where explicit elements compute the flow of a body; `None` if
/// no body with a flow rule yields, or the case forbids flow.
pub fn computed_flow(scene: &Scene, speed: f64) -> Option<FlowingImpact> {
    let estimate = Estimate::at(scene, speed).ok()?;
    PlasticFlow::is_on(scene, &estimate)
        .then(|| mean_pressure_impact(scene, &estimate.hertz))
        .flatten()
}

/// Returns the materials of half-spaces that radiate waves in a collision at a speed, m/s, in a model that has these waves.
pub fn radiating_half_spaces(scene: &Scene, speed: f64) -> Vec<Material> {
    let Ok(estimate) = Estimate::at(scene, speed) else { return Vec::new() };
    let radiating = PartnerWaves::radiating(scene, &estimate).into_iter().zip(scene.bodies());
    let of_half_space =
        radiating.filter(|(_, body)| matches!(body.shape(), Shape::HalfSpace { .. }));
    of_half_space.filter_map(|(material, _)| material).collect()
}

/// Returns the restitution at a speed (m/s) beside adhesion, if the case gives it, from that without; 0 if the bodies stick.
pub fn restitution_with_adhesion(scene: &Scene, speed: f64, without: f64) -> f64 {
    AdhesionEffect::given(scene).map_or(without, |it| it.restitution(speed, without))
}

/// An effect that is forced on must be one that the model computes.
fn lacking(scene: &Scene, effect: &dyn Effect) -> Rejection {
    let key = key_of(effect);
    let model = scene.model().name();
    let message = format!("effect `{key}` is not available in model {model}");
    Rejection::new(format!("effects.{key}"), message).with_help(match scene.model() {
        ModelChoice::Fem => "write \"auto\" or \"off\", or leave it out",
        _ => "write \"auto\" or \"off\", leave it out, or compute the case with model.fem",
    })
}

/// An effect that is forced off must be one that the model can leave out.
fn inherent(scene: &Scene, effect: &dyn Effect, reason: &str) -> Rejection {
    let key = key_of(effect);
    let model = scene.model().name();
    if effect.name() == SurfaceSlip::NAME && *scene.model() == ModelChoice::Fem {
        // Explicit elements have it inherent nowhere else.
        let message = format!(
            "finite strain is on, whose contact is between the surfaces where they have moved to: they slip, \
             and effect `{key}` cannot be left out ({reason})"
        );
        let help = "write \"auto\" or \"on\", leave it out, or write effects.finite_strain = \"off\" beside it";
        return Rejection::new(format!("effects.{key}"), message).with_help(help);
    }
    let message = format!("model {model} cannot leave out effect `{key}` ({reason})");
    Rejection::new(format!("effects.{key}"), message)
        .with_help("write \"auto\" or \"on\", or leave it out")
}

/// The key of an effect in `[effects]`.
fn key_of(effect: &dyn Effect) -> String {
    effect.name().replace(' ', "_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_have_names_of_their_own() {
        for (k, effect) in EFFECTS.iter().enumerate() {
            assert!(EFFECTS[..k].iter().all(|other| other.name() != effect.name()));
        }
    }
}
