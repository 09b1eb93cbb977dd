//! Mass added to the lightest nodes for a longer time step: a decision of the plan.

use super::effect::Effect;

/// Mass added for a longer time step.
#[derive(Clone, Copy, Debug)]
pub struct MassScaling;

impl Effect for MassScaling {
    fn name(&self) -> &'static str {
        "mass scaling"
    }
}
