//! Hooke's law at small strain.
//!
//! ```math
//! f = -K u, \qquad E = \tfrac12\, u \cdot K u
//! ```

use fem_collision::Account;
use fem_element::{
    ElementMatrix, QuadGeometry, largest_eigenvalue, mean_gradient, mean_gradient_stiffness,
};

use super::elements::Elements;
use super::kernel::{Moduli, strain_energy, subtract_internal_forces};
use super::port::{Collapse, Stress};
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The elements of a body and their moduli, which relaxing bodies start from.
#[derive(Debug, Clone)]
pub(super) struct Elastic {
    pub elements: Elements,
    /// Of a deformation in no time.
    pub moduli: Moduli,
}

impl Part for Elastic {}

impl Stress for Elastic {
    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64 {
        let lower = mean_gradient_stiffness(geometry, self.moduli.bulk, self.moduli.shear);
        let entry = |row: usize, column: usize| lower[row * (row + 1) / 2 + column];
        let matrix = ElementMatrix::from_fn(|i, j| entry(i.max(j), i.min(j)));
        largest_eigenvalue(&matrix, masses, on_axis)
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        _: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        subtract_internal_forces(&self.elements, self.moduli, motion.displacement, forces);
        Ok(())
    }

    fn stiffness_of_step(&self, geometry: &QuadGeometry) -> Option<ElementMatrix> {
        Some(mean_gradient(geometry).combine(self.moduli.bulk, self.moduli.shear))
    }

    fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
        let stored = strain_energy(&self.elements, self.moduli, motion.displacement);
        accounts.energies.add(Account::Strain, stored);
        // A body that dissipates nothing has an account of it.
        accounts.powers.add(Account::ViscousDissipation, 0.0);
    }
}
