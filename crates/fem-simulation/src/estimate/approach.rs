//! How the bodies of a scene meet.

use fem_case::{Body, Scene};
use fem_collision::{Approach, Frame};

use crate::rejection::Rejection;

/// How the bodies of a scene meet; of a ball that falls, how it does when it first touches.
///
/// # Errors
/// Bodies that do not meet.
pub fn approach_of(scene: &Scene) -> Result<Approach, Rejection> {
    let velocities = scene.bodies().each_ref().map(|body| body.velocity());
    let approach = match scene.gravity() {
        None => Approach::new(velocities, scene.gap().unwrap_or_default()),
        Some(_) => Approach::new([0.0, -scene.approach_speed()], 0.0),
    };
    approach.map_err(|error| Rejection::new("body", error.to_string()))
}

/// The frame of the mass centre of solid spheres that meet like this; `reduced_mass` (kg) is that of
/// the motion.
pub(crate) fn frame_of(scene: &Scene, approach: &Approach, reduced_mass: f64) -> Frame {
    let mass = |body: &Body| body.mass().filter(|_| !body.is_held());
    let masses = scene.bodies().each_ref().map(mass);
    let gravity = scene.gravity().map_or(0.0, |gravity| gravity.acceleration);
    Frame { approach: *approach, masses, reduced_mass, gravity }
}
