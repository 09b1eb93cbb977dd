//! All that a collision under way knows beside its model, to be put away and taken up again.

use fem_collision::Approach;
use serde::{Deserialize, Serialize};

use crate::error::Level;
use crate::models::Bounces;

/// The memory of a [`Course`](crate::Course) between two advances. A course that goes on from it ends
/// with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Of the contact under way, by explicit elements.
    pub(crate) contact: fem_explicit::RestartState,
    /// Of a ball that gravity brings back: the contacts before.
    pub(crate) bounces: Option<Box<Bounces>>,
    /// How the bodies met in the contact under way; they are computed in the frame of their mass centre.
    pub(crate) met: Approach,
    /// Elements across a length over those that the plan takes at first.
    pub(crate) refinement: f64,
    /// Coarser meshes with which the collision was computed before.
    pub(crate) levels: Vec<Level>,
}

impl Memory {
    /// Of the contact under way.
    pub fn contact(&self) -> &fem_explicit::RestartState {
        &self.contact
    }

    /// Steps of the contact under way that are done.
    pub fn step(&self) -> u64 {
        self.contact.step()
    }
}
