//! Branches of Hencky's law. The deviator of ln b_e does not depend on J_v, so with b_k = F C̄_v,k⁻¹ Fᵀ
//!
//! ```math
//! \tau = K \Bigl[\ln J - \sum_k g_k \ln J_{v,k}\Bigr] 1 + 2G\,\mathrm{dev}\, h, \qquad
//! h = \tfrac12 \Bigl[g_\infty \ln b + \sum_k g_k \ln b_k\Bigr]
//! ```
//!
//! without the terms of J_v where the volume is elastic. All b_k have the determinant J², so the hoop of h
//! is known from ln F_θθ and those of C̄_v,k⁻¹, and its meridian trace from that. Its meridian deviator is
//! the sum of (artanh y_k/y_k)/(m_k + s_k) times that of b_k ([`super::super::hencky`]), linear in
//! C̄_v,k⁻¹, with the mean m_k = ½ tr(C C̄_v,k⁻¹) and the root s_k of the determinant in the meridian.

use super::super::hencky::meridian_factor;
use super::super::kinematics::{Strain, push_forward};
use super::super::logarithm::ln_of_one_plus;
use super::super::number::Number;
use super::super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::super::viscous::InverseMetric;
use super::Branches;

#[inline(always)]
pub(super) fn kirchhoff<N: Number>(
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
