//! Kinematics of a deformation: the left Cauchy-Green tensor b, or that of an elastic part, as b −
//! 1, and the conversion of Kirchhoff's stress to the first Piola-Kirchhoff stress.

use super::number::Number;
use super::tensor::{AxisymmetricTensor, SymmetricTensor};

/// Strain in the deformed body and change of volume: b − 1 and J − 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strain<N = f64> {
    pub left: SymmetricTensor<N>,
    pub volume_change: N,
}

impl<N: Number> Strain<N> {
    /// Computes the strain of a displacement gradient.
    #[inline(always)]
    pub fn of(h: &AxisymmetricTensor<N>) -> Self {
        Self { left: h.left_strain(), volume_change: h.volume_change() }
    }
}

/// Returns F A Fᵀ for a symmetric A, F = 1 + H.
#[inline(always)]
pub(super) fn push_forward<N: Number>(
    a: &SymmetricTensor<N>,
    h: &AxisymmetricTensor<N>,
) -> SymmetricTensor<N> {
    let one = N::splat(1.0);
    let (f_rr, f_yy, f_tt) = (one + h.rr, one + h.yy, one + h.tt);
    // F A, row by row.
    let (rr, ry) = ((f_rr * a.rr).plus_product(h.ry, a.ry), (f_rr * a.ry).plus_product(h.ry, a.yy));
    let (yr, yy) = ((h.yr * a.rr).plus_product(f_yy, a.ry), (h.yr * a.ry).plus_product(f_yy, a.yy));
    SymmetricTensor {
        rr: (rr * f_rr).plus_product(ry, h.ry),
        yy: (yr * h.yr).plus_product(yy, f_yy),
        tt: f_tt * a.tt * f_tt,
        ry: (rr * h.yr).plus_product(ry, f_yy),
    }
}

/// Returns P = τ F^{-T} for Kirchhoff's stress τ, where F = 1 + H, and 1/J.
#[inline(always)]
pub(super) fn first_piola<N: Number>(
    kirchhoff: &SymmetricTensor<N>,
    h: &AxisymmetricTensor<N>,
    inverse_jacobian: N,
) -> AxisymmetricTensor<N> {
    let one = N::splat(1.0);
    let SymmetricTensor { rr, yy, tt, ry } = *kirchhoff;
    let (f_rr, f_yy, f_tt) = (one + h.rr, one + h.yy, one + h.tt);
    // F^{-T} is the cofactors of F over J.
    let out = f_tt * inverse_jacobian;
    let area = (f_rr * f_yy).minus_product(h.ry, h.yr);
    AxisymmetricTensor {
        rr: (rr * f_yy).minus_product(ry, h.ry) * out,
        ry: (ry * f_rr).minus_product(rr, h.yr) * out,
        yr: (ry * f_yy).minus_product(yy, h.ry) * out,
        yy: (yy * f_rr).minus_product(ry, h.yr) * out,
        tt: tt * (area * inverse_jacobian),
    }
}
