//! A sphere is stiffer than the half-space of Hertz: its own compliance, in series, to first order.

use super::effect::Effect;

/// The spheres' own compliance.
#[derive(Clone, Copy, Debug)]
pub struct FiniteSizeEffect;

impl FiniteSizeEffect {
    /// Its name in results.
    pub const NAME: &'static str = "finite size";
}

impl Effect for FiniteSizeEffect {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}
