//! Neo-Hooke with a volume of its own, the default beyond Hooke.
//!
//! ```math
//! W = \frac G2 \left(J^{-2/3} \mathrm{tr}\, b - 3\right) + \frac K2 (J-1)^2, \qquad
//! \tau = G J^{-2/3}\, \mathrm{dev}\, b + K J (J-1)\, 1, \qquad P = \tau F^{-T}
//! ```
//!
//! with b = F Fᵀ (Simo & Hughes 1998, Computational Inelasticity, eqs. 9.2.3-9.2.6, with another
//! volume term). Written over [`Number`], without a branch.

use super::number::{Number, inverse_cube_root};
use super::tensor::AxisymmetricTensor;

/// The default law, on one number or several side by side.
#[derive(Debug, Clone, Copy)]
pub struct NeoHooke<N = f64> {
    /// Bulk modulus K, Pa.
    pub bulk: N,
    /// Shear modulus G, Pa.
    pub shear: N,
}

impl<N: Number> NeoHooke<N> {
    /// First Piola-Kirchhoff stress, Pa, of the displacement gradient, and J − 1.
    ///
    /// The stress means something where J − 1 > −1. The caller has to look: nothing here stops.
    #[inline(always)]
    pub fn first_piola(&self, h: &AxisymmetricTensor<N>) -> (AxisymmetricTensor<N>, N) {
        let one = N::splat(1.0);
        let volume_change = h.volume_change();
        let jacobian = one + volume_change;
        let y = inverse_cube_root(jacobian);
        let y_y = y * y;
        let g = h.left_strain();
        let scale = self.shear * y_y;
        let mean = self.bulk * volume_change * jacobian - scale * (g.trace() * N::splat(1.0 / 3.0));
        let (rr, yy) = (mean + scale * g.rr, mean + scale * g.yy);
        let (tt, ry) = (mean + scale * g.tt, scale * g.ry);

        // F^{-T} is the cofactors of F over J.
        let (f_rr, f_yy, f_tt) = (one + h.rr, one + h.yy, one + h.tt);
        let inverse = y_y * y;
        let out = f_tt * inverse;
        let area = f_rr * f_yy - h.ry * h.yr;
        let stress = AxisymmetricTensor {
            rr: (rr * f_yy - ry * h.ry) * out,
            ry: (ry * f_rr - rr * h.yr) * out,
            yr: (ry * f_yy - yy * h.ry) * out,
            yy: (yy * f_rr - ry * h.yr) * out,
            tt: tt * (area * inverse),
        };
        (stress, volume_change)
    }

    /// Energy per undeformed volume, J/m³, of the displacement gradient, and J − 1.
    #[inline(always)]
    pub fn energy(&self, h: &AxisymmetricTensor<N>) -> (N, N) {
        let one = N::splat(1.0);
        let three = N::splat(3.0);
        let volume_change = h.volume_change();
        let jacobian = one + volume_change;
        // J^{-1/3} − 1 to its own last digit: one more step of Newton's, on the difference.
        let z = inverse_cube_root(jacobian) - one;
        let cube = z * (three + three * z + z * z);
        let z = z - (one + z) * (volume_change + jacobian * cube) * N::splat(1.0 / 3.0);
        let w = z + z + z * z;
        let trace = h.left_strain().trace();
        let shape = trace + (three + trace) * w;
        let half = N::splat(0.5);
        (half * (self.shear * shape + self.bulk * volume_change * volume_change), volume_change)
    }
}
