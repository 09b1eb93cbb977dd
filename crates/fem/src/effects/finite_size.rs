//! A sphere is stiffer than the half-space of Hertz: its own compliance, in series, to first order.

use fem_case::Scene;

use super::effect::Effect;
use super::left_out::LeftOut;
use super::transformed::Computed;
use crate::estimate::Estimate;
use crate::expected::Expected;

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

    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        let scene = Computed::quiet(scene)?;
        let speed = estimate.hertz.approach_speed();
        let [with, without] = [true, false].map(|size| Expected::of(&scene, speed, size).ok());
        Some(LeftOut::difference(&with?, &without?))
    }
}
