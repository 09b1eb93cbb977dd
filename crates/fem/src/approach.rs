//! How the bodies of a scene meet.

use fem_case::{Body, Scene};
use fem_collision::{Approach, Frame};

use crate::refusal::Refusal;

/// How the bodies of a scene meet.
///
/// # Errors
/// Bodies that do not meet.
pub fn approach_of(scene: &Scene) -> Result<Approach, Refusal> {
    let velocities = scene.bodies().each_ref().map(|body| body.velocity());
    Approach::new(velocities, scene.gap().unwrap_or_default())
        .map_err(|error| Refusal::new("body", error.to_string()))
}

/// The frame of the mass centre of solid spheres that meet like this; `reduced_mass` (kg) is that of
/// the motion.
pub(crate) fn frame_of(scene: &Scene, approach: &Approach, reduced_mass: f64) -> Frame {
    Frame { approach: *approach, masses: scene.bodies().each_ref().map(Body::mass), reduced_mass }
}
