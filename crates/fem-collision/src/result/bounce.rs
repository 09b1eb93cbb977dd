//! Further contacts and rest of a ball that gravity brings back.

use serde::{Deserialize, Serialize};

/// One contact of a ball that bounces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounce {
    /// First touch since the start of the case, s.
    pub time: f64,
    /// Relative speed at first touch, m/s.
    pub speed_before: f64,
    /// Relative velocity after the contact over that before; 0 if the ball does not leave any more.
    pub restitution: f64,
    /// Time from first to last contact force, s; `None` if the ball does not leave any more.
    pub contact_time: Option<f64>,
    /// Largest contact force, N.
    pub peak_force: Option<f64>,
}

/// The static contact of a ball at rest, after all relaxation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestState {
    /// Time since the start of the case from which the ball does not leave any more, s.
    pub time: f64,
    /// The static contact under its weight.
    pub contact: StaticContact,
}

/// A contact under a constant force, with equilibrium moduli.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticContact {
    /// N.
    pub force: f64,
    /// Approach of the mass centres since first touch, m.
    pub approach: f64,
    /// Contact radius, where the pressure falls to zero, m; `None` if the model has none.
    pub contact_radius: Option<f64>,
    /// Contact pressure on the axis, Pa; `None` if the model has none.
    pub centre_pressure: Option<f64>,
}
