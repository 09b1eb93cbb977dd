//! What follows the first contact of a ball that gravity brings back: further contacts, and rest.

use serde::{Deserialize, Serialize};

/// One contact of a ball that bounces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounce {
    /// First touch since the start of the case, s.
    pub time: f64,
    /// Relative speed at first touch, m/s.
    pub speed_before: f64,
    /// Relative velocity when the contact ends over that before; 0 of a ball that does not leave any
    /// more.
    pub restitution: f64,
    /// First to last instant with a contact force, s; none of a ball that does not leave any more.
    pub contact_time: Option<f64>,
    /// Largest contact force, N.
    pub peak_force: Option<f64>,
}

/// A ball at rest: what bears its weight once nothing moves and all has relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestState {
    /// When it was seen not to leave any more, since the start of the case, s.
    pub time: f64,
    /// What is then borne for ever.
    pub contact: StaticContact,
}

/// A contact under a constant force, with equilibrium moduli.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticContact {
    /// N.
    pub force: f64,
    /// Of the mass centres since first touch, m.
    pub approach: f64,
    /// Where the contact pressure falls to zero, m; `None` of a model without one.
    pub contact_radius: Option<f64>,
    /// Contact pressure on the axis, Pa; `None` of a model without one.
    pub centre_pressure: Option<f64>,
}
