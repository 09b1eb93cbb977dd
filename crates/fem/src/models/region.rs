//! A contact that outgrows the region in which it is looked for: the collision again with a larger
//! one.

use fem_collision::{Collision, Ending, Stop};

/// Computes collisions until the region suffices. `larger` makes what has a larger one; with its
/// refusal the run keeps what it had, and ends there.
pub(super) fn until_it_fits<M>(
    mut model: M,
    mut collide: impl FnMut(&M) -> Collision,
    mut larger: impl FnMut(&M) -> Result<M, Option<Stop>>,
) -> Collision {
    loop {
        let mut collision = collide(&model);
        if collision.outgrown_radius().is_none() {
            return collision;
        }
        match larger(&model) {
            Ok(larger) => model = larger,
            Err(stop) => {
                if let Some(stop) = stop {
                    collision.ending = Ending::Stopped(stop);
                }
                return collision;
            }
        }
    }
}
