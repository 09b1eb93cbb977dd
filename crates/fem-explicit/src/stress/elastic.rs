//! Hooke's law at small strain.
//!
//! ```math
//! f = -K u, \qquad E = \tfrac12\, u \cdot K u
//! ```

use fem_collision::Account;
use fem_element::{
    ElementMatrix, QuadGeometry, largest_eigenvalue, mean_gradient, mean_gradient_stiffness,
};

use super::elements::PackedElements;
use super::kernel::{Moduli, strain_energy, subtract_internal_forces};
use super::traits::{Collapse, LumpedElement, SmallStrainStress, StrainMeasure, Stress};
use crate::part::{Accounts, Field, Motion, NodalField, Part};

/// The elements of a body and their moduli. Relaxing bodies build on it.
#[derive(Debug, Clone)]
pub(super) struct Elastic {
    pub elements: PackedElements,
    /// The instantaneous moduli.
    pub moduli: Moduli,
}

impl Part for Elastic {}

impl Stress for Elastic {
    fn strain_measure(&self) -> StrainMeasure<'_> {
        StrainMeasure::Small(self)
    }

    fn n_element_history(&self) -> usize {
        0
    }

    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        let of = |element: &LumpedElement| {
            let LumpedElement { geometry, masses, on_axis } = element;
            let lower = mean_gradient_stiffness(geometry, self.moduli.bulk, self.moduli.shear);
            let entry = |row: usize, column: usize| lower[row * (row + 1) / 2 + column];
            let matrix = ElementMatrix::from_fn(|i, j| entry(i.max(j), i.min(j)));
            largest_eigenvalue(&matrix, masses, *on_axis)
        };
        elements.iter().map(of).collect()
    }

    fn start_rigid(&self, _: &Field, _: &mut [NodalField]) {}

    fn start_deformed(&self, _: &Field, _: &mut [NodalField]) {}

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        _: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        subtract_internal_forces(&self.elements, self.moduli, motion.displacement, forces);
        Ok(())
    }

    fn advance(&self, _: &Motion<'_>, _: &mut [NodalField]) {}

    fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
        let stored = strain_energy(&self.elements, self.moduli, motion.displacement);
        accounts.energies.add(Account::Strain, stored);
        // The account is present, and empty.
        accounts.powers.add(Account::ViscousDissipation, 0.0);
    }
}

impl SmallStrainStress for Elastic {
    fn stiffness_of_step(&self, geometry: &QuadGeometry) -> ElementMatrix {
        mean_gradient(geometry).combine(self.moduli.bulk, self.moduli.shear)
    }

    fn shift(&self, _: usize, _: [f64; 2], _: &mut [NodalField]) {}

    fn effective(&self) -> Option<usize> {
        None
    }
}
