//! Effects that transform the scene before the model is built.

use fem_case::Scene;

use crate::effects::decision::support::Support;
use crate::effects::decision::{EFFECTS, effect_named};
use crate::estimate::{Estimate, Regime};
use crate::rejection::Rejection;

/// A scene transformed by one effect.
#[derive(Clone, Debug, PartialEq)]
pub struct TransformedScene {
    /// The transformed scene.
    pub scene: Scene,
    /// What the transformation means for the effect.
    pub outcome: Transformation,
}

/// The consequence of a transformation of the scene for the model's support of its effect.
#[derive(Clone, Debug, PartialEq)]
pub enum Transformation {
    /// The transformation decides alone, [`Support::Is`]: the scene is without the effect, or has it whatever the model.
    Decides(Support),
    /// The rest of the effect is left to the model, whose support holds; the text follows its reason.
    LeavesToModel(String),
}

impl Transformation {
    /// Returns the support of a model of the transformed scene. `number` is the deciding number of the given scene.
    pub(crate) fn support(&self, of_model: Option<Support>, number: &str) -> Option<Support> {
        let note = match self {
            Self::Decides(support) => return Some(support.clone()),
            Self::LeavesToModel(note) => note,
        };
        Some(match of_model? {
            Support::Lacks => Support::Lacks,
            Support::Computes { .. } | Support::Inherent { .. } => {
                Support::decided(true, format!("{number}; {note}"))
            }
            Support::Is { active, reason, warnings } => {
                Support::decided(active, format!("{reason}; {note}")).warning(warnings)
            }
        })
    }
}

/// A scene transformed by all effects.
#[derive(Clone, Debug)]
pub(crate) struct SimplifiedScene {
    /// The transformed scene.
    pub scene: Scene,
    /// Names and transformations of the effects that changed the scene; empty if none did.
    pub transformations: Vec<(&'static str, Transformation)>,
}

impl SimplifiedScene {
    /// Transforms a given scene.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow.
    pub fn of(given: &Regime) -> Result<Self, Rejection> {
        let mut computed = Self::without_warnings(given)?;
        let Regime { scene, estimate } = given;
        for (name, transformation) in &mut computed.transformations {
            let forced = effect_named(name).and_then(|effect| effect.forced(scene, estimate));
            if let Transformation::Decides(support) = transformation {
                *support = support.clone().warning(forced);
            }
        }
        Ok(computed)
    }

    /// Returns the transformed variant of an estimated scene for closed forms, or `None` if a switch is not possible.
    pub fn quiet(given: Scene, estimate: &Estimate) -> Option<Regime> {
        let given = estimate.regime_of(given).ok()?;
        let computed = Self::without_warnings(&given).ok()?;
        match computed.transformations.is_empty() {
            true => Some(given),
            false => estimate.regime_of(computed.scene).ok(),
        }
    }

    /// Transforms a scene without warnings about forced switches.
    fn without_warnings(given: &Regime) -> Result<Self, Rejection> {
        let mut computed = Self { scene: given.scene.clone(), transformations: Vec::new() };
        for effect in EFFECTS {
            if let Some(next) = effect.transform(&computed.scene, &given.estimate)? {
                computed.scene = next.scene;
                computed.transformations.push((effect.name(), next.outcome));
            }
        }
        Ok(computed)
    }
}
