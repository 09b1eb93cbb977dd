//! Quantities of interest of a collision.

use serde::{Deserialize, Serialize};

use crate::result::Collision;

/// A quantity of interest of a collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum QuantityOfInterest {
    /// Coefficient of restitution: relative velocity after over before.
    Restitution,
    /// Time from first to last contact, s.
    ContactTime,
    /// Largest contact force, N.
    PeakForce,
    /// Largest approach of the mass centres, m.
    MaxApproach,
    /// Largest contact radius, m.
    MaxContactRadius,
    /// Largest pressure on the axis, Pa.
    PeakPressure,
}

impl QuantityOfInterest {
    /// All quantities in the order of the summary.
    pub const ALL: [Self; 6] = [
        Self::Restitution,
        Self::ContactTime,
        Self::PeakForce,
        Self::MaxApproach,
        Self::MaxContactRadius,
        Self::PeakPressure,
    ];

    /// Returns the key in a summary.
    pub fn key(self) -> &'static str {
        match self {
            Self::Restitution => "restitution",
            Self::ContactTime => "contact_time_s",
            Self::PeakForce => "peak_force_n",
            Self::MaxApproach => "max_approach_m",
            Self::MaxContactRadius => "max_contact_radius_m",
            Self::PeakPressure => "peak_pressure_pa",
        }
    }

    /// Returns the name for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Restitution => "restitution",
            Self::ContactTime => "contact time",
            Self::PeakForce => "peak force",
            Self::MaxApproach => "largest approach",
            Self::MaxContactRadius => "largest contact radius",
            Self::PeakPressure => "peak pressure",
        }
    }

    /// Returns the SI unit; a ratio has none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Restitution => "",
            Self::ContactTime => "s",
            Self::PeakForce => "N",
            Self::MaxApproach | Self::MaxContactRadius => "m",
            Self::PeakPressure => "Pa",
        }
    }

    /// Returns the value in a collision, SI.
    pub fn of(self, collision: &Collision) -> Option<f64> {
        match self {
            Self::Restitution => collision.restitution,
            Self::ContactTime => collision.contact_time,
            Self::PeakForce => collision.peak_force,
            Self::MaxApproach => collision.max_approach,
            Self::MaxContactRadius => collision.max_contact_radius,
            Self::PeakPressure => collision.peak_pressure,
        }
    }

    /// Returns the reference of an error, SI: errors of the restitution are absolute, all others relative to the limit.
    pub fn scale(self, limit: f64) -> f64 {
        match self {
            Self::Restitution => 1.0,
            _ => limit.abs(),
        }
    }
}

/// The status of a number: whether it is the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The number is the answer, within its error bar.
    Computed,
    /// A known effect is missing that moves the number by an unknown amount.
    Bound,
    /// There is no number.
    Unknown,
}

impl Status {
    /// Returns the status of a number with its model-form error.
    pub fn of(number: Option<f64>, model_error: Option<f64>) -> Self {
        match (number, model_error) {
            (None, _) => Self::Unknown,
            (Some(_), None) => Self::Bound,
            (Some(_), Some(_)) => Self::Computed,
        }
    }

    /// Returns the word of the status in a summary.
    pub fn word(self) -> &'static str {
        match self {
            Self::Computed => "computed",
            Self::Bound => "bound",
            Self::Unknown => "unknown",
        }
    }
}
