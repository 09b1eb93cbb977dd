//! All that a collision under way knows beside its model, to be put away and taken up again.

use serde::{Deserialize, Serialize};

use crate::models::Bounces;

/// The memory of a [`Course`](crate::Course) between two advances. A course that goes on from it ends
/// with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Of the contact under way, by explicit elements.
    pub(crate) contact: fem_explicit::Memory,
    /// Of a ball that gravity brings back: the contacts before.
    pub(crate) bounces: Option<Box<Bounces>>,
}

impl Memory {
    /// Of the contact under way.
    pub fn contact(&self) -> &fem_explicit::Memory {
        &self.contact
    }

    /// Steps of the contact under way that are done.
    pub fn step(&self) -> u64 {
        self.contact.step()
    }
}

impl From<fem_explicit::Memory> for Memory {
    /// Of a collision that is one contact.
    fn from(contact: fem_explicit::Memory) -> Self {
        Self { contact, bounces: None }
    }
}
