//! Identical bodies are mirror images of each other, so one of them against a rigid plane at rest gives the whole
//! collision.
//!
//! In the frame of the mass centre each body has the speed v/2, and no surface passes the plane between them. With '
//! for the half scene and the velocity V of the mass centre
//!
//! ```math
//! T = T', \quad F = F', \quad p = p', \quad \delta = 2\delta', \quad E = 2E' + \tfrac12 (2m) V^2,
//! ```
//!
//! The pair's contact modulus is half of that of a body on a rigid plane, so penalty springs are twice as stiff over
//! half of the overlap.

use fem_case::{Scene, Switch};

use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::support::Support;
use crate::effects::decision::{Effect, MirrorSymmetry};
use crate::estimate::Estimate;
use crate::rejection::Rejection;

impl MirrorSymmetry {
    /// Returns the lower half of a scene with identical bodies, a body against a rigid plane; `None` if the bodies
    /// differ or the case switches the symmetry off.
    pub(crate) fn half_of(scene: &Scene) -> Result<Option<Scene>, Rejection> {
        let switch = scene.effects().mirror_symmetry;
        match scene.half() {
            Some(half) => Ok((switch != Some(Switch::Off)).then_some(half)),
            None if switch == Some(Switch::On) => {
                let message = "mirror_symmetry is \"on\", and the bodies differ";
                Err(Rejection::new("effects.mirror_symmetry", message).with_help(
                    "it needs two spheres of one diameter, one material and the built-in mesh; \
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
        Support::decided(true, reason)
    }
}

impl Effect for MirrorSymmetry {
    /// It saves work: a scene may allow the effect, but none calls for it.
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let number = match scene.has_identical_bodies() {
            true => "the bodies are identical; both are computed",
            false => "the bodies differ",
        };
        Some(Relevance { number: number.to_string(), ..Relevance::default() })
    }

    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        Some(NeglectError::NOTHING)
    }
}
