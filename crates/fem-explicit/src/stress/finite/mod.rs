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
//! rates       how fast elements are strained
//! kernel      the element loops: forces, energy
//! bound       the largest eigenvalue of deformed elements
//! stability   whether the law of an element still bears every wave
//! ```

mod block;
mod bound;
mod elastic;
mod hourglass;
mod kernel;
mod law;
mod past;
mod rates;
mod relaxing;
mod stability;

use std::fmt;

use fem_collision::Account;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, Inverted, NeoHooke, SymmetricTensor,
};
use fem_mesh::SphereMesh;

use super::port::{Collapse, LumpedElement, Stress, Unstable};
use crate::part::{Accounts, Field, Motion, NodalField, Part};
use block::{Blocks, Slots};
use bound::Metrics;
use elastic::Elastic;
use kernel::Elements;
use law::Law;
pub use past::MOST_FINITE_STRAIN_TERMS;

/// The stress of a body at finite strain: its elements, and how they answer to what deforms them.
struct FiniteStrain<R> {
    blocks: Blocks,
    metrics: Metrics,
    response: R,
}

/// What elements that relax and elements that do not have each of their own.
trait Response: fmt::Debug + Send + Sync + 'static {
    /// The law of their stress.
    type Law: Law;

    fn law(&self) -> &Self::Law;

    /// Its name.
    fn law_name(&self) -> HyperelasticLaw;

    /// Number of fields of history of the elements, and behind them of the nodes.
    fn n_history(&self) -> [usize; 2] {
        [0, 0]
    }

    fn set_time_step(&mut self, _time_step: f64) {}

    /// Subtracts the internal forces, N. Whether every element has a volume; if not, the forces mean
    /// nothing.
    fn subtract_forces(
        &self,
        blocks: &Blocks,
        u: &Field,
        history: &[NodalField],
        forces: &mut Field,
    ) -> bool;

    /// Cauchy stress, Pa, of an element with a displacement gradient.
    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        element: (Slots, usize),
        history: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted>;

    /// Takes the history to a displacement at the end of a time step (s), or in no time.
    fn advance(&self, _: &Blocks, _time_step: Option<f64>, _u: &Field, _: &mut [NodalField]) {}

    /// What the elements store (J) and dissipate, W.
    fn energies(&self, blocks: &Blocks, u: &Field, history: &[NodalField]) -> (f64, f64);
}

/// The stress of a material that stores energy by a law, and relaxes by no more than [`MOST_FINITE_STRAIN_TERMS`].
pub(crate) fn finite_strain(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn Stress> {
    let all: Vec<_> = (0..geometries.len()).collect();
    finite_strain_of(mesh, geometries, &all, material, law)
}

/// The same on some elements, which it knows by their places in the list.
pub(super) fn finite_strain_of(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    elements: &[usize],
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn Stress> {
    let moduli = material.instantaneous();
    let (bulk, shear) = (moduli.bulk_modulus(), moduli.shear_modulus());
    let solid = Hyperelastic::new(law, moduli);
    let blocks = Blocks::pack(mesh, geometries, elements);
    let metrics = Metrics::pack(mesh, geometries, elements, material.density());
    if let Some(series) = material.relaxation().filter(|series| series.relaxes()) {
        return relaxing::relaxing_strain(blocks, metrics, &solid, series);
    }
    if law == HyperelasticLaw::NeoHooke {
        let law = NeoHooke { bulk, shear };
        return Box::new(FiniteStrain { blocks, metrics, response: Elastic { law, solid } });
    }
    Box::new(FiniteStrain { blocks, metrics, response: Elastic { law: solid, solid } })
}

impl<R: Response> FiniteStrain<R> {
    fn add_bound(&self, u: &Field, history: &[NodalField], bound: &mut [f64]) {
        let elements = Elements { blocks: &self.blocks, law: self.response.law(), history };
        bound::add_stiffness(&elements, &self.metrics, u, bound);
    }
}

/// Its law, moduli and terms; the mesh is known by other means.
impl<R: fmt::Debug> fmt::Debug for FiniteStrain<R> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.response.fmt(formatter)
    }
}

impl<R: Response> Part for FiniteStrain<R> {
    fn n_history(&self) -> usize {
        self.response.n_history()[1]
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.response.set_time_step(time_step);
    }
}

impl<R: Response> Stress for FiniteStrain<R> {
    fn n_element_history(&self) -> usize {
        self.response.n_history()[0]
    }

    fn n_finite_elements(&self) -> usize {
        self.blocks.n_elements()
    }

    fn largest_eigenvalue(
        &self,
        geometry: &QuadGeometry,
        masses: &[f64; 4],
        on_axis: [bool; 4],
    ) -> f64 {
        let element = LumpedElement { geometry: *geometry, masses: *masses, on_axis };
        self.largest_eigenvalues(&[element])[0]
    }

    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        bound::at_rest(self.response.law(), elements)
    }

    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        let u = motion.displacement;
        match self.response.subtract_forces(&self.blocks, u, history, forces) {
            true => Ok(()),
            false => Err(self.blocks.most_compressed(u)),
        }
    }

    fn changes_stiffness(&self) -> bool {
        true
    }

    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]) {
        let still = vec![[0.0; 2]; bound.len()];
        self.add_bound(&still, &[], bound);
    }

    fn add_stiffness_bound(&self, motion: &Motion<'_>, history: &[NodalField], bound: &mut [f64]) {
        self.add_bound(motion.displacement, history, bound);
    }

    fn strain_rate(&self, motion: &Motion<'_>) -> f64 {
        rates::strain_rate(&self.blocks, motion.displacement, motion.velocity)
    }

    fn urgency(&self, motion: &Motion<'_>, room: &[f64]) -> f64 {
        rates::urgency(&self.blocks, motion.displacement, motion.velocity, room)
    }

    fn most_compressed(&self, displacement: &Field) -> Option<Collapse> {
        Some(self.blocks.most_compressed(displacement))
    }

    fn can_lose_stability(&self) -> bool {
        !self.response.law_name().is_always_elliptic()
    }

    fn unstable_element(&self, u: &Field, history: &[NodalField]) -> Option<Unstable> {
        stability::unstable_element(&self.blocks, &self.response, u, history)
    }

    fn update_cauchy_stress(&self, u: &Field, history: &[NodalField], stress: &mut Vec<[f64; 4]>) {
        stress.clear();
        stress.extend((0..self.blocks.n_elements()).map(|element| {
            let h = self.blocks.gradient(element, u);
            // No run goes on behind a collapse.
            let stress = self.response.cauchy(&h, self.blocks.slot(element), history).ok();
            stress.map_or([f64::NAN; 4], |stress| [stress.rr, stress.yy, stress.tt, stress.ry])
        }));
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let (time_step, u) = (motion.time_step, motion.displacement);
        self.response.advance(&self.blocks, Some(time_step), u, history);
    }

    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]) {
        self.response.advance(&self.blocks, None, displacement, history);
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let (stored, power) = self.response.energies(&self.blocks, motion.displacement, history);
        accounts.energies.add(Account::Strain, stored);
        // A body that dissipates nothing has an account of it.
        accounts.powers.add(Account::ViscousDissipation, power);
    }
}

#[cfg(test)]
mod tests;
