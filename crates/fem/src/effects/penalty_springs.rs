//! Springs at Gauss points that resist overlap, instead of a contact that allows none.

use super::effect::Effect;

/// Springs that resist overlap.
#[derive(Clone, Copy, Debug)]
pub struct PenaltySprings;

impl Effect for PenaltySprings {
    fn name(&self) -> &'static str {
        "penalty springs"
    }
}
