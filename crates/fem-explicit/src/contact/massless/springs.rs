//! The springs between the nodes without mass.

use fem_contact::{ContactForces, ContactInterface, Displacement, Profile, SlippingInterface};

/// Springs along y, whose gap is a linear function of the displacements, or those of surfaces that slip and
/// turn, whose gap is one of second order.
#[derive(Debug)]
pub(super) enum Springs {
    Straight(ContactInterface),
    Slipping(SlippingInterface),
}

impl Springs {
    pub fn interface(&self) -> &ContactInterface {
        match self {
            Self::Straight(interface) => interface,
            Self::Slipping(slipping) => slipping.interface(),
        }
    }

    /// The springs if they turn as they slip.
    pub fn slipping(&self) -> Option<&SlippingInterface> {
        match self {
            Self::Straight(_) => None,
            Self::Slipping(slipping) => Some(slipping),
        }
    }

    pub fn add_forces(
        &self,
        u: [&[Displacement]; 2],
        forces: [&mut [Displacement]; 2],
    ) -> ContactForces {
        match self {
            Self::Straight(interface) => interface.add_forces(u, forces),
            Self::Slipping(slipping) => slipping.add_forces(u, forces),
        }
    }

    pub fn force(&self, u: [&dyn Fn(u32) -> Displacement; 2]) -> f64 {
        match self {
            Self::Straight(interface) => interface.force(u.map(|u| move |node| u(node)[1])),
            Self::Slipping(slipping) => slipping.force(u),
        }
    }

    pub fn radius_and_pressure(&self, u: [&[Displacement]; 2]) -> (f64, f64) {
        match self {
            Self::Straight(interface) => interface.radius_and_pressure(u),
            Self::Slipping(slipping) => slipping.radius_and_pressure(u),
        }
    }

    pub fn profile(&self, u: [&[Displacement]; 2]) -> Profile {
        match self {
            Self::Straight(interface) => interface.profile(u),
            Self::Slipping(slipping) => slipping.profile(u),
        }
    }
}
