//! What an effect is, and what a scene needs of it.

use fem_case::{EffectsTable, Scene, Switch};
use fem_collision::Collision;

use crate::estimate::Estimate;

/// Something that a collision may show, or that a computation may need.
pub trait Effect: Sync {
    /// What it is called in results.
    fn name(&self) -> &'static str;

    /// What the case says of it, if it is one that `[effects]` switches.
    fn switch(&self, _: &EffectsTable) -> Option<Switch> {
        None
    }

    /// Whether a scene calls for it. `None` of one that only the built model can tell.
    fn need(&self, _: &Scene, _: &Estimate) -> Option<Need> {
        None
    }

    /// What a collision shows of it that the user should know, and that nothing foretold.
    fn after(&self, _: &Scene, _: &Estimate, _: &Collision) -> Vec<String> {
        Vec::new()
    }
}

/// What a scene needs of an effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Need {
    /// Whether the scene calls for it.
    pub is_called_for: bool,
    /// The number that decides, in words.
    pub number: String,
    /// What follows where it is not called for.
    pub otherwise: String,
    /// What stays open in a model that lacks it.
    pub left_open: String,
    /// What a user should know of a model that lacks it.
    pub warning: Option<String>,
}

/// A share in per cent.
pub(crate) fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}
