//! The numbers that a collision is known by.

use crate::result::Collision;

/// A number that a collision is known by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum QuantityOfInterest {
    /// Relative velocity after over before.
    Restitution,
    /// First to last contact, s.
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
    /// All, in the order of the summary.
    pub const ALL: [Self; 6] = [
        Self::Restitution,
        Self::ContactTime,
        Self::PeakForce,
        Self::MaxApproach,
        Self::MaxContactRadius,
        Self::PeakPressure,
    ];

    /// Its key in a summary.
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

    /// Its name in words.
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

    /// The unit of its SI value; none of a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Restitution => "",
            Self::ContactTime => "s",
            Self::PeakForce => "N",
            Self::MaxApproach | Self::MaxContactRadius => "m",
            Self::PeakPressure => "Pa",
        }
    }

    /// Its value in a collision, SI.
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

    /// What an error of it is told over, SI: an error of the restitution is absolute, all others are
    /// relative.
    pub fn scale(self, limit: f64) -> f64 {
        match self {
            Self::Restitution => 1.0,
            _ => limit.abs(),
        }
    }
}
