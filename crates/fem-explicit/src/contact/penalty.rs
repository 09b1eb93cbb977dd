//! The penalty interface of [`fem_contact`] as a contact: springs that are closed or open, without
//! history.

use fem_collision::CandidateRegion;
use fem_contact::{ContactForces, ContactInterface, Profile};

use super::Contact;
use crate::part::{Field, Motion, NodalField, Part};

impl Part for ContactInterface {}

impl Contact for ContactInterface {
    fn searched(&self) -> CandidateRegion {
        let (radius, n_points) = (self.candidate_radius(), self.n_points());
        CandidateRegion { radius, n_points, at_nodes: false }
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
        self.points().iter().flat_map(|point| point.feet[side].nodes).collect()
    }

    fn is_closed_next(
        &self,
        _: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        self.is_closed(next.map(|displacement| move |node| displacement(node)[1]))
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        self.radius_and_pressure(motions.each_ref().map(|motion| motion.displacement))
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        self.profile(motions.each_ref().map(|motion| motion.displacement))
    }
}
