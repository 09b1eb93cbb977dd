//! Weight of the bodies.

use fem_case::Scene;

use super::effect::Effect;
use super::need::Need;
use crate::estimate::Estimate;

/// Weight of the bodies.
#[derive(Clone, Copy, Debug)]
pub struct Gravity;

impl Gravity {
    /// Its name in results.
    pub const NAME: &'static str = "gravity";
}

impl Effect for Gravity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn need(&self, _: &Scene, _: &Estimate) -> Option<Need> {
        Some(Need { number: "the case has none".to_string(), ..Need::default() })
    }
}
