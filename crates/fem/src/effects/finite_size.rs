//! A sphere is stiffer than the half-space of Hertz: its own compliance, in series, to first order.

use fem_case::Scene;

use super::effect::Effect;
use super::left_out::LeftOut;
use crate::estimate::Estimate;
use crate::quasi_static::{Terms, estimated};

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

    /// Of elastic bodies.
    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        let with = estimated(
            scene,
            estimate,
            Terms { size: scene.finite_size().ok(), ..Terms::default() },
        )?;
        Some(LeftOut::between(&with, &estimate.hertz.impact()))
    }
}
