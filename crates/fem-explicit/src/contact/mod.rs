//! How the bodies touch: the port, and one file an implementation.

mod massless;
mod moved;
mod penalty;
mod slipping;

use std::any::Any;

use fem_collision::CandidateRegion;
use fem_contact::{ContactForces, Profile};

use crate::error::ModelError;
use crate::part::{Accounts, Field, Motion, MotionMut, NodalField, Part};

pub use massless::Massless;
pub use moved::MovedContact;

/// How springs keep the surfaces apart.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ContactMethod {
    /// Springs at the Gauss points of both surfaces, between nodes that have mass.
    #[default]
    Penalty,
    /// The same springs between nodes without mass, which are always in balance.
    Massless,
    /// Springs at the nodes of each surface against the other one, as textbooks have them.
    NodeToSurface,
}

impl ContactMethod {
    /// How many times more than usual springs count in the critical time step that are `factor` times as
    /// stiff as usual.
    ///
    /// The stiffer they are, the more of a collision they open and close, and each time takes or gives energy by
    /// the square of the step. A glass pair and a glass ball on a wall gained up to 4e-3 of it with springs at
    /// Gauss points 100 and 1000 times as stiff and the step of usual ones, with half of it 4e-4. Springs at nodes,
    /// which close as a whole, gained 3e-2 from ten times on, or ended the run; with a third of the step 8e-4,
    /// with a quarter 2e-4.
    pub fn shorter_steps(self, factor: f64) -> f64 {
        match self {
            Self::Massless => 1.0,
            Self::Penalty => factor.clamp(1.0, 4.0),
            Self::NodeToSurface => factor.clamp(1.0, 16.0),
        }
    }
}

/// The contact of both bodies; arrays are of the lower and the upper one.
///
/// The place of another way to keep the bodies apart: penalty springs, a boundary without mass that
/// is always in balance, surfaces that turn as they deform, friction. The fields of history that it
/// declares are kept of both bodies.
pub trait Contact: Part {
    /// Where contact is looked for.
    fn searched(&self) -> CandidateRegion;

    /// Adds a bound of its stiffness at each node (N/m) of a side, 0 lower, 1 upper, whatever is
    /// closed.
    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]);

    /// Adds a bound of its damping at each node (N s/m) of a side; a contact that does not depend on the
    /// velocity has none.
    fn add_damping_bound(&self, _side: usize, _bound: &mut [f64]) {}

    /// Adds what these bounds of a side have grown by since the bodies were undeformed, of all that can be
    /// closed within a time, s: nothing of a contact that does not change its stiffness with them. Asked for
    /// in runs whose bodies do.
    fn add_bound_growth(
        &self,
        _motions: &[Motion<'_>; 2],
        _within: f64,
        _side: usize,
        _stiffness: &mut [f64],
        _damping: &mut [f64],
    ) {
    }

    /// Adds the contact forces (N) of a configuration.
    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces;

    /// Nodes of a side, 0 lower, 1 upper, on which [`Contact::add_forces`] can change the force, in any order.
    fn pushed_nodes(&self, side: usize) -> Vec<u32>;

    /// Whether it can be, once it knows the time step.
    ///
    /// # Errors
    /// What it lacks.
    fn check(&self) -> Result<(), ModelError> {
        Ok(())
    }

    /// Adds what it has taken since first touch; what its springs hold is told with the forces.
    fn add_energies(&self, _history: [&[NodalField]; 2], _accounts: &mut Accounts) {}

    /// Nodes of a side, 0 lower, 1 upper, that have no mass: the step leaves them the velocity that
    /// they had, and the contact moves them where they are in balance.
    fn massless_nodes(&self, _side: usize) -> &[u32] {
        &[]
    }

    /// Room that a run has for it. A run that goes on from its memory begins with another: nothing that
    /// is found in it decides a bit.
    fn buffers(&self) -> Box<dyn Any + Send + Sync> {
        Box::new(())
    }

    /// Takes the history to the end of a step, whose motion is given, that of stress included; moves
    /// the nodes without mass.
    fn advance(
        &self,
        _motions: [MotionMut<'_>; 2],
        _history: [&mut [NodalField]; 2],
        _buffers: &mut dyn Any,
    ) {
    }

    /// Whether the next configuration is in contact, of whose nodes `next` tells the displacements (m),
    /// those of nodes without mass as if they kept their velocity; `now` is the present contact. Where
    /// that leaves a doubt, it is not.
    fn is_closed_next(
        &self,
        now: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        history: [&[NodalField]; 2],
    ) -> bool;

    /// Radius at which the contact pressure falls to zero, m, and pressure on the axis, Pa; 0 without contact
    /// there.
    fn radius_and_pressure(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
    ) -> (f64, f64);

    /// The contact from the axis outward, as snapshots show it.
    fn profile(&self, motions: &[Motion<'_>; 2], history: [&[NodalField]; 2]) -> Profile;
}
