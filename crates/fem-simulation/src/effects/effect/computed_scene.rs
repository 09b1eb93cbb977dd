//! Effects that act on the scene: the model is made of what they leave of it.

use fem_case::Scene;

use crate::effects::EFFECTS;
use crate::effects::effect::support::Answer;
use crate::estimate::Estimate;
use crate::refusal::Refusal;

/// A scene as an effect has it computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Transformed {
    /// What is computed.
    pub scene: Scene,
    /// What the effect has of it: [`Answer::Is`].
    pub answer: Answer,
}

/// A scene as all effects have it computed, and which of them say what of it.
#[derive(Clone, Debug)]
pub(crate) struct Computed {
    /// What is computed.
    pub scene: Scene,
    /// Names and answers of the effects that changed the scene; none where it is as it was.
    pub answers: Vec<(&'static str, Answer)>,
}

impl Computed {
    /// Of a scene as it is given.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow; a scene whose closed-form estimates are not
    /// finite.
    pub fn of(given: &Scene) -> Result<Self, Refusal> {
        let estimate = Estimate::checked(given)?;
        let mut computed = Self::without_warnings(given, &estimate)?;
        for (name, answer) in &mut computed.answers {
            let effect = EFFECTS.iter().find(|effect| effect.name() == *name);
            let forced = effect.and_then(|effect| effect.forced(given, &estimate));
            *answer = answer.clone().warning(forced);
        }
        Ok(computed)
    }

    /// The scene alone, for closed forms; none where a switch does not allow it.
    pub fn quiet(given: &Scene) -> Option<Scene> {
        let estimate = Estimate::checked(given).ok()?;
        Self::without_warnings(given, &estimate).ok().map(|computed| computed.scene)
    }

    /// As [`Computed::of`], and nobody is warned of what is switched off.
    fn without_warnings(given: &Scene, estimate: &Estimate) -> Result<Self, Refusal> {
        let mut computed = Self { scene: given.clone(), answers: Vec::new() };
        for effect in EFFECTS {
            if let Some(next) = effect.transform(&computed.scene, estimate)? {
                computed.scene = next.scene;
                computed.answers.push((effect.name(), next.answer));
            }
        }
        Ok(computed)
    }
}
