//! Effects of the numerical method, and those that a model either has or lacks without a decision.

mod bulk_viscosity;
mod contact_search;
mod mass_scaling;
mod mirror_symmetry;

use fem_case::{EffectsTable, Switch};

use super::effect::Effect;

pub use bulk_viscosity::BulkViscosity;
pub use contact_search::ContactSearch;
pub use mass_scaling::MassScaling;
pub use mirror_symmetry::MirrorSymmetry;

/// The dashpot of a contact law.
#[derive(Clone, Copy, Debug)]
pub struct DashpotEffect;

/// Hourglass control: the stiffness that elements with one integration point need against deformation
/// modes without mean strain.
#[derive(Clone, Copy, Debug)]
pub struct HourglassControl;

/// Penalty springs at integration points, which resist penetration, in place of a contact that allows none.
#[derive(Clone, Copy, Debug)]
pub struct PenaltySprings;

impl DashpotEffect {
    /// The effect's name in results.
    pub const NAME: &'static str = "dashpot";
}

impl HourglassControl {
    /// The effect's name in results.
    pub const NAME: &'static str = "hourglass control";
}

impl PenaltySprings {
    /// The effect's name in results.
    pub const NAME: &'static str = "penalty springs";
}

impl Effect for DashpotEffect {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}

impl Effect for HourglassControl {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.hourglass_control
    }
}

impl Effect for PenaltySprings {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}
