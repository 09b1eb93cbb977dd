//! Stress and energy of a law on lanes.
//!
//! All laws run on all lanes at once. The default law has loops of its own where it does not relax. In all others the law
//! is selected block by block, at no measurable cost.

use std::fmt::Debug;

use fem_material::PronySeries;
use fem_material::finite::{
    AxisymmetricTensor, Branches, Hyperelastic, InverseMetric, NeoHooke, Viscoelastic,
};

use crate::lanes::{Lanes, WIDE};

/// A law per undeformed volume: the stress as a function of the displacement gradient and of internal variables.
pub(super) trait Law: Debug + Send + Sync + 'static {
    /// Returns the instantaneous shear modulus at small strain, Pa.
    fn shear(&self) -> f64;

    /// Returns the weights of the relaxation terms.
    #[inline(always)]
    fn weights(&self) -> &[f64] {
        &[]
    }

    /// Returns the weight of the part that does not relax.
    #[inline(always)]
    fn equilibrium_weight(&self) -> f64 {
        1.0
    }

    /// Returns the first Piola–Kirchhoff stress (Pa), and J − 1. The stress has a meaning where J − 1 > −1.
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        metrics: &[InverseMetric<L>],
    ) -> (AxisymmetricTensor<L>, L);
}

/// A law that does not relax.
pub(super) trait ElasticLaw: Law {
    /// Returns the stored energy, J/m³.
    fn energy<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> L;
}

impl Law for NeoHooke {
    fn shear(&self) -> f64 {
        self.shear
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        _: &[InverseMetric<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.first_piola(h)
    }
}

impl ElasticLaw for NeoHooke {
    #[inline(always)]
    fn energy<L: Lanes<WIDE>>(&self, h: &AxisymmetricTensor<L>) -> L {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.energy(h).0
    }
}

/// Any law by its name, which is selected once per block.
impl Law for Hyperelastic {
    fn shear(&self) -> f64 {
        self.shear_modulus()
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        _: &[InverseMetric<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.first_piola_unchecked(h)
    }
}

impl ElasticLaw for Hyperelastic {
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

impl Law for RelaxingLaw {
    fn shear(&self) -> f64 {
        self.shear
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn equilibrium_weight(&self) -> f64 {
        self.equilibrium_weight
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        metrics: &[InverseMetric<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.branches.first_piola(h, metrics.iter().copied())
    }
}
