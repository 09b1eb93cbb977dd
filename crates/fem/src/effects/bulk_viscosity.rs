//! Artificial viscosity that spreads shocks over some elements.
//!
//! Decided by the approach speed over the shear wave speed.

use fem_case::{EffectsTable, Scene, Switch};

use super::effect::{Effect, Need, percent};
use crate::estimate::Estimate;

/// Above this share of the shear wave speed an impact sends shocks.
pub const MACH_LIMIT: f64 = 0.02;

/// Artificial viscosity against shocks.
#[derive(Clone, Copy, Debug)]
pub struct BulkViscosity;

impl Effect for BulkViscosity {
    fn name(&self) -> &'static str {
        "bulk viscosity"
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.bulk_viscosity
    }

    fn need(&self, _: &Scene, estimate: &Estimate) -> Option<Need> {
        let mach = estimate.mach;
        let is_called_for = mach > MACH_LIMIT;
        let warning = is_called_for.then(|| {
            format!(
                "the approach speed is {} of the shear wave speed; above {} shocks form that this \
                 version does not spread",
                percent(mach),
                percent(MACH_LIMIT),
            )
        });
        Some(Need {
            is_called_for,
            number: format!("approach speed / shear wave speed = {mach:.1e}"),
            otherwise: "no shocks to spread".to_string(),
            left_open: String::new(),
            warning,
        })
    }
}
