//! The contact of the bodies: the trait [`Contact`] that a step calls, and one file per implementation.
//!
//! ```text
//! springs       penalty springs between the surfaces before deformation, also of surfaces that slip
//! moved         springs and dashpots between the surfaces where they are now, for finite strain
//! massless      springs between nodes without mass, which are always in balance
//! pushed_nodes  forces of the contact on the nodes, for the balance of energy
//! ```

mod deformed;
mod massless;
mod pushed_nodes;
mod springs;

use std::any::Any;

use fem_collision::CandidateRegion;
use fem_contact::{ContactForces, Profile};

use crate::error::ModelError;
use crate::part::{Accounts, Field, Motion, MotionMut, NodalField, Part};

pub use deformed::DeformedContact;
pub use massless::Massless;
pub(crate) use pushed_nodes::PushedNodes;
pub use springs::Springs;
pub(crate) use springs::contact_between;

/// The contact of bodies at small strain: where springs act between the surfaces. The default of this type is
/// [`Self::Penalty`], for bodies that are stepped without contact; the plan of a case selects [`Self::Massless`] unless
/// the case says otherwise.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum SmallStrainContact {
    /// Springs at the Gauss points of both surfaces, between nodes that have mass.
    #[default]
    Penalty,
    /// The same springs between nodes without mass, which are in balance at the end of every step.
    Massless,
    /// Springs at the nodes of each surface against the other one, the textbook method.
    NodeToSurface,
}

impl SmallStrainContact {
    /// Returns the factor on the stiffness of the springs in the bound of the critical time step, for springs that are
    /// `factor` times as stiff as usual.
    ///
    /// Springs that open or close add or remove energy in proportion to the square of the step, and stiffer ones do so
    /// more often. With springs at Gauss points 100 and 1000 times as stiff, a glass pair gained up to 4e-3 of its
    /// energy at the usual step and 4e-4 at half of it. Springs at nodes, which close as a whole, gained 3e-2 at the
    /// usual step, 8e-4 at a third and 2e-4 at a quarter of it.
    pub fn stability_factor(self, factor: f64) -> f64 {
        match self {
            Self::Massless => 1.0,
            Self::Penalty => factor.clamp(1.0, 4.0),
            Self::NodeToSurface => factor.clamp(1.0, 16.0),
        }
    }
}

/// The contact of both bodies; arrays hold the lower and the upper one.
///
/// Implement it for another contact method or for friction. The fields of history that it declares are kept for both
/// bodies.
pub trait Contact: Part {
    /// Returns the candidate region, in which contact is searched for.
    fn candidate_region(&self) -> CandidateRegion;

    /// Adds a bound of the contact stiffness at each node (N/m) of a side, 0 lower, 1 upper, which holds for any closed
    /// part.
    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]);

    /// Adds a bound of the contact damping at each node (N s/m) of a side; a contact that does not depend on the
    /// velocity has none.
    fn add_damping_bound(&self, _side: usize, _bound: &mut [f64]) {}

    /// Adds the growth of both bounds on a side since the bodies were undeformed, for all that can close within a time,
    /// s. Only runs at finite strain call it; a contact of constant stiffness adds nothing.
    fn add_bound_growth(
        &self,
        _motions: &[Motion<'_>; 2],
        _within: f64,
        _side: usize,
        _stiffness: &mut [f64],
        _damping: &mut [f64],
    ) {
    }

    /// Adds the contact forces (N) in a configuration.
    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces;

    /// Returns the nodes of a side, 0 lower, 1 upper, on which [`Contact::add_forces`] can add forces, in any order.
    fn pushed_nodes(&self, side: usize) -> Vec<u32>;

    /// Checks whether the contact can work at the time step, which it knows by then.
    ///
    /// # Errors
    /// The contact cannot work at this time step.
    fn check(&self) -> Result<(), ModelError> {
        Ok(())
    }

    /// Adds the energy that the contact has dissipated since first touch; the energy of its springs is returned with
    /// the forces.
    fn add_energies(&self, _history: [&[NodalField]; 2], _accounts: &mut Accounts) {}

    /// Returns the nodes of a side, 0 lower, 1 upper, that have no mass: the step keeps their velocity, and the contact
    /// moves them to where they are in balance.
    fn massless_nodes(&self, _side: usize) -> &[u32] {
        &[]
    }

    /// Allocates the buffers of the contact for a run. A run that is resumed begins with new ones: their contents must
    /// not change a bit of the result.
    fn buffers(&self) -> Box<dyn Any + Send + Sync> {
        Box::new(())
    }

    /// Advances the history of the contact over a step, and moves the nodes without mass; `motions` include the history
    /// of the stress.
    fn advance(
        &self,
        _motions: [MotionMut<'_>; 2],
        _history: [&mut [NodalField]; 2],
        _buffers: &mut dyn Any,
    ) {
    }

    /// Returns whether the next configuration is certainly in contact: `next` returns the displacements of its nodes
    /// (m), those of nodes without mass as if they kept their velocity; `now` is the present contact.
    fn is_closed_next(
        &self,
        now: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        history: [&[NodalField]; 2],
    ) -> bool;

    /// Returns the radius at which the contact pressure falls to zero, m, and the pressure on the axis, Pa; 0 without
    /// contact there.
    fn radius_and_pressure(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
    ) -> (f64, f64);

    /// Returns the contact from the axis outward, for snapshots.
    fn profile(&self, motions: &[Motion<'_>; 2], history: [&[NodalField]; 2]) -> Profile;
}
