//! Elastic elements at finite strain.

use std::fmt;

use fem_collision::Account;
use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, Inverted, SymmetricTensor,
};

use super::ElementResponse;
use super::block::{Blocks, Slots};
use super::hourglass::Deformed;
use super::kernel::{self, BlockResponse, BlockStress, Deformation};
use super::law::{ElasticLaw, Law};
use crate::lanes::{LaneKernel, Lanes, WIDE, run_wide_lanes};
use crate::part::{Accounts, Field, NodalField};

/// A law for the loops, and the same law by its name.
pub(super) struct ElasticResponse<W> {
    pub law: W,
    pub solid: Hyperelastic,
}

impl<W> fmt::Debug for ElasticResponse<W> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "FiniteStrain {{ {:?} }}", self.solid)
    }
}

impl<W: ElasticLaw> ElementResponse for ElasticResponse<W> {
    type Law = W;

    fn law(&self) -> &W {
        &self.law
    }

    fn law_name(&self) -> HyperelasticLaw {
        self.solid.law()
    }

    fn n_internal_fields(&self) -> usize {
        0
    }

    fn set_time_step(&mut self, _: f64) {}

    fn update_forces(
        &self,
        blocks: &Blocks,
        _: Option<f64>,
        u: &Field,
        _: &mut [NodalField],
        forces: &mut Field,
    ) -> bool {
        let mut output = (forces, true);
        run_wide_lanes(Forces { blocks, law: &self.law, u }, &mut output);
        output.1
    }

    fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        _: (Slots, usize),
        _: &[NodalField],
    ) -> Result<SymmetricTensor, Inverted> {
        self.solid.cauchy(h)
    }

    fn add_energies(&self, blocks: &Blocks, u: &Field, _: &[NodalField], accounts: &mut Accounts) {
        accounts.energies.add(Account::Strain, kernel::stored_energy(blocks, &self.law, u));
    }
}

/// The element loop of the forces. Its output are the forces, and whether every element has a positive volume.
pub(super) struct Forces<'a, W> {
    pub blocks: &'a Blocks,
    pub law: &'a W,
    pub u: &'a Field,
}

impl<'a, W: ElasticLaw> LaneKernel<WIDE> for Forces<'a, W> {
    type Output = (&'a mut Field, bool);

    #[inline(always)]
    fn on<L: Lanes<WIDE>>(self, (f, is_valid): &mut Self::Output) {
        let Self { blocks, law, u } = self;
        let mut response = Elastic { law };
        *is_valid = kernel::subtract_forces::<L, _>(blocks, law.shear(), u, f, &mut response);
    }
}

/// The elastic response of blocks: the stress is a function of the deformation.
struct Elastic<'a, W> {
    law: &'a W,
}

impl<L: Lanes<WIDE>, W: ElasticLaw> BlockResponse<L> for Elastic<'_, W> {
    #[inline(always)]
    fn stress(
        &mut self,
        _: usize,
        deformation: &Deformation<L>,
        _: &Deformed<L>,
        pulled_back: (L, L),
    ) -> BlockStress<L> {
        self.law.stress(&deformation.h, pulled_back, &())
    }
}
