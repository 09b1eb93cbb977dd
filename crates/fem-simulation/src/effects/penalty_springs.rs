//! Springs at Gauss points that resist overlap, instead of a contact that allows none.

use super::effect::Effect;

/// Springs that resist overlap.
#[derive(Clone, Copy, Debug)]
pub struct PenaltySprings;

impl PenaltySprings {
    /// Its name in results.
    pub const NAME: &'static str = "penalty springs";
}

impl Effect for PenaltySprings {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}
