//! Elements at finite strain that do not relax.

use std::fmt;

use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, Inverted, SymmetricTensor,
};

use super::Response;
use super::block::{Blocks, Slots};
use super::kernel::{self, Elements};
use super::law::ElasticLaw;
use crate::part::{Field, NodalField};

/// A law for the loops, and the same by its name.
pub(super) struct Elastic<W> {
    pub law: W,
    pub solid: Hyperelastic,
}

impl<W> fmt::Debug for Elastic<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "FiniteStrain {{ {:?} }}", self.solid)
    }
}

impl<W: ElasticLaw> Response for Elastic<W> {
    type Law = W;

    fn law(&self) -> &W {
        &self.law
    }

    fn law_name(&self) -> HyperelasticLaw {
        self.solid.law()
    }

    fn subtract_forces(
        &self,
        blocks: &Blocks,
        u: &Field,
        _: &[NodalField],
        forces: &mut Field,
    ) -> bool {
        Elements { blocks, law: &self.law, history: &[] }.subtract_forces(u, forces)
    }

    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        _: (Slots, usize),
        _: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted> {
        self.solid.cauchy(h)
    }

    fn energies(&self, blocks: &Blocks, u: &Field, _: &[NodalField]) -> (f64, f64) {
        (kernel::stored_energy(blocks, &self.law, u), 0.0)
    }
}
