//! Effects that transform the scene before the model is built.

use fem_case::Scene;

use crate::effects::decision::support::Support;
use crate::effects::decision::{EFFECTS, effect_named};
use crate::estimate::Estimate;
use crate::rejection::Rejection;

/// A scene transformed by one effect.
#[derive(Clone, Debug, PartialEq)]
pub struct TransformedScene {
    /// The transformed scene.
    pub scene: Scene,
    /// The effect's support, [`Support::Is`].
    pub support: Support,
}

/// A scene transformed by all effects, with their supports.
#[derive(Clone, Debug)]
pub(crate) struct SimplifiedScene {
    /// The transformed scene.
    pub scene: Scene,
    /// Names and supports of the effects that changed the scene; empty if none did.
    pub supports: Vec<(&'static str, Support)>,
}

impl SimplifiedScene {
    /// Transforms a given scene.
    ///
    /// # Errors
    /// A switch that the scene's bodies do not allow; a scene whose closed-form estimates are not
    /// finite.
    pub fn of(given: &Scene) -> Result<Self, Rejection> {
        let estimate = Estimate::checked(given)?;
        let mut computed = Self::without_warnings(given, &estimate)?;
        for (name, support) in &mut computed.supports {
            let forced = effect_named(name).and_then(|effect| effect.forced(given, &estimate));
            *support = support.clone().warning(forced);
        }
        Ok(computed)
    }

    /// Returns the transformed scene for closed forms, or `None` if a switch is not possible.
    pub fn quiet(given: &Scene) -> Option<Scene> {
        let estimate = Estimate::checked(given).ok()?;
        Self::without_warnings(given, &estimate).ok().map(|computed| computed.scene)
    }

    /// Transforms a scene without warnings about forced switches.
    fn without_warnings(given: &Scene, estimate: &Estimate) -> Result<Self, Rejection> {
        let mut computed = Self { scene: given.clone(), supports: Vec::new() };
        for effect in EFFECTS {
            if let Some(next) = effect.transform(&computed.scene, estimate)? {
                computed.scene = next.scene;
                computed.supports.push((effect.name(), next.support));
            }
        }
        Ok(computed)
    }
}
