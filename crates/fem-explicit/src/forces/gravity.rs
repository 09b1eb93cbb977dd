//! The weight of a body.
//!
//! ```math
//! f_{y,a} = -m_a\,g, \qquad \Pi = -\sum_a f_{y,a}\,u_{y,a}
//! ```
//!
//! with the lumped masses m_a. In proportion to the masses the force deforms no body that falls.
//! Potential Π is 0 at first touch.

use fem_collision::Account;

use super::NodeForce;
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// Gravity along −y.
#[derive(Debug, Clone)]
pub struct Weight {
    /// Along −y, m/s².
    acceleration: f64,
}

impl Weight {
    /// Takes the acceleration along −y, m/s².
    pub fn new(acceleration: f64) -> Self {
        Self { acceleration }
    }
}

impl Part for Weight {}

impl NodeForce for Weight {
    fn add_forces(&self, motion: &Motion<'_>, _: &[NodalField], forces: &mut Field) -> f64 {
        let mut resultant = 0.0;
        for (force, mass) in forces.iter_mut().zip(motion.nodal_mass) {
            let weight = mass * self.acceleration;
            force[1] -= weight;
            resultant -= weight;
        }
        resultant
    }

    fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
        let nodes = motion.nodal_mass.iter().zip(motion.displacement);
        let raised: f64 = nodes.map(|(mass, u)| mass * u[1]).sum();
        accounts.energies.add(Account::Potential, self.acceleration * raised);
    }

    fn acceleration(&self) -> f64 {
        -self.acceleration
    }
}
