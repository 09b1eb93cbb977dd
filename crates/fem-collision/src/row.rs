//! One instant of a collision.

use serde::{Deserialize, Serialize};

use crate::account::{Account, Book};

/// One instant; all quantities belong to the same time. `None`: the model knows it not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Since the start of the case, s.
    pub time: f64,
    /// Contact force, ≥ 0, N.
    pub contact_force: f64,
    /// Where the contact pressure falls to zero, m.
    pub contact_radius: Option<f64>,
    /// Decrease of the distance of the mass centres since first touch, m; the place of a half-space is
    /// that of what is far away.
    pub approach: f64,
    /// Contact pressure on the axis, Pa.
    pub centre_pressure: Option<f64>,
    /// Of the mass centres along +y, m/s.
    pub velocity: [f64; 2],
    /// What is in each account of energy, J.
    pub energies: Book,
    /// What the energies do not account for, J.
    pub residual: Option<f64>,
    /// Kinetic energy of each body relative to its mass centre, or to what is far away, J.
    pub vibration: [f64; 2],
}

impl Row {
    /// What is in an account, J.
    pub fn energy(&self, account: Account) -> Option<f64> {
        self.energies.get(account)
    }
}
