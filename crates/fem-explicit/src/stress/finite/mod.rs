//! Finite strain: total Lagrangian elements with one mean deformation gradient.
//!
//! ```math
//! \bar F = 1 + \sum_a u_a \otimes \bar\nabla N_a, \qquad
//! f_a = -V\, P(\bar F)\, \bar\nabla N_a - \frac{\partial E_h}{\partial u_a}, \qquad P = \frac{\partial W}{\partial F}
//! ```
//!
//! with the gradients, the hoop and the hourglass shape of the undeformed element ([`QuadGeometry`]), so
//! that a step touches nodal vectors alone, as at small strain. One mean volume an element: nearly
//! incompressible bodies do not lock. W is the stored energy of a law of [`fem_material::finite`], E_h
//! that of the hourglass shape ([`hourglass`]). Both are functions of the displacement, so forces are the
//! derivative of an energy; rigid rotation of the meridian leaves both as they are; at small strain both
//! are those of the small-strain element.
//!
//! ```text
//! block       what the loops read of eight elements, and where elements lie in a history
//! law         stress and energy of a law, on lanes
//! past        what elements that relax remember
//! relaxing    how that changes in a step and what forces follow, what it stores and dissipates
//! hourglass   energy of the hourglass shape in a deformed element, and its derivatives
//! kernel      the element loops: forces, energy
//! bound       the largest eigenvalue of deformed elements
//! ```

mod block;
mod bound;
mod hourglass;
mod kernel;
mod law;
mod past;
mod relaxing;

use std::fmt;

use fem_collision::Account;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_material::finite::{Hyperelastic, HyperelasticLaw, NeoHooke};
use fem_mesh::SphereMesh;

use super::port::{Collapse, Stress};
use crate::part::{Accounts, Field, Motion, NodalField, Part};
use block::Blocks;
use bound::Metrics;
use kernel::Elements;
use law::ElasticLaw;
pub use past::MOST_FINITE_STRAIN_TERMS;

/// The stress of a body at finite strain, elastic.
struct FiniteStrain<W> {
    blocks: Blocks,
    metrics: Metrics,
    law: W,
    solid: Hyperelastic,
}

/// The stress of a material that stores energy by a law, and relaxes by no more than [`MOST_FINITE_STRAIN_TERMS`].
pub(crate) fn finite_strain(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn Stress> {
    let moduli = material.instantaneous();
    let (bulk, shear) = (moduli.bulk_modulus(), moduli.shear_modulus());
    let solid = Hyperelastic::new(law, moduli);
    let blocks = Blocks::pack(mesh, geometries);
    let metrics = Metrics::pack(mesh, geometries, material.density());
    if let Some(series) = material.relaxation().filter(|series| series.relaxes()) {
        return relaxing::relaxing_strain(blocks, metrics, &solid, series);
    }
    if law == HyperelasticLaw::NeoHooke {
        let law = NeoHooke { bulk, shear };
        return Box::new(FiniteStrain { blocks, metrics, law, solid });
    }
    Box::new(FiniteStrain { blocks, metrics, law: solid, solid })
}

impl<W: ElasticLaw> FiniteStrain<W> {
    fn elements(&self) -> Elements<'_, W> {
        Elements { blocks: &self.blocks, law: &self.law, history: &[] }
    }
}

/// Its law and moduli; the mesh is known by other means.
impl<W> fmt::Debug for FiniteStrain<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "FiniteStrain {{ {:?} }}", self.solid)
    }
}

impl<W: ElasticLaw> Part for FiniteStrain<W> {}

impl<W: ElasticLaw> Stress for FiniteStrain<W> {
    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64 {
        bound::at_rest(&self.law, geometry, masses, on_axis)
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        _: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        let is_sound = self.elements().subtract_forces(motion.displacement, forces);
        if is_sound { Ok(()) } else { Err(self.blocks.most_compressed(motion.displacement)) }
    }

    fn changes_stiffness(&self) -> bool {
        true
    }

    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]) {
        let still = vec![[0.0; 2]; bound.len()];
        bound::add_stiffness(&self.elements(), &self.metrics, &still, bound);
    }

    fn add_stiffness_bound(&self, motion: &Motion<'_>, _: &[NodalField], bound: &mut [f64]) {
        bound::add_stiffness(&self.elements(), &self.metrics, motion.displacement, bound);
    }

    fn strain_rate(&self, motion: &Motion<'_>) -> f64 {
        self.blocks.strain_rate(motion.displacement, motion.velocity)
    }

    fn most_compressed(&self, displacement: &Field) -> Option<Collapse> {
        Some(self.blocks.most_compressed(displacement))
    }

    fn update_cauchy_stress(&self, u: &Field, _: &[NodalField], stress: &mut Vec<[f64; 4]>) {
        stress.clear();
        stress.extend((0..self.blocks.n_elements()).map(|element| {
            let h = self.blocks.gradient(element, u);
            // No run goes on behind a collapse.
            let stress = self.solid.cauchy(&h).ok();
            stress.map_or([f64::NAN; 4], |stress| [stress.rr, stress.yy, stress.tt, stress.ry])
        }));
    }

    fn add_energies(&self, motion: &Motion<'_>, _: &[NodalField], accounts: &mut Accounts) {
        let stored = kernel::stored_energy(&self.blocks, &self.law, motion.displacement);
        accounts.energies.add(Account::Strain, stored);
        // A body that dissipates nothing has an account of it.
        accounts.powers.add(Account::ViscousDissipation, 0.0);
    }
}

#[cfg(test)]
mod tests;
