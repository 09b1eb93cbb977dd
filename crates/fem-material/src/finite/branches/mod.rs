//! The stress of all Maxwell branches of a law at once, on one number or several side by side.
//!
//! [`Viscoelastic`](super::Viscoelastic) is what they are one by one. Together they cost less: what is
//! linear in C̄_v⁻¹ is summed in the undeformed body and brought to the deformed one once.

mod hencky;
mod neo_hooke;
mod neo_hooke_ln;
mod saint_venant_kirchhoff;

use super::hyperelastic::HyperelasticLaw;
use super::kinematics::{Strain, first_piola};
use super::number::{Number, inverse_cube_root};
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::viscous::InverseMetric;

/// A law, its instantaneous moduli and the weights of its branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Branches {
    pub(super) law: HyperelasticLaw,
    /// Pa.
    pub(super) bulk: f64,
    /// Pa.
    pub(super) shear: f64,
    pub(super) equilibrium_weight: f64,
    pub(super) weights: Vec<f64>,
    pub(super) volume_flows: bool,
}

impl Branches {
    /// First Piola-Kirchhoff stress, Pa, and J − 1, of a displacement gradient and one entry a term; it
    /// means something where J − 1 > −1. The caller has to look: nothing here stops.
    #[inline(always)]
    pub fn first_piola<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        past: impl Iterator<Item = InverseMetric<N>>,
    ) -> (AxisymmetricTensor<N>, N) {
        let strain = Strain::of(h);
        // The hourglass shape of an element asks for this root of every law.
        let y = inverse_cube_root(N::splat(1.0) + strain.volume_change);
        (first_piola(&self.kirchhoff(h, &strain, past), h, y * y * y), strain.volume_change)
    }

    /// Kirchhoff's stress, Pa.
    #[inline(always)]
    pub(super) fn kirchhoff<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        strain: &Strain<N>,
        past: impl Iterator<Item = InverseMetric<N>>,
    ) -> SymmetricTensor<N> {
        match self.law {
            HyperelasticLaw::NeoHooke => neo_hooke::kirchhoff(self, h, strain, past),
            HyperelasticLaw::NeoHookeLn => neo_hooke_ln::kirchhoff(self, h, strain, past),
            HyperelasticLaw::Hencky => hencky::kirchhoff(self, h, strain, past),
            HyperelasticLaw::SaintVenantKirchhoff => {
                saint_venant_kirchhoff::kirchhoff(self, h, strain, past)
            }
        }
    }
}
