//! The restart state of a collision, to be stored and resumed.

use fem_collision::Approach;
use serde::{Deserialize, Serialize};

use crate::error::RefinementLevel;
use crate::models::Bounces;

/// The restart state of a [`Stepper`](crate::Stepper) between two advances. A stepper that resumes from it
/// ends with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestartState {
    /// State of the present contact, by explicit elements.
    pub(crate) contact: fem_explicit::RestartState,
    /// Results of earlier contacts, for a ball that gravity brings back.
    pub(crate) bounces: Option<Box<Bounces>>,
    /// Approach of the bodies in the present contact, which is computed in the frame of their mass centre.
    pub(crate) met: Approach,
    /// Refinement: elements per length over those of the first plan.
    pub(crate) refinement: f64,
    /// Coarser meshes of earlier computations.
    pub(crate) levels: Vec<RefinementLevel>,
}

impl RestartState {
    /// Returns the state of the present contact.
    pub fn contact(&self) -> &fem_explicit::RestartState {
        &self.contact
    }

    /// Returns the number of steps done in the present contact.
    pub fn step(&self) -> u64 {
        self.contact.step()
    }
}
