//! Identical bodies that meet are each other's mirror image: one of them, against a rigid plane at
//! rest, is the whole collision. A transformation of the scene.
//!
//! In the frame of the mass centre the bodies come with v/2 each, the plane between them does not
//! move, and neither surface passes it. With ' for the half scene
//!
//! ```math
//! T = T', \quad F = F', \quad p = p', \quad \delta = 2\delta', \quad E = 2E' + \tfrac12 (2m) V^2,
//! ```
//!
//! V the velocity of the mass centre. The pair's contact modulus is half of that of a body on a rigid
//! plane, so penalty springs are twice as stiff over half of the overlap.

use fem_case::{Scene, Switch};

use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::relevance::Relevance;
use crate::effects::effect::support::Support;
use crate::effects::effect::{Effect, MirrorSymmetry};
use crate::estimate::Estimate;
use crate::rejection::Rejection;

impl MirrorSymmetry {
    /// Half of a scene whose bodies are identical: the lower one, against a rigid plane. `None` of a
    /// scene that has none, or that is to be computed whole.
    ///
    /// # Errors
    /// Bodies that differ, where the case forces the symmetry.
    pub(crate) fn half_of(scene: &Scene) -> Result<Option<Scene>, Rejection> {
        let switch = scene.effects().mirror_symmetry;
        match scene.half() {
            Some(half) => Ok((switch != Some(Switch::Off)).then_some(half)),
            None if switch == Some(Switch::On) => {
                let message = "mirror_symmetry is \"on\", and the bodies differ";
                Err(Rejection::new("effects.mirror_symmetry", message).with_help(
                    "it wants two spheres of one diameter, one material and the built-in mesh; \
                     write \"auto\" or \"off\"",
                ))
            }
            None => Ok(None),
        }
    }

    /// Returns the support of a method with elements, which rejects a switch that the bodies do not allow when it
    /// builds the model.
    pub(crate) fn support_by_elements(scene: &Scene) -> Support {
        match Self::half_of(scene) {
            Ok(None) => Support::Lacks,
            Ok(Some(_)) | Err(_) => Self::of_half(),
        }
    }

    /// Returns the support of a model that computes half of a scene.
    pub(crate) fn of_half() -> Support {
        let reason = "the bodies are identical: one is computed, against a rigid plane at rest \
                      between them";
        Support::is(true, reason)
    }
}

impl Effect for MirrorSymmetry {
    /// It saves work and changes nothing: a scene may allow it, none calls for it.
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let number = match scene.has_identical_bodies() {
            true => "the bodies are identical; both are computed all the same",
            false => "the bodies differ",
        };
        Some(Relevance { number: number.to_string(), ..Relevance::default() })
    }

    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        Some(NeglectError::NOTHING)
    }
}
