//! Inertia of the bodies' own deformation: elements have it, a quasi-static model has it as modes of
//! free vibration, or lacks it.
//!
//! Decided by the approach speed over the shear wave speed.

use super::bulk_viscosity::MACH_LIMIT;
use super::effect::{Effect, percent};
use crate::estimate::Estimate;

/// Approach speed over shear wave speed above which inertia shortens the contact by more than
/// 0.15 %: 0.05 % at 1.5e-3 and 0.45 % at 1.5e-2 were measured on the glass pair.
pub const QUASI_STATIC_LIMIT: f64 = 5e-3;
/// Modes that bring it back.
const ENOUGH_MODES: usize = 12;

/// Inertia of the bodies' own deformation.
#[derive(Clone, Copy, Debug)]
pub struct Vibration;

impl Effect for Vibration {
    fn name(&self) -> &'static str {
        "vibration"
    }
}

impl Vibration {
    /// What a model with so many modes of vibration lacks at a speed: inertia where they are few,
    /// shocks in any case.
    pub(crate) fn warnings_of_modes(estimate: &Estimate, n_modes: usize) -> Vec<String> {
        let mut warnings = Vec::new();
        if estimate.mach > QUASI_STATIC_LIMIT && n_modes < ENOUGH_MODES {
            warnings.push(format!(
                "the approach speed is {} of the shear wave speed; above {} the inertia of the \
                 bodies counts: set model.condensed.vibration_modes = {ENOUGH_MODES}, or use model \
                 fem",
                percent(estimate.mach),
                percent(QUASI_STATIC_LIMIT),
            ));
        }
        if estimate.mach > MACH_LIMIT {
            warnings.push(format!(
                "the approach speed is {} of the shear wave speed; above {} shocks form that no \
                 mode of vibration carries: use model fem, which warns of them as well",
                percent(estimate.mach),
                percent(MACH_LIMIT),
            ));
        }
        warnings
    }

    /// What a model of rigid bodies with one degree of freedom lacks at a speed.
    pub(crate) fn warning_of_rigid_bodies(estimate: &Estimate) -> Option<String> {
        (estimate.mach > MACH_LIMIT).then(|| {
            format!(
                "the approach speed is {} of the shear wave speed; above {} the bodies vibrate, \
                 which this model leaves out",
                percent(estimate.mach),
                percent(MACH_LIMIT),
            )
        })
    }
}
