//! Tensors of a body of revolution that does not twist.

use super::number::Number;

/// A tensor with four components in the meridian plane and one along the hoop: a displacement
/// gradient, a deformation gradient, a first Piola-Kirchhoff stress.
///
/// In a gradient the first index is the displacement, the second the coordinate of the undeformed
/// body: `ry` is ∂u_r/∂Y. The hoop component of a displacement gradient is u_r/R.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisymmetricTensor<N = f64> {
    /// Radial normal component.
    pub rr: N,
    /// Radial component along the axial coordinate.
    pub ry: N,
    /// Axial component along the radial coordinate.
    pub yr: N,
    /// Axial normal component.
    pub yy: N,
    /// Hoop normal component.
    pub tt: N,
}

/// A symmetric tensor of such a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SymmetricTensor<N = f64> {
    /// Radial normal component.
    pub rr: N,
    /// Axial normal component.
    pub yy: N,
    /// Hoop normal component.
    pub tt: N,
    /// Component ry; that of the tensor, not the engineering one.
    pub ry: N,
}

impl<N: Number> AxisymmetricTensor<N> {
    /// Returns the transposed tensor.
    #[inline(always)]
    pub(super) fn transposed(&self) -> Self {
        Self { ry: self.yr, yr: self.ry, ..*self }
    }

    /// Returns det(1 + H) − 1 of a displacement gradient H: the relative change of volume, without the
    /// digits that det F − 1 would lose at small strain.
    #[inline(always)]
    pub fn volume_change(&self) -> N {
        let area =
            (self.rr + self.yy).plus_product(self.rr, self.yy).minus_product(self.ry, self.yr);
        (area + self.tt).plus_product(area, self.tt)
    }

    /// Returns b − 1 = H + Hᵀ + H Hᵀ of a displacement gradient H, with b the left Cauchy-Green tensor.
    #[inline(always)]
    pub fn left_strain(&self) -> SymmetricTensor<N> {
        let Self { rr, ry, yr, yy, tt } = *self;
        SymmetricTensor {
            rr: (rr + rr).plus_product(rr, rr).plus_product(ry, ry),
            yy: (yy + yy).plus_product(yy, yy).plus_product(yr, yr),
            tt: (tt + tt).plus_product(tt, tt),
            ry: (ry + yr).plus_product(rr, yr).plus_product(ry, yy),
        }
    }

    /// Returns C − 1 = H + Hᵀ + Hᵀ H of a displacement gradient H, with C the right Cauchy-Green tensor.
    #[inline(always)]
    pub fn right_strain(&self) -> SymmetricTensor<N> {
        let Self { rr, ry, yr, yy, tt } = *self;
        SymmetricTensor {
            rr: (rr + rr).plus_product(rr, rr).plus_product(yr, yr),
            yy: (yy + yy).plus_product(yy, yy).plus_product(ry, ry),
            tt: (tt + tt).plus_product(tt, tt),
            ry: (ry + yr).plus_product(rr, ry).plus_product(yr, yy),
        }
    }
}

impl<N: Number> SymmetricTensor<N> {
    /// Returns each component times a factor.
    #[inline(always)]
    pub fn times(&self, factor: N) -> Self {
        Self {
            rr: self.rr * factor,
            yy: self.yy * factor,
            tt: self.tt * factor,
            ry: self.ry * factor,
        }
    }

    /// Returns (1 + A)(1 + w) − 1 of A.
    #[inline(always)]
    pub(super) fn rescaled(&self, w: N) -> Self {
        Self {
            rr: self.rr + w.plus_product(w, self.rr),
            yy: self.yy + w.plus_product(w, self.yy),
            tt: self.tt + w.plus_product(w, self.tt),
            ry: self.ry.plus_product(w, self.ry),
        }
    }

    /// Returns the sum with a multiple of another tensor.
    #[inline(always)]
    pub(super) fn plus_multiple(&self, factor: N, other: &Self) -> Self {
        Self {
            rr: self.rr.plus_product(factor, other.rr),
            yy: self.yy.plus_product(factor, other.yy),
            tt: self.tt.plus_product(factor, other.tt),
            ry: self.ry.plus_product(factor, other.ry),
        }
    }

    /// Returns the sum of both tensors.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            rr: self.rr + other.rr,
            yy: self.yy + other.yy,
            tt: self.tt + other.tt,
            ry: self.ry + other.ry,
        }
    }

    /// Returns A : B.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> N {
        let shear = self.ry * other.ry;
        (shear + shear)
            .plus_product(self.rr, other.rr)
            .plus_product(self.yy, other.yy)
            .plus_product(self.tt, other.tt)
    }

    /// Returns the sum of the normal components.
    #[inline(always)]
    pub fn trace(&self) -> N {
        self.rr + self.yy + self.tt
    }
}
