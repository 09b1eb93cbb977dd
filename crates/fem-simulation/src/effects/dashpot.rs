//! The dashpot of a contact law.

use super::effect::Effect;

/// The dashpot of a contact law.
#[derive(Clone, Copy, Debug)]
pub struct DashpotEffect;

impl DashpotEffect {
    /// Its name in results.
    pub const NAME: &'static str = "dashpot";
}

impl Effect for DashpotEffect {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}
