//! The stress of all Maxwell branches of a law at once, on one number or on lanes.
//!
//! [`Viscoelastic`](super::Viscoelastic) treats the branches one by one. Together they cost less: terms that are
//! linear in C̄_v⁻¹ are summed in the undeformed body and transformed to the deformed one once.

use super::hencky::meridian_factor;
use super::hyperelastic::HyperelasticLaw;
use super::kinematics::{Strain, first_piola, push_forward};
use super::logarithm::ln_of_one_plus;
use super::neo_hooke::NeoHooke;
use super::number::{Number, inverse_cube_root, inverse_cube_root_change};
use super::saint_venant_kirchhoff::SaintVenantKirchhoff;
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
            HyperelasticLaw::NeoHooke => neo_hooke(self, h, strain, past),
            HyperelasticLaw::NeoHookeLn => neo_hooke_ln(self, h, strain, past),
            HyperelasticLaw::Hencky => hencky(self, h, strain, past),
            HyperelasticLaw::SaintVenantKirchhoff => saint_venant_kirchhoff(self, h, strain, past),
        }
    }
}

/// Maxwell branches (one per Prony term) of the default law, whose deviatoric stress is linear in b̄_e:
///
/// ```math
/// \tau = G J^{-2/3}\, \mathrm{dev}\Bigl[F\Bigl(g_\infty 1 + \sum_k g_k \bar C_{v,k}^{-1}\Bigr) F^T\Bigr]
/// + p\,1, \qquad p = K \Bigl[g_\infty J (J-1) + \sum_k g_k J_{e,k} (J_{e,k} - 1)\Bigr]
/// ```
///
/// or p = K J (J − 1) where the volume is elastic.
#[inline(always)]
fn neo_hooke<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    &Strain { left, volume_change }: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let (zero, one) = (N::splat(0.0), N::splat(1.0));
    let law = NeoHooke { bulk: N::splat(branches.bulk), shear: N::splat(branches.shear) };
    let jacobian = one + volume_change;
    let mut flown = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
    let mut pull = volume_change * jacobian;
    if branches.volume_flows {
        pull = N::splat(branches.equilibrium_weight) * pull;
    }
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        flown = flown.plus_multiple(weight, &viscous.shape);
        if branches.volume_flows {
            let inverse = viscous.inverse_volume;
            let change = (volume_change - viscous.volume_change) * inverse;
            pull = pull.plus_product(weight * change, jacobian * inverse);
        }
    }
    let left = left.plus(&push_forward(&flown, h));
    let y = inverse_cube_root(jacobian);
    law.stress(&left, law.bulk * pull, y * y)
}

/// Branches of neo-Hooke with ln J, whose stress is linear in b_e and in ln J_e = ln J − ln J_v:
///
/// ```math
/// \tau = G \Bigl[F\Bigl(g_\infty 1 + \sum_k g_k J_{v,k}^{-2/3} \bar C_{v,k}^{-1}\Bigr) F^T - 1\Bigr]
/// + \lambda \Bigl[\ln J - \sum_k g_k \ln J_{v,k}\Bigr] 1
/// ```
///
/// without the terms of J_v where the volume is elastic.
#[inline(always)]
fn neo_hooke_ln<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    &Strain { left, volume_change }: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let zero = N::splat(0.0);
    let mut flown = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
    let (mut rescaled, mut ln) = (zero, ln_of_one_plus(volume_change));
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        let mut factor = weight;
        if branches.volume_flows {
            let z = inverse_cube_root_change(viscous.volume_change);
            let change = (z + z).plus_product(z, z);
            factor = weight.plus_product(weight, change);
            rescaled = rescaled.plus_product(weight, change);
            ln = ln.minus_product(weight, ln_of_one_plus(viscous.volume_change));
        }
        flown = flown.plus_multiple(factor, &viscous.shape);
    }
    let left = left.rescaled(rescaled).plus(&push_forward(&flown, h));
    let shear = N::splat(branches.shear);
    let mean = N::splat(branches.bulk - 2.0 / 3.0 * branches.shear) * ln;
    SymmetricTensor {
        rr: mean.plus_product(shear, left.rr),
        yy: mean.plus_product(shear, left.yy),
        tt: mean.plus_product(shear, left.tt),
        ry: shear * left.ry,
    }
}

/// Branches of Hencky's law. The deviator of ln b_e does not depend on J_v, so with b_k = F C̄_v,k⁻¹ Fᵀ
///
/// ```math
/// \tau = K \Bigl[\ln J - \sum_k g_k \ln J_{v,k}\Bigr] 1 + 2G\,\mathrm{dev}\, h, \qquad
/// h = \tfrac12 \Bigl[g_\infty \ln b + \sum_k g_k \ln b_k\Bigr]
/// ```
///
/// without the terms of J_v where the volume is elastic. All b_k have the determinant J², so the hoop of h
/// is known from ln F_θθ and those of C̄_v,k⁻¹, and its meridian trace from that. Its meridian deviator is
/// the sum of (artanh y_k/y_k)/(m_k + s_k) times that of b_k ([`super::hencky`]), linear in
/// C̄_v,k⁻¹, with the mean m_k = ½ tr(C C̄_v,k⁻¹) and the root s_k of the determinant in the meridian.
#[inline(always)]
fn hencky<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    &Strain { left, volume_change }: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let (zero, half, one) = (N::splat(0.0), N::splat(0.5), N::splat(1.0));
    let (f_rr, f_yy) = (one + h.rr, one + h.yy);
    let area = (f_rr * f_yy).minus_product(h.ry, h.yr);
    let right = h.right_strain();
    let mean_of_whole = one.plus_product(half, right.rr + right.yy);
    let ln_jacobian = ln_of_one_plus(volume_change);

    let (mut volumetric, mut hoop) = (ln_jacobian, ln_of_one_plus(h.tt));
    let mut factors = meridian_factor(mean_of_whole, area) * N::splat(branches.equilibrium_weight);
    let (mut rr, mut yy, mut ry) = (zero, zero, zero);
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        let shape = &viscous.shape;
        let normal =
            (shape.rr + shape.yy).plus_product(right.rr, shape.rr).plus_product(right.yy, shape.yy);
        let mean = mean_of_whole.plus_product(half, normal).plus_product(right.ry, shape.ry);
        let root = area * (one + viscous.hoop).sqrt();
        let factor = weight * meridian_factor(mean, root);
        factors = factors + factor;
        rr = rr.plus_product(factor, shape.rr);
        yy = yy.plus_product(factor, shape.yy);
        ry = ry.plus_product(factor, shape.ry);
        hoop = hoop.plus_product(half * weight, ln_of_one_plus(shape.tt));
        if branches.volume_flows {
            volumetric = volumetric.minus_product(weight, ln_of_one_plus(viscous.volume_change));
        }
    }
    // Meridian deviator of the sum of factors times b_k.
    let pushed = push_forward(&SymmetricTensor { rr, yy, tt: zero, ry }, h);
    let deviator = half * (pushed.rr - pushed.yy).plus_product(factors, left.rr - left.yy);
    let off = pushed.ry.plus_product(factors, left.ry);

    let two_g = N::splat(2.0 * branches.shear);
    let third = ln_jacobian * N::splat(1.0 / 3.0);
    let pull = N::splat(branches.bulk) * volumetric;
    let mean = half * (ln_jacobian - hoop) - third;
    SymmetricTensor {
        rr: pull.plus_product(two_g, mean + deviator),
        yy: pull.plus_product(two_g, mean - deviator),
        tt: pull.plus_product(two_g, hoop - third),
        ry: two_g * off,
    }
}

/// Branches of St Venant's and Kirchhoff's law, which is quadratic in b_e: the sum of the law of each.
#[inline(always)]
fn saint_venant_kirchhoff<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    strain: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let Branches { bulk, shear, equilibrium_weight, volume_flows, .. } = *branches;
    // Where the volume is elastic the branches have the part of the law that goes with G.
    let (of_bulk, lasting_bulk) =
        if volume_flows { (bulk, bulk * equilibrium_weight) } else { (0.0, bulk) };
    let lasting = SaintVenantKirchhoff { bulk: lasting_bulk, shear: shear * equilibrium_weight };
    let mut sum = lasting.kirchhoff(strain);
    for (&weight, viscous) in branches.weights.iter().zip(past) {
        let mut left = strain.left.plus(&push_forward(&viscous.shape, h));
        let mut volume_change = strain.volume_change;
        if volume_flows {
            let z = inverse_cube_root_change(viscous.volume_change);
            left = left.rescaled((z + z).plus_product(z, z));
            volume_change = (volume_change - viscous.volume_change) * viscous.inverse_volume;
        }
        let law = SaintVenantKirchhoff { bulk: weight * of_bulk, shear: weight * shear };
        sum = sum.plus(&law.kirchhoff(&Strain { left, volume_change }));
    }
    sum
}
