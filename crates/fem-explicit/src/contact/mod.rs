//! How the bodies touch: the port, and one file an implementation.

mod moved;
mod penalty;
mod slipping;

use fem_collision::Searched;
use fem_contact::ContactForces;

use crate::part::{Accounts, Field, Motion, MotionMut, NodalField, Part};

pub use moved::MovedContact;

/// The contact of both bodies; arrays are of the lower and the upper one.
///
/// The place of another way to keep the bodies apart: penalty springs, a boundary without mass that
/// is always in balance, surfaces that turn as they deform, friction. The fields of history that it
/// declares are kept of both bodies.
pub trait Contact: Part {
    /// Where contact is looked for.
    fn searched(&self) -> Searched;

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

    /// Takes the history to the end of a step, whose motion is given; moves the nodes that the step
    /// does not, if there are any.
    fn advance(&self, _motions: [MotionMut<'_>; 2], _history: [&mut [NodalField]; 2]) {}

    /// Adds what it has taken since first touch; what its springs hold is told with the forces.
    fn add_energies(&self, _history: [&[NodalField]; 2], _accounts: &mut Accounts) {}

    /// Whether the next configuration is in contact, of whose nodes `next` tells the displacements,
    /// m.
    fn is_closed_next(
        &self,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        history: [&[NodalField]; 2],
    ) -> bool;

    /// Radius at which the contact pressure falls to zero, m; 0 without contact.
    fn contact_radius(&self, motions: &[Motion<'_>; 2], history: [&[NodalField]; 2]) -> f64;

    /// Contact pressure on the axis, Pa; 0 without contact there.
    fn centre_pressure(&self, motions: &[Motion<'_>; 2], history: [&[NodalField]; 2]) -> f64;
}
