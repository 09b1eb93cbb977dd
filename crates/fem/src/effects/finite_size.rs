//! A sphere is stiffer than the half-space of Hertz: its own compliance, in series, to first order.

use super::effect::Effect;

/// The spheres' own compliance.
#[derive(Clone, Copy, Debug)]
pub struct FiniteSizeEffect;

impl Effect for FiniteSizeEffect {
    fn name(&self) -> &'static str {
        "finite size"
    }
}
