//! Tensors of a body of revolution that does not twist.

use std::ops::{Add, Mul, Sub};

/// A tensor with four components in the meridian plane and one along the hoop: a displacement
/// gradient, a deformation gradient, a first Piola-Kirchhoff stress.
///
/// Of a gradient the first index is the displacement, the second the coordinate of the undeformed
/// body: `ry` is ∂u_r/∂Y. The hoop component of a displacement gradient is u_r/R.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisymmetricTensor<N = f64> {
    /// Radial, radial.
    pub rr: N,
    /// Radial, axial.
    pub ry: N,
    /// Axial, radial.
    pub yr: N,
    /// Axial, axial.
    pub yy: N,
    /// Hoop, hoop.
    pub tt: N,
}

/// A symmetric tensor of such a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SymmetricTensor<N = f64> {
    /// Radial, radial.
    pub rr: N,
    /// Axial, axial.
    pub yy: N,
    /// Hoop, hoop.
    pub tt: N,
    /// Radial, axial; the tensor's component, not the engineering one.
    pub ry: N,
}

impl<N: Copy + Add<Output = N> + Sub<Output = N> + Mul<Output = N>> AxisymmetricTensor<N> {
    /// det(1 + H) − 1 of a displacement gradient H: the relative change of volume, without the
    /// digits that det F − 1 would lose at small strain.
    #[inline(always)]
    pub fn volume_change(&self) -> N {
        let area = self.rr + self.yy + (self.rr * self.yy - self.ry * self.yr);
        area + self.tt + area * self.tt
    }

    /// b − 1 = H + Hᵀ + H Hᵀ of a displacement gradient H, with b the left Cauchy-Green tensor.
    #[inline(always)]
    pub fn left_strain(&self) -> SymmetricTensor<N> {
        let Self { rr, ry, yr, yy, tt } = *self;
        SymmetricTensor {
            rr: (rr + rr) + (rr * rr + ry * ry),
            yy: (yy + yy) + (yy * yy + yr * yr),
            tt: (tt + tt) + tt * tt,
            ry: (ry + yr) + (rr * yr + ry * yy),
        }
    }

    /// C − 1 = H + Hᵀ + Hᵀ H of a displacement gradient H, with C the right Cauchy-Green tensor.
    #[inline(always)]
    pub fn right_strain(&self) -> SymmetricTensor<N> {
        let Self { rr, ry, yr, yy, tt } = *self;
        SymmetricTensor {
            rr: (rr + rr) + (rr * rr + yr * yr),
            yy: (yy + yy) + (yy * yy + ry * ry),
            tt: (tt + tt) + tt * tt,
            ry: (ry + yr) + (rr * ry + yr * yy),
        }
    }
}

impl<N: Copy + Add<Output = N> + Mul<Output = N>> SymmetricTensor<N> {
    /// Each component times a factor.
    #[inline(always)]
    pub fn times(&self, factor: N) -> Self {
        Self {
            rr: self.rr * factor,
            yy: self.yy * factor,
            tt: self.tt * factor,
            ry: self.ry * factor,
        }
    }

    /// (1 + A)(1 + w) − 1 of A.
    #[inline(always)]
    pub(super) fn rescaled(&self, w: N) -> Self {
        Self {
            rr: self.rr + (w + w * self.rr),
            yy: self.yy + (w + w * self.yy),
            tt: self.tt + (w + w * self.tt),
            ry: self.ry + w * self.ry,
        }
    }

    /// The sum of both.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            rr: self.rr + other.rr,
            yy: self.yy + other.yy,
            tt: self.tt + other.tt,
            ry: self.ry + other.ry,
        }
    }

    /// A : B.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> N {
        let shear = self.ry * other.ry;
        self.rr * other.rr + self.yy * other.yy + self.tt * other.tt + (shear + shear)
    }

    /// Sum of the normal components.
    #[inline(always)]
    pub fn trace(&self) -> N {
        self.rr + self.yy + self.tt
    }
}
