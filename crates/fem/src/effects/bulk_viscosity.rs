//! Artificial viscosity that spreads steep fronts over some elements: a part of the step.
//!
//! Decided by the approach speed over the shear wave speed. Bodies of effective radius R* overlap out to
//! a = √(R* v t), which at first spreads faster than shear waves run, out to R* v/(2 c_s): a steep front,
//! behind which a mesh rings. At the limit that is about a third of an element, of eight that a contact
//! radius has, and grows against them as v^(3/5). Of an elastic glass pair at default settings ringing
//! raises the peak force by 1.3 % at 6e-3, by 6 % at the limit and by 8 % at 0.05, against a run with
//! viscosity.

use fem_case::{EffectsTable, Scene, Switch};

use super::effect::Effect;
use super::need::Need;
use super::speed::{MACH_LIMIT, above, number};
use crate::estimate::Estimate;

/// Artificial viscosity against steep fronts.
#[derive(Clone, Copy, Debug)]
pub struct BulkViscosity;

impl BulkViscosity {
    /// Its name in results.
    pub const NAME: &'static str = "bulk viscosity";

    /// Whether a model that has it computes it, for bodies that meet at so many times the shear wave
    /// speed.
    pub(crate) fn is_on(scene: &Scene, mach: f64) -> bool {
        match scene.effects().bulk_viscosity {
            Some(Switch::On) => true,
            Some(Switch::Off) => false,
            None | Some(Switch::Auto) => is_called_for(mach),
        }
    }
}

fn is_called_for(mach: f64) -> bool {
    mach > MACH_LIMIT
}

impl Effect for BulkViscosity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.bulk_viscosity
    }

    fn need(&self, _: &Scene, estimate: &Estimate) -> Option<Need> {
        let is_called_for = is_called_for(estimate.mach);
        let warning = is_called_for.then(|| {
            let doubt = above(estimate, MACH_LIMIT);
            format!("{doubt} steep fronts ring in the mesh, in pressure above all")
        });
        Some(Need {
            is_called_for,
            number: number(estimate),
            otherwise: "no steep fronts to spread".to_string(),
            left_open: String::new(),
            warning,
        })
    }
}
