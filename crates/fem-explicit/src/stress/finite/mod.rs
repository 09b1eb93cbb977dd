//! Finite strain: total Lagrangian elements with one mean deformation gradient.
//!
//! ```math
//! \bar F = 1 + \sum_a u_a \otimes \bar\nabla N_a, \qquad
//! f_a = -V\, P(\bar F)\, \bar\nabla N_a - \frac{\partial E_h}{\partial u_a}, \qquad P = \frac{\partial W}{\partial F}
//! ```
//!
//! with the gradients, the hoop and the hourglass shape of the undeformed element ([`QuadGeometry`]), so that a step
//! reads and writes nodal vectors alone, as at small strain. An element has one mean volume, so nearly incompressible
//! bodies do not lock. W is the stored energy of a law of [`fem_material::finite`], E_h that of the hourglass shape
//! ([`hourglass`]). Both are functions of the displacement, so forces are the derivative of an energy; both are
//! invariant under rigid rotation of the meridian plane; at small strain both agree with the small-strain element.
//!
//! A new constitutive model is an [`ElementResponse`]: it declares its internal variables and computes the first Piola–Kirchhoff stress of a block ([`kernel::BlockResponse`]); the loop
//! from displacement to forces is shared.
//!
//! ```text
//! elastic             elastic response
//! relaxing            viscoelastic response: update of internal variables, energies
//! flowing             elastic–plastic response: the same
//! internal_variables  their place in the history
//! law                 stress and energy of a law, on lanes
//! kernel              the element loops: forces, energy
//! hourglass           energy of the hourglass shape in a deformed element, and its derivatives
//! block               geometry of eight elements, and the place of elements in the history
//! bound               largest eigenvalue of deformed elements
//! rates               strain rates
//! stability           loss of ellipticity
//! ```

mod block;
mod bound;
mod elastic;
mod flowing;
mod hourglass;
mod internal_variables;
mod kernel;
mod law;
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

use super::traits::{
    Collapse, FiniteStrainStress, LumpedElement, StrainMeasure, Stress, UnstableElement,
};
use crate::part::{Accounts, Field, Motion, NodalField, Part};
use block::{Blocks, Slots};
use bound::Metrics;
use elastic::ElasticResponse;
use flowing::FlowingResponse;
pub use internal_variables::MAX_FINITE_STRAIN_TERMS;
use law::Law;
use relaxing::RelaxingResponse;

/// The stress of a body at finite strain: its elements and their response.
struct FiniteStrain<R> {
    blocks: Blocks,
    metrics: Metrics,
    response: R,
}

/// The response of elements to their deformation: elastic, or with internal variables.
trait ElementResponse: fmt::Debug + Send + Sync + 'static {
    /// The law of the stress.
    type Law: Law;

    /// Returns the law of the stress.
    fn law(&self) -> &Self::Law;

    /// Returns the name of the law.
    fn law_name(&self) -> HyperelasticLaw;

    /// Returns the number of fields of internal variables; 0 for an elastic response.
    fn n_internal_fields(&self) -> usize;

    /// Takes the time step of the model, s.
    fn set_time_step(&mut self, time_step: f64);

    /// Takes the internal variables to a displacement at the end of a time step (s), or instantaneously, and subtracts
    /// the internal forces there (N) from `forces`.
    ///
    /// Returns whether every element has a positive volume; if not, the forces have no meaning.
    fn update_forces(
        &self,
        blocks: &Blocks,
        time_step: Option<f64>,
        u: &Field,
        internal: &mut [NodalField],
        forces: &mut Field,
    ) -> bool;

    /// Returns the Cauchy stress (Pa) of an element with a displacement gradient.
    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        element: (Slots, usize),
        history: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted>;

    /// Returns the equivalent plastic strain and the plastic work per undeformed volume (J/m³) of an element; `None` if
    /// elements do not flow.
    fn plastic(&self, _: (Slots, usize), _: &[NodalField]) -> Option<[f64; 2]> {
        None
    }

    /// Adds the energy that the elements store, and what they dissipate.
    fn add_energies(
        &self,
        blocks: &Blocks,
        u: &Field,
        history: &[NodalField],
        accounts: &mut Accounts,
    );

    /// Returns whether the law can lose ellipticity, so that unstable elements have to be searched for. Plastic flow
    /// bounds the elastic shear strain far below that limit.
    fn can_lose_ellipticity(&self) -> bool {
        !self.law_name().is_always_elliptic()
    }
}

/// Makes the stress of a material at finite strain on some elements of a mesh, which it numbers by their places in the
/// list. The material has at most [`MAX_FINITE_STRAIN_TERMS`] relaxation terms.
pub(super) fn finite_strain(
    mesh: &SphereMesh,
    geometries: &[QuadGeometry],
    elements: &[usize],
    material: &Material,
    law: HyperelasticLaw,
) -> Box<dyn FiniteStrainStress> {
    let moduli = material.instantaneous();
    let (bulk, shear) = (moduli.bulk_modulus(), moduli.shear_modulus());
    let solid = Hyperelastic::new(law, moduli);
    let blocks = Blocks::pack(mesh, geometries, elements);
    let metrics = Metrics::pack(mesh, geometries, elements, material.density());
    if let Some(flow) = material.flow() {
        let response = FlowingResponse::new(moduli, flow.clone());
        return Box::new(FiniteStrain { blocks, metrics, response });
    }
    if let Some(series) = material.relaxation().filter(|series| series.relaxes()) {
        let response = RelaxingResponse::new(&solid, series);
        return Box::new(FiniteStrain { blocks, metrics, response });
    }
    if law == HyperelasticLaw::NeoHooke {
        let law = NeoHooke { bulk, shear };
        return Box::new(FiniteStrain {
            blocks,
            metrics,
            response: ElasticResponse { law, solid },
        });
    }
    Box::new(FiniteStrain { blocks, metrics, response: ElasticResponse { law: solid, solid } })
}

impl<R: ElementResponse> FiniteStrain<R> {
    /// Takes a history to a displacement, with the internal forces there. Without internal variables there is no
    /// history.
    fn update_history(&self, time_step: Option<f64>, u: &Field, history: &mut [NodalField]) {
        let (internal, forces) = history.split_at_mut(self.response.n_internal_fields());
        let Some(forces) = forces.first_mut() else { return };
        // At all other nodes they are always zero.
        let nodes = self.blocks.nodes();
        forces[nodes.clone()].fill([0.0; 2]);
        if !self.response.update_forces(&self.blocks, time_step, u, internal, forces) {
            forces[nodes].fill([f64::NAN; 2]);
        }
    }

    /// Adds the internal forces that the history holds. Returns whether every element has a positive volume.
    fn add_forces_of_history(&self, history: &[NodalField], forces: &mut Field) -> bool {
        let nodes = self.blocks.nodes();
        let own = &history[self.response.n_internal_fields()][nodes.clone()];
        if own.first().is_some_and(|force| force[0].is_nan()) {
            return false;
        }
        let forces = forces[nodes].as_flattened_mut();
        for (force, own) in forces.iter_mut().zip(own.as_flattened()) {
            *force += own;
        }
        true
    }
}

/// Shows law, moduli and terms, for the fingerprint of a model.
impl<R: fmt::Debug> fmt::Debug for FiniteStrain<R> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.response.fmt(formatter)
    }
}

impl<R: ElementResponse> Part for FiniteStrain<R> {
    /// Returns 1 with internal variables: the field of internal forces.
    fn n_history(&self) -> usize {
        usize::from(self.response.n_internal_fields() > 0)
    }

    fn set_time_step(&mut self, time_step: f64) {
        self.response.set_time_step(time_step);
    }
}

impl<R: ElementResponse> Stress for FiniteStrain<R> {
    fn strain_measure(&self) -> StrainMeasure<'_> {
        StrainMeasure::Finite(self)
    }

    fn n_element_history(&self) -> usize {
        self.response.n_internal_fields()
    }

    fn largest_eigenvalues(&self, elements: &[LumpedElement]) -> Vec<f64> {
        bound::at_rest(self.response.law(), elements)
    }

    /// Rigid motion leaves the internal variables and forces at zero.
    fn start_rigid(&self, _: &Field, _: &mut [NodalField]) {}

    fn start_deformed(&self, displacement: &Field, history: &mut [NodalField]) {
        self.update_history(None, displacement, history);
    }

    /// Elastic forces are computed here. With internal variables they have been computed when those were advanced.
    fn subtract_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        let u = motion.displacement;
        let is_valid = match self.response.n_internal_fields() {
            0 => self.response.update_forces(&self.blocks, None, u, &mut [], forces),
            _ => self.add_forces_of_history(history, forces),
        };
        if is_valid { Ok(()) } else { Err(self.blocks.most_compressed(u)) }
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        self.update_history(Some(motion.time_step), motion.displacement, history);
    }

    fn add_energies(&self, motion: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        // The account is present for a body that does not relax too, and empty.
        accounts.powers.add(Account::ViscousDissipation, 0.0);
        self.response.add_energies(&self.blocks, motion.displacement, history, accounts);
    }
}

impl<R: ElementResponse> FiniteStrainStress for FiniteStrain<R> {
    fn n_elements(&self) -> usize {
        self.blocks.n_elements()
    }

    fn add_undeformed_stiffness_bound(&self, bound: &mut [f64]) {
        let undeformed = vec![[0.0; 2]; bound.len()];
        let elements = (&self.blocks, &self.metrics, self.response.law());
        bound::add_stiffness(elements, &undeformed, &[], bound);
    }

    fn add_stiffness_bound(&self, motion: &Motion<'_>, history: &[NodalField], bound: &mut [f64]) {
        let elements = (&self.blocks, &self.metrics, self.response.law());
        bound::add_stiffness(elements, motion.displacement, history, bound);
    }

    fn strain_rate(&self, motion: &Motion<'_>) -> f64 {
        rates::strain_rate(&self.blocks, motion.displacement, motion.velocity)
    }

    fn allowance_rate(&self, motion: &Motion<'_>, allowances: &[f64]) -> f64 {
        rates::allowance_rate(&self.blocks, motion.displacement, motion.velocity, allowances)
    }

    fn most_compressed(&self, displacement: &Field) -> Collapse {
        self.blocks.most_compressed(displacement)
    }

    fn can_lose_stability(&self) -> bool {
        self.response.can_lose_ellipticity()
    }

    fn unstable_element(&self, u: &Field, history: &[NodalField]) -> Option<UnstableElement> {
        stability::unstable_element(&self.blocks, &self.response, u, history)
    }

    fn update_cauchy_stress(&self, u: &Field, history: &[NodalField], stress: &mut Vec<[f64; 4]>) {
        stress.clear();
        stress.extend((0..self.blocks.n_elements()).map(|element| {
            let h = self.blocks.gradient(element, u);
            // A run ends where an element has collapsed.
            let stress = self.response.cauchy(&h, self.blocks.slot(element), history).ok();
            stress.map_or([f64::NAN; 4], |stress| [stress.rr, stress.yy, stress.tt, stress.ry])
        }));
    }

    fn update_plastic(&self, history: &[NodalField], plastic: &mut Vec<[f64; 2]>) {
        plastic.clear();
        let elements = (0..self.blocks.n_elements()).map(|element| self.blocks.slot(element));
        plastic.extend(elements.map_while(|element| self.response.plastic(element, history)));
    }
}

#[cfg(test)]
mod tests;
