//! The penalty interface of [`fem_contact`] between surfaces that slip on each other as a contact.

use fem_collision::CandidateRegion;
use fem_contact::{ContactForces, Profile, SlippingInterface};

use super::Contact;
use crate::part::{Field, Motion, NodalField, Part};

impl Part for SlippingInterface {}

impl Contact for SlippingInterface {
    fn searched(&self) -> CandidateRegion {
        Contact::searched(self.interface())
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

    fn pushed_nodes(&self, side: usize) -> Vec<u32> {
        self.interface().pushed_nodes(side)
    }

    fn is_closed_next(
        &self,
        _: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        self.is_closed(next)
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        self.radius_and_pressure(motions.each_ref().map(|motion| motion.displacement))
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        self.profile(motions.each_ref().map(|motion| motion.displacement))
    }
}
