//! Identical bodies that meet are each other's mirror image: half of the scene, against a rigid
//! plane, would be the whole. A transformation of the scene.

use fem_case::{EffectsTable, Scene, Switch};

use super::effect::Effect;
use super::need::Need;
use crate::estimate::Estimate;

/// Two identical bodies as one against a rigid plane.
#[derive(Clone, Copy, Debug)]
pub struct MirrorSymmetry;

impl MirrorSymmetry {
    /// Its name in results.
    pub const NAME: &'static str = "mirror symmetry";
}

impl Effect for MirrorSymmetry {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.mirror_symmetry
    }

    /// It saves work and changes nothing: a scene may allow it, none calls for it.
    fn need(&self, scene: &Scene, _: &Estimate) -> Option<Need> {
        let [first, second] = &scene.bodies();
        let are_identical = match (first.diameter(), second.diameter()) {
            (Some(a), Some(b)) => a == b && first.material() == second.material(),
            _ => false,
        };
        let number = match are_identical {
            true => "the bodies are identical; both are computed all the same",
            false => "the bodies differ",
        };
        Some(Need { number: number.to_string(), ..Need::default() })
    }
}
