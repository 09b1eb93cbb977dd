//! Relaxation of the materials: a part of the step of models that have fields, and of Ting's.
//!
//! Decided by the share of the modulus that is lost over one contact time, Σ g (1 − exp(−T/τ)).

use fem_case::Scene;

use super::effect::Effect;
use super::need::{Need, percent};
use crate::estimate::Estimate;

/// Relaxation of the materials.
#[derive(Clone, Copy, Debug)]
pub struct Viscoelasticity;

impl Viscoelasticity {
    /// Its name in results.
    pub const NAME: &'static str = "viscoelasticity";
}

impl Effect for Viscoelasticity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let bodies = scene.bodies().iter();
        let relaxing: Vec<&str> = bodies
            .filter(|body| body.material().is_some_and(|m| m.relaxation().is_some()))
            .map(|body| body.name())
            .collect();
        if relaxing.is_empty() {
            return Some(Need { number: "no material relaxes".to_string(), ..Need::default() });
        }
        let number = format!(
            "{} relax{}: {} of the modulus is lost over one contact time",
            relaxing.join(" and "),
            if relaxing.len() == 1 { "es" } else { "" },
            percent(estimate.relaxed),
        );
        Some(Need { is_called_for: true, number, ..Need::default() })
    }
}
