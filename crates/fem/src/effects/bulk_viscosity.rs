//! Artificial viscosity that spreads shocks over some elements.
//!
//! Decided by the approach speed over the shear wave speed.

use fem_case::{EffectsTable, Scene, Switch};

use super::effect::Effect;
use super::need::Need;
use super::speed::{MACH_LIMIT, above, number};
use crate::estimate::Estimate;

/// Artificial viscosity against shocks.
#[derive(Clone, Copy, Debug)]
pub struct BulkViscosity;

impl BulkViscosity {
    /// Its name in results.
    pub const NAME: &'static str = "bulk viscosity";
}

impl Effect for BulkViscosity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.bulk_viscosity
    }

    fn need(&self, _: &Scene, estimate: &Estimate) -> Option<Need> {
        let mach = estimate.mach;
        let is_called_for = mach > MACH_LIMIT;
        let warning = is_called_for.then(|| {
            let doubt = above(estimate, MACH_LIMIT);
            format!("{doubt} shocks form that this version does not spread")
        });
        Some(Need {
            is_called_for,
            number: number(estimate),
            otherwise: "no shocks to spread".to_string(),
            left_open: String::new(),
            warning,
        })
    }
}
