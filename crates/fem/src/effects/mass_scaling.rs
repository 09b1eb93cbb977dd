//! Mass added to the lightest nodes for a longer time step: a decision of the plan.

use fem_case::Scene;
use fem_collision::Collision;

use super::effect::Effect;
use crate::estimate::Estimate;

/// Added mass over a body's mass.
const LARGEST_ADDED_MASS: f64 = 1e-3;

/// Mass added for a longer time step.
#[derive(Clone, Copy, Debug)]
pub struct MassScaling;

impl MassScaling {
    /// Its name in results.
    pub const NAME: &'static str = "mass scaling";
}

impl Effect for MassScaling {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn after(&self, scene: &Scene, _: &Estimate, collision: &Collision) -> Vec<String> {
        let bodies = collision.bodies.iter().zip(scene.bodies());
        let warnings = bodies.filter_map(|(body, named)| {
            let share = body.added_mass? / body.mass?;
            (share > LARGEST_ADDED_MASS).then(|| {
                format!(
                    "mass scaling adds {:.2} % to the mass of {}; above {} %, use a smaller \
                     time.mass_scaling",
                    100.0 * share,
                    named.name(),
                    100.0 * LARGEST_ADDED_MASS
                )
            })
        });
        warnings.collect()
    }
}
