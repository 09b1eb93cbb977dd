//! The trait of an effect, and what it tells: relevance to a scene, support by a model, the error of
//! neglecting it.

pub(super) mod computed_scene;
pub(super) mod model_form_error;
pub(super) mod neglect_error;
pub(super) mod relevance;
pub(super) mod support;

use fem_case::{EffectsTable, Scene, Switch};
use fem_collision::Collision;

use self::computed_scene::Transformed;
use self::model_form_error::{Doubt, Standing};
use self::neglect_error::LeftOut;
use self::relevance::Need;
use self::support::Answer;
use crate::estimate::Estimate;
use crate::refusal::Refusal;

/// Something that a collision may show, or that a computation may need.
pub trait Effect: Sync {
    /// What it is called in results.
    fn name(&self) -> &'static str;

    /// What the case says of it, if it is one that `[effects]` switches.
    fn switch(&self, _: &EffectsTable) -> Option<Switch> {
        None
    }

    /// Whether a scene calls for it. `None` of one that only the built model can tell.
    fn need(&self, _: &Scene, _: &Estimate) -> Option<Need> {
        None
    }

    /// The scene as it has it computed; `None` where it leaves it as it is. The estimate is of the scene
    /// as it is given.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow.
    fn transform(&self, _: &Scene, _: &Estimate) -> Result<Option<Transformed>, Refusal> {
        Ok(None)
    }

    /// What the user should know of a scene that the case's switch has transformed otherwise than the plan
    /// would.
    fn forced(&self, _: &Scene, _: &Estimate) -> Option<String> {
        None
    }

    /// By how much the numbers of a collision change without it, whether or not it is called for;
    /// `None` where closed forms do not tell.
    fn left_out(&self, _: &Scene, _: &Estimate) -> Option<LeftOut> {
        None
    }

    /// By how much nature may differ from a result because of it, as a model stands to it: where the model
    /// lacks it, because it is left out; nothing of what only the computation needs.
    fn doubt(&self, scene: &Scene, estimate: &Estimate, standing: &Standing) -> Doubt {
        if !standing.is_lacking {
            return Doubt::NOTHING;
        }
        let is_called_for = || self.need(scene, estimate).is_some_and(|need| need.is_called_for);
        match &standing.left_out {
            Some(left_out) => Doubt::of(left_out, estimate),
            None if is_called_for() => Doubt::default(),
            None => Doubt::NOTHING,
        }
    }

    /// What a collision tells of it better than what was decided before: of an effect that depends on
    /// the bodies as they were computed in the end.
    fn found(&self, _: &Scene, _: &Collision) -> Option<Answer> {
        None
    }

    /// What a collision shows of it that the user should know, and that nothing foretold.
    fn after(&self, _: &Scene, _: &Estimate, _: &Collision) -> Vec<String> {
        Vec::new()
    }
}
