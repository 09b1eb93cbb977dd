//! Stress and energy of a law on lanes.
//!
//! All laws run on all lanes at once. The default law has loops of its own; in those of the others the
//! law is asked for block by block, which costs nothing that could be measured.

use std::fmt::Debug;

use fem_material::PronySeries;
use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, NeoHooke, RelaxingNeoHooke, Viscoelastic, ViscousStrain,
};

use super::super::lanes::{Lanes, WIDE};

/// A law per undeformed volume, of a displacement gradient and of what its terms of relaxation remember.
pub(super) trait Law: Debug + Send + Sync + 'static {
    /// Instantaneous shear modulus of small strain, Pa.
    fn shear(&self) -> f64;

    /// Weights of the terms of relaxation.
    #[inline(always)]
    fn weights(&self) -> &[f64] {
        &[]
    }

    /// What does not relax.
    #[inline(always)]
    fn equilibrium_weight(&self) -> f64 {
        1.0
    }

    /// First Piola-Kirchhoff stress (Pa), and J − 1. The stress means something where J − 1 > −1.
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L);
}

/// A law that does not relax.
pub(super) trait ElasticLaw: Law {
    /// Stored energy, J/m³.
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
        _: &[ViscousStrain<L>],
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

/// Any law by its name, which is asked once a block.
impl Law for Hyperelastic {
    fn shear(&self) -> f64 {
        self.shear_modulus()
    }

    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        _: &[ViscousStrain<L>],
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

/// A law that relaxes, W the law that computes its stress.
#[derive(Debug, Clone)]
pub(super) struct Relaxing<W> {
    law: W,
    shear: f64,
    weights: Vec<f64>,
    equilibrium_weight: f64,
}

impl<W> Relaxing<W> {
    /// Of a law with an instantaneous shear modulus (Pa) and a series.
    pub fn of(law: W, shear: f64, series: &PronySeries) -> Self {
        let weights = series.terms().iter().map(|term| term.weight).collect();
        Self { law, shear, weights, equilibrium_weight: series.equilibrium_weight() }
    }
}

/// The stress of a point of a law that relaxes.
pub(super) trait PointLaw: Debug + Send + Sync + 'static {
    /// As [`Law::first_piola`].
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L);
}

impl PointLaw for RelaxingNeoHooke {
    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.first_piola(h, past)
    }
}

/// Any law by its name.
impl PointLaw for Viscoelastic {
    #[inline(always)]
    fn first_piola<L: Lanes<WIDE>>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.first_piola_unchecked(h, past)
    }
}

impl<W: PointLaw> Law for Relaxing<W> {
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
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.law.first_piola(h, past)
    }
}
