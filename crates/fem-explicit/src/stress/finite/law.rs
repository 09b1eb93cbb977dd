//! Stress and energy of a law on lanes.
//!
//! All laws run on all lanes at once. The default law has loops of its own where it does not relax. In all others the law
//! is selected block by block, at no measurable cost.

use std::fmt::Debug;

use fem_material::PronySeries;
use fem_material::finite::{AxisymmetricTensor, Branches, Hyperelastic, NeoHooke, Viscoelastic};

use super::block::Slots;
use super::hourglass::Amplitudes;
use super::internal_variables::{FIELDS_PER_TERM, InternalVariables};
use super::kernel::BlockStress;
use crate::lanes::{Lanes, WIDE};
use crate::part::NodalField;

/// A law per undeformed volume: the stress as a function of the displacement gradient and of internal variables.
pub(super) trait Law: Debug + Send + Sync + 'static {
    /// Internal variables of the elements of a block.
    type Internal<L: Lanes<WIDE>>;

    /// Returns the instantaneous shear modulus at small strain, Pa.
    fn shear(&self) -> f64;

    /// Returns the number of fields of history from which internal variables are loaded.
    fn n_fields(&self) -> usize;

    /// Returns the internal variables of elements that have never been strained.
    fn undeformed<L: Lanes<WIDE>>(&self) -> Self::Internal<L>;

    /// Loads the internal variables of the elements of a block.
    fn load<L: Lanes<WIDE>>(
        &self,
        internal: &mut Self::Internal<L>,
        history: &[NodalField],
        slots: Slots,
    );

    /// Returns the stress of elements with a displacement gradient and a hourglass amplitude (m), which has been pulled
    /// back.
    fn stress<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        pulled_back: (L, L),
        internal: &Self::Internal<L>,
    ) -> BlockStress<L>;
}

/// A law without internal variables.
pub(super) trait ElasticLaw: Debug + Send + Sync + 'static {
    /// Returns the shear modulus at small strain, Pa.
    fn shear(&self) -> f64;

    /// Returns the first Piola–Kirchhoff stress (Pa), and J − 1. The stress has a meaning where J − 1 > −1.
    fn first_piola<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> (AxisymmetricTensor<L>, L);

    /// Returns the stored energy, J/m³.
    fn energy<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> L;
}

impl<W: ElasticLaw> Law for W {
    type Internal<L: Lanes<WIDE>> = ();

    fn shear(&self) -> f64 {
        ElasticLaw::shear(self)
    }

    fn n_fields(&self) -> usize {
        0
    }

    #[inline(always)]
    fn undeformed<L: Lanes<WIDE>>(&self) {}

    #[inline(always)]
    fn load<L: Lanes<WIDE>>(&self, (): &mut (), _: &[NodalField], _: Slots) {}

    #[inline(always)]
    fn stress<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        pulled_back: (L, L),
        (): &(),
    ) -> BlockStress<L> {
        let (first_piola, volume_change) = self.first_piola(h);
        BlockStress { first_piola, volume_change, amplitudes: Amplitudes::new(pulled_back, 1.0) }
    }
}

impl ElasticLaw for NeoHooke {
    fn shear(&self) -> f64 {
        self.shear
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> (AxisymmetricTensor<L>, L) {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.first_piola(h)
    }

    #[inline(always)]
    fn energy<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> L {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.energy(h).0
    }
}

/// Any law by its name, which is selected once per block.
impl ElasticLaw for Hyperelastic {
    fn shear(&self) -> f64 {
        self.shear_modulus()
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> (AxisymmetricTensor<L>, L) {
        self.first_piola_unchecked(h)
    }

    #[inline(always)]
    fn energy<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> L {
        self.energy_unchecked(h)
    }
}

/// A law that relaxes.
#[derive(Debug, Clone)]
pub(super) struct RelaxingLaw {
    branches: Branches,
    shear: f64,
    weights: Vec<f64>,
    equilibrium_weight: f64,
}

impl RelaxingLaw {
    /// Takes a solid, its instantaneous shear modulus (Pa) and its series.
    pub fn of(solid: &Viscoelastic, shear: f64, series: &PronySeries) -> Self {
        let weights = series.terms().iter().map(|term| term.weight).collect();
        let equilibrium_weight = series.equilibrium_weight();
        Self { branches: solid.branches().clone(), shear, weights, equilibrium_weight }
    }
}

impl RelaxingLaw {
    /// Returns the weights of the relaxation terms.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Returns the weight of the part that does not relax.
    pub fn equilibrium_weight(&self) -> f64 {
        self.equilibrium_weight
    }

    /// Returns the stress with internal variables of up to `MOST` terms.
    #[inline(always)]
    pub fn stress_of<L: Lanes<WIDE>, const MOST: usize>(
        &self,
        h: &AxisymmetricTensor<L>,
        pulled_back: (L, L),
        internal: &InternalVariables<L, MOST>,
    ) -> BlockStress<L> {
        let metrics = internal.metrics[..self.weights.len()].iter().copied();
        let (first_piola, volume_change) = self.branches.first_piola(h, metrics);
        let mut amplitudes = Amplitudes::new(pulled_back, self.equilibrium_weight);
        for (term, &weight) in self.weights.iter().enumerate() {
            amplitudes.add_term(weight, internal.amplitudes[term]);
        }
        BlockStress { first_piola, volume_change, amplitudes }
    }
}

impl Law for RelaxingLaw {
    type Internal<L: Lanes<WIDE>> = InternalVariables<L>;

    fn shear(&self) -> f64 {
        self.shear
    }

    fn n_fields(&self) -> usize {
        FIELDS_PER_TERM * self.weights.len()
    }

    #[inline(always)]
    fn undeformed<L: Lanes<WIDE>>(&self) -> InternalVariables<L> {
        InternalVariables::none()
    }

    #[inline(always)]
    fn load<L: Lanes<WIDE>>(
        &self,
        internal: &mut InternalVariables<L>,
        history: &[NodalField],
        slots: Slots,
    ) {
        internal.load(self.weights.len(), history, slots);
    }

    #[inline(always)]
    fn stress<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        pulled_back: (L, L),
        internal: &InternalVariables<L>,
    ) -> BlockStress<L> {
        self.stress_of(h, pulled_back, internal)
    }
}
