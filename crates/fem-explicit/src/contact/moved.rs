//! The springs of [`fem_contact`] between moved surfaces as a contact, without history.

use fem_collision::{BodyInput, Searched};
use fem_contact::{ContactError, ContactForces, MovedInterface};

use super::Contact;
use crate::model::{Settings, mass_ratio, surface};
use crate::part::{Field, Motion, NodalField, Part};

/// Springs between the surfaces of two bodies where they are now; `gap` (m) separates their poles.
/// For [`Parts::contact`](crate::Parts::contact).
///
/// # Errors
/// Two rigid bodies or planes; settings that are not positive and finite.
pub fn moved_contact(
    inputs: &[BodyInput; 2],
    gap: f64,
    settings: &Settings,
) -> Result<MovedInterface, ContactError> {
    let [lower, upper] = inputs;
    let (lower, upper) = (surface(lower)?, surface(upper)?);
    let &Settings { contact_stiffness, candidate_radius, .. } = settings;
    let interface = MovedInterface::new(lower, upper, contact_stiffness, gap, candidate_radius)?;
    Ok(match mass_ratio(inputs) {
        Some(ratio) => interface.with_rigid_mass(ratio),
        None => interface,
    })
}

impl Part for MovedInterface {}

impl Contact for MovedInterface {
    fn searched(&self) -> Searched {
        let (radius, n_points) = (self.candidate_radius(), self.n_points());
        Searched { radius, n_points, at_nodes: false }
    }

    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.add_stiffness_bound(side, bound);
    }

    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        _: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces {
        self.add_forces(motions.each_ref().map(|motion| motion.displacement), forces)
    }

    fn is_closed_next(&self, next: [&dyn Fn(u32) -> [f64; 2]; 2], _: [&[NodalField]; 2]) -> bool {
        self.is_closed(next)
    }

    fn contact_radius(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> f64 {
        self.contact_radius(motions.each_ref().map(|motion| motion.displacement))
    }

    fn centre_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> f64 {
        self.centre_pressure(motions.each_ref().map(|motion| motion.displacement))
    }
}
