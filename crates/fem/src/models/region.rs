//! A contact that outgrows the region in which it is looked for: the collision again with a larger
//! one.

use fem_collision::{Collision, Ending, Stop};

/// Computes collisions until the region suffices. `enlarge` is told how far the contact reached, m;
/// with its refusal the run keeps what it had, and ends there.
pub(super) fn until_it_fits<M>(
    model: &mut M,
    mut collide: impl FnMut(&M) -> Collision,
    mut enlarge: impl FnMut(&mut M, f64) -> Result<(), Option<Stop>>,
) -> Collision {
    loop {
        let mut collision = collide(model);
        let Some(radius) = collision.outgrown_radius() else { return collision };
        match enlarge(model, radius) {
            Ok(()) => {}
            Err(stop) => {
                if let Some(stop) = stop {
                    collision.ending = Ending::Stopped(stop);
                }
                return collision;
            }
        }
    }
}
