//! Stress and energy of a law on lanes.
//!
//! The default law runs on all lanes at once. Any other runs lane by lane.

use std::fmt::Debug;

use fem_material::PronySeries;
use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, NeoHooke, RelaxingNeoHooke, Viscoelastic, ViscousStrain,
};

use super::super::lanes::{LANES, Lanes};
use super::past::MOST_FINITE_STRAIN_TERMS;

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
    fn first_piola<L: Lanes>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L);
}

/// A law that does not relax.
pub(super) trait ElasticLaw: Law {
    /// Stored energy, J/m³.
    fn energy<L: Lanes>(&self, h: &AxisymmetricTensor<L>) -> L;
}

impl Law for NeoHooke {
    fn shear(&self) -> f64 {
        self.shear
    }

    #[inline(always)]
    fn first_piola<L: Lanes>(
        &self,
        h: &AxisymmetricTensor<L>,
        _: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.first_piola(h)
    }
}

impl ElasticLaw for NeoHooke {
    #[inline(always)]
    fn energy<L: Lanes>(&self, h: &AxisymmetricTensor<L>) -> L {
        NeoHooke { bulk: L::splat(self.bulk), shear: L::splat(self.shear) }.energy(h).0
    }
}

/// Any law, one lane after the other.
impl Law for Hyperelastic {
    fn shear(&self) -> f64 {
        self.shear_modulus()
    }

    #[inline(always)]
    fn first_piola<L: Lanes>(
        &self,
        h: &AxisymmetricTensor<L>,
        _: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        let gradients = unpacked(h);
        // What is inside out has no stress, and is told by its J.
        let mut stresses = [AxisymmetricTensor::default(); LANES];
        for lane in 0..LANES {
            if let Ok(stress) = Hyperelastic::first_piola(self, &gradients[lane]) {
                stresses[lane] = stress;
            }
        }
        (packed(&stresses), h.volume_change())
    }
}

impl ElasticLaw for Hyperelastic {
    #[inline(always)]
    fn energy<L: Lanes>(&self, h: &AxisymmetricTensor<L>) -> L {
        let gradients = unpacked(h);
        let mut energies = [0.0; LANES];
        for lane in 0..LANES {
            energies[lane] = Hyperelastic::energy(self, &gradients[lane]).unwrap_or(f64::NAN);
        }
        L::load(&energies)
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

impl Law for Relaxing<RelaxingNeoHooke> {
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
    fn first_piola<L: Lanes>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        self.law.first_piola(h, past)
    }
}

/// Any law, one lane after the other.
impl Law for Relaxing<Viscoelastic> {
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
    fn first_piola<L: Lanes>(
        &self,
        h: &AxisymmetricTensor<L>,
        past: &[ViscousStrain<L>],
    ) -> (AxisymmetricTensor<L>, L) {
        let gradients = unpacked(h);
        let mut strains = [[ViscousStrain::default(); MOST_FINITE_STRAIN_TERMS]; LANES];
        for (term, strain) in past.iter().enumerate() {
            let (rr, yy) = (strain.rr.to_array(), strain.yy.to_array());
            let (ry, volume_change) = (strain.ry.to_array(), strain.volume_change.to_array());
            for lane in 0..LANES {
                strains[lane][term] = ViscousStrain {
                    rr: rr[lane],
                    yy: yy[lane],
                    ry: ry[lane],
                    volume_change: volume_change[lane],
                };
            }
        }
        // What is inside out has no stress, and is told by its J.
        let mut stresses = [AxisymmetricTensor::default(); LANES];
        for lane in 0..LANES {
            let past = &strains[lane][..past.len()];
            if let Ok(stress) = self.law.first_piola(&gradients[lane], past) {
                stresses[lane] = stress;
            }
        }
        (packed(&stresses), h.volume_change())
    }
}

/// The tensor of each lane.
#[inline(always)]
fn unpacked<L: Lanes>(tensor: &AxisymmetricTensor<L>) -> [AxisymmetricTensor; LANES] {
    let (rr, ry, yr) = (tensor.rr.to_array(), tensor.ry.to_array(), tensor.yr.to_array());
    let (yy, tt) = (tensor.yy.to_array(), tensor.tt.to_array());
    let mut tensors = [AxisymmetricTensor::default(); LANES];
    for k in 0..LANES {
        tensors[k] = AxisymmetricTensor { rr: rr[k], ry: ry[k], yr: yr[k], yy: yy[k], tt: tt[k] };
    }
    tensors
}

/// The tensors of all lanes as one.
#[inline(always)]
fn packed<L: Lanes>(tensors: &[AxisymmetricTensor; LANES]) -> AxisymmetricTensor<L> {
    let [mut rr, mut ry, mut yr, mut yy, mut tt] = [[0.0; LANES]; 5];
    for (k, tensor) in tensors.iter().enumerate() {
        (rr[k], ry[k], yr[k]) = (tensor.rr, tensor.ry, tensor.yr);
        (yy[k], tt[k]) = (tensor.yy, tensor.tt);
    }
    AxisymmetricTensor {
        rr: L::load(&rr),
        ry: L::load(&ry),
        yr: L::load(&yr),
        yy: L::load(&yy),
        tt: L::load(&tt),
    }
}
