//! The stress of all Maxwell branches of a law at once, on one number or on lanes.
//!
//! [`Viscoelastic`](super::Viscoelastic) treats the branches one by one. Together they cost less: terms that are
//! linear in C̄_v⁻¹ are summed in the undeformed body and transformed to the deformed one once.

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
    /// Bulk modulus, Pa.
    pub(super) bulk: f64,
    /// Shear modulus, Pa.
    pub(super) shear: f64,
    pub(super) equilibrium_weight: f64,
    pub(super) weights: Vec<f64>,
    pub(super) volume_flows: bool,
}

impl Branches {
    /// Returns the first Piola-Kirchhoff stress, Pa, and J − 1, for a displacement gradient and one inverse metric per
    /// term. It is valid where J − 1 > −1, which the caller has to check.
    #[inline(always)]
    pub fn first_piola<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        past: impl Iterator<Item = InverseMetric<N>>,
    ) -> (AxisymmetricTensor<N>, N) {
        let strain = Strain::of(h);
        // The hourglass energy of an element needs this root for every law.
        let y = inverse_cube_root(N::splat(1.0) + strain.volume_change);
        (first_piola(&self.kirchhoff(h, &strain, past), h, y * y * y), strain.volume_change)
    }

    /// Returns Kirchhoff's stress, Pa.
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
