//! How the bodies of a scene meet.

use fem_case::{Body, Scene};
use fem_collision::{Approach, Frame};

/// How the bodies of a scene meet.
pub fn approach_of(scene: &Scene) -> Approach {
    Approach {
        velocities: scene.bodies.each_ref().map(|body| body.velocity),
        gap: scene.gap.unwrap_or_default(),
    }
}

/// A scene with its bodies meeting in another way.
pub fn scene_at(scene: &Scene, approach: &Approach) -> Scene {
    let mut scene = scene.clone();
    for (body, velocity) in scene.bodies.iter_mut().zip(approach.velocities) {
        body.velocity = velocity;
    }
    scene.gap = Some(approach.gap);
    scene
}

/// The frame of the mass centre of solid spheres that meet like this; `reduced_mass` (kg) is that of
/// the motion.
pub(crate) fn frame_of(scene: &Scene, approach: &Approach, reduced_mass: f64) -> Frame {
    Frame { approach: *approach, masses: scene.bodies.each_ref().map(mass_of), reduced_mass }
}

/// The mass of a solid sphere, kg; a wall has none.
fn mass_of(body: &Body) -> Option<f64> {
    Some(fem_laws::sphere_mass(body.diameter()?, body.material()?.density()))
}
