//! Forces on the nodes of a body other than stress and contact, one file per force.

mod bulk_viscosity;
mod gravity;

pub use bulk_viscosity::{BulkViscosity, ViscosityCoefficients};

use crate::part::{Accounts, Field, Motion, NodalField, Part};

pub use gravity::Weight;

/// A force on the nodes of a body, from first touch on.
///
/// Implement it for effects that act from outside or depend on the motion: gravity, drag, a prescribed load, bulk
/// viscosity. A body has a list of such forces, empty by default ([`ModelParts`](crate::ModelParts)), which are added in its
/// order. A rigid sphere is one node with all of its mass; a wall has no forces. No force acts in the flight before
/// first touch, which is not stepped.
///
/// ```
/// use fem_collision::Account;
/// use fem_explicit::{Accounts, Field, Motion, NodalField, NodeForce, Part};
///
/// /// The same acceleration (m/s²) along +y everywhere.
/// #[derive(Debug)]
/// struct Pull(f64);
///
/// impl Part for Pull {}
///
/// impl NodeForce for Pull {
///     fn add_forces(&self, motion: &Motion<'_>, _: &[NodalField], forces: &mut Field) -> f64 {
///         let mut resultant = 0.0;
///         for (force, mass) in forces.iter_mut().zip(motion.nodal_mass) {
///             force[1] += mass * self.0;
///             resultant += mass * self.0;
///         }
///         resultant
///     }
///
///     fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
///         let nodes = motion.nodal_mass.iter().zip(motion.displacement);
///         // Work from outside: an effect of its own has an account of its own.
///         let work = nodes.map(|(mass, u)| mass * self.0 * u[1]).sum();
///         accounts.energies.add(Account::WallWork, work);
///     }
/// }
/// ```
pub trait NodeForce: Part {
    /// Adds its forces (N) to `forces` and returns their sum along +y, N.
    fn add_forces(&self, motion: &Motion<'_>, history: &[NodalField], forces: &mut Field) -> f64;

    /// Takes its history to the end of a step, whose motion is given.
    fn advance(&self, _motion: &Motion<'_>, _history: &mut [NodalField]) {}

    /// Adds the work that it has done since first touch, its stored energy, or its power.
    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts);

    /// Returns the acceleration along +y that it gives to the whole body at any place and velocity, m/s²; 0 for any
    /// other force.
    fn acceleration(&self) -> f64 {
        0.0
    }

    /// Adds a bound of its stiffness at each node, N/m; a force that does not depend on the
    /// displacement has none.
    fn add_stiffness_bound(&self, _bound: &mut [f64]) {}

    /// Adds a bound of its damping at each node, N s/m; a force that does not depend on the velocity
    /// has none.
    fn add_damping_bound(&self, _bound: &mut [f64]) {}
}
