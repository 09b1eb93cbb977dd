//! Elements with one mean stress need a stiffness of their own against the modes that this does not see.

use fem_case::{EffectsTable, Switch};

use super::effect::Effect;

/// Stiffness of the modes that a mean stress does not see.
#[derive(Clone, Copy, Debug)]
pub struct HourglassControl;

impl HourglassControl {
    /// Its name in results.
    pub const NAME: &'static str = "hourglass control";
}

impl Effect for HourglassControl {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.hourglass_control
    }
}
