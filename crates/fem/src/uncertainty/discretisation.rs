//! What mesh and step may be off by.

use fem_collision::Collision;

use crate::effects::Doubt;
use crate::simulation::Simulation;

/// Of the quantities of a collision: untold, for no model estimates it.
pub(super) fn of(_: &Simulation, _: &Collision) -> Doubt {
    Doubt::default()
}
