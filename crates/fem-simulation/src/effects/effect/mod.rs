//! The trait of an effect: its relevance to a scene, a model's support for it, and the error of neglecting
//! it.

pub(super) mod computed_scene;
pub(super) mod model_form_error;
pub(super) mod neglect_error;
pub(super) mod relevance;
pub(super) mod support;

use fem_case::{EffectsTable, Scene, Switch};
use fem_collision::Collision;

use self::computed_scene::TransformedScene;
use self::model_form_error::{EffectStatus, ModelFormError};
use self::neglect_error::NeglectError;
use self::relevance::Relevance;
use self::support::Support;
use crate::estimate::Estimate;
use crate::rejection::Rejection;

/// A physical or numerical effect that a collision may show or a computation may need.
pub trait Effect: Sync {
    /// Returns the effect's name in results.
    fn name(&self) -> &'static str;

    /// Returns the case's switch for it, if `[effects]` has one.
    fn switch(&self, _: &EffectsTable) -> Option<Switch> {
        None
    }

    /// Returns whether the scene calls for the effect, or `None` if only the built model can decide.
    fn relevance(&self, _: &Scene, _: &Estimate) -> Option<Relevance> {
        None
    }

    /// Returns the scene with the effect applied, or `None` if the effect leaves the scene unchanged. The
    /// estimate belongs to the given scene.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow.
    fn transform(&self, _: &Scene, _: &Estimate) -> Result<Option<TransformedScene>, Rejection> {
        Ok(None)
    }

    /// Returns a warning if the case's switch transforms the scene differently from the plan's own choice.
    fn forced(&self, _: &Scene, _: &Estimate) -> Option<String> {
        None
    }

    /// Returns the change of restitution, contact time and peak force without the effect, whether or not it
    /// is called for; `None` if closed forms cannot estimate it.
    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        None
    }

    /// Returns the model-form error because of the effect. It is the error of neglecting the effect if the
    /// model lacks it, and zero for purely numerical effects.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        standing: &EffectStatus,
    ) -> ModelFormError {
        if !standing.is_lacking {
            return ModelFormError::NOTHING;
        }
        let is_called_for =
            || self.relevance(scene, estimate).is_some_and(|relevance| relevance.is_called_for);
        match &standing.neglect_error {
            Some(neglect_error) => ModelFormError::of(neglect_error, estimate),
            None if is_called_for() => ModelFormError::default(),
            None => ModelFormError::NOTHING,
        }
    }

    /// Returns an answer taken from the finished collision, for an effect that depends on the bodies as
    /// computed.
    fn found(&self, _: &Scene, _: &Collision) -> Option<Support> {
        None
    }

    /// Returns warnings that follow from the finished collision and could not be given before.
    fn after(&self, _: &Scene, _: &Estimate, _: &Collision) -> Vec<String> {
        Vec::new()
    }
}
