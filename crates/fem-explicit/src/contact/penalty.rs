//! The penalty interface of [`fem_contact`] as a contact: springs that are closed or open, without
//! history.

use fem_collision::{BodyInput, Searched};
use fem_contact::{ContactError, ContactForces, ContactInterface};

use super::{Contact, mass_ratio, surface};
use crate::model::Settings;
use crate::part::{Field, Motion, NodalField, Part};

/// The penalty contact that settings ask for.
pub(crate) fn penalty_contact(
    inputs: &[BodyInput; 2],
    gap: f64,
    settings: &Settings,
) -> Result<ContactInterface, ContactError> {
    let [lower, upper] = inputs;
    let (lower, upper) = (surface(lower)?, surface(upper)?);
    let &Settings { contact_stiffness, candidate_radius, .. } = settings;
    let interface = ContactInterface::new(lower, upper, contact_stiffness, gap, candidate_radius)?;
    Ok(match mass_ratio(inputs) {
        Some(ratio) => interface.with_rigid_mass(ratio),
        None => interface,
    })
}

impl Part for ContactInterface {}

impl Contact for ContactInterface {
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
        self.is_closed(next.map(|displacement| move |node| displacement(node)[1]))
    }

    fn contact_radius(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> f64 {
        self.contact_radius(motions.each_ref().map(|motion| motion.displacement))
    }

    fn centre_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> f64 {
        self.centre_pressure(motions.each_ref().map(|motion| motion.displacement))
    }
}
