//! Branches of Hencky's law. The deviator of ln b_e does not see J_v, so with b_k = F C̄_v,k⁻¹ Fᵀ
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
use super::super::kinematics::Strain;
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
    let area = f_rr * f_yy - h.ry * h.yr;
    let right = h.right_strain();
    let mean_of_whole = one + half * (right.rr + right.yy);
    let ln_jacobian = ln_of_one_plus(volume_change);

    let (mut volumetric, mut hoop) = (ln_jacobian, ln_of_one_plus(h.tt));
    let mut factors = meridian_factor(mean_of_whole, area) * N::splat(branches.equilibrium_weight);
    let (mut rr, mut yy, mut ry) = (zero, zero, zero);
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        let shape = &viscous.shape;
        let off = (one + right.rr) * shape.rr + (one + right.yy) * shape.yy;
        let mean = mean_of_whole + (half * off + right.ry * shape.ry);
        let root = area * (one + viscous.hoop).sqrt();
        let factor = weight * meridian_factor(mean, root);
        factors = factors + factor;
        (rr, yy, ry) = (rr + factor * shape.rr, yy + factor * shape.yy, ry + factor * shape.ry);
        hoop = hoop + weight * (half * ln_of_one_plus(shape.tt));
        if branches.volume_flows {
            volumetric = volumetric - weight * ln_of_one_plus(viscous.volume_change);
        }
    }
    // Meridian deviator of the sum of factors times b_k.
    let (row_rr, row_ry) = (f_rr * rr + h.ry * ry, f_rr * ry + h.ry * yy);
    let (row_yr, row_yy) = (h.yr * rr + f_yy * ry, h.yr * ry + f_yy * yy);
    let difference = (row_rr * f_rr + row_ry * h.ry) - (row_yr * h.yr + row_yy * f_yy);
    let deviator = half * (factors * (left.rr - left.yy) + difference);
    let off = factors * left.ry + (row_rr * h.yr + row_ry * f_yy);

    let two_g = N::splat(2.0 * branches.shear);
    let third = ln_jacobian * N::splat(1.0 / 3.0);
    let pull = N::splat(branches.bulk) * volumetric;
    let mean = half * (ln_jacobian - hoop) - third;
    SymmetricTensor {
        rr: pull + two_g * (mean + deviator),
        yy: pull + two_g * (mean - deviator),
        tt: pull + two_g * (hoop - third),
        ry: two_g * off,
    }
}
