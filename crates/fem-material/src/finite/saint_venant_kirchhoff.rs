//! St Venant and Kirchhoff: Hooke's law of Green's strain.
//!
//! ```math
//! W = \frac\lambda2 (\mathrm{tr}\, E)^2 + G\, E:E, \qquad E = \tfrac12 (F^T F - 1), \qquad
//! \tau = \tfrac\lambda2 \mathrm{tr}(b-1)\, b + G\, b\,(b - 1)
//! ```
//!
//! (Ogden 1984, Non-linear Elastic Deformations; Ciarlet 1988, Mathematical Elasticity I, sections
//! 3.9 and 4.10). Programs that use Hooke's moduli with large rotations implement this law.
//!
//! Limits: it softens in compression and does not resist inversion. Under uniform pressure the
//! resistance to shear, S + G λ², is gone at λ² = 1/(1 + 2G/3K), where the pressure is G λ: at
//! J = 0.54, 0.67, 0.90 and 0.99 for ν = 0.2, 0.3, 0.45 and 0.495. In uniaxial strain the law loses
//! ellipticity at F = 0.64, 0.71, 0.91 and 0.99. A mesh collapses from there on. The law is for
//! comparison, at strains of some per cent.

use super::kinematics::Strain;
use super::number::Number;
use super::principal::Response;
use super::tensor::SymmetricTensor;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct SaintVenantKirchhoff {
    pub bulk: f64,
    pub shear: f64,
}

impl SaintVenantKirchhoff {
    /// Returns Lamé's λ.
    #[inline(always)]
    fn lambda(&self) -> f64 {
        self.bulk - 2.0 / 3.0 * self.shear
    }

    /// Returns the energy; Green's strain has the invariants of ½ (b − 1).
    #[inline(always)]
    pub fn energy<N: Number>(&self, strain: &Strain<N>) -> N {
        let (trace, squares) = (strain.left.trace(), strain.left.dot(&strain.left));
        N::splat(0.125 * self.lambda()) * (trace * trace) + N::splat(0.25 * self.shear) * squares
    }

    #[inline(always)]
    pub fn kirchhoff<N: Number>(&self, strain: &Strain<N>) -> SymmetricTensor<N> {
        let SymmetricTensor { rr, yy, tt, ry } = strain.left;
        let half = N::splat(0.5 * self.lambda()) * (rr + yy + tt);
        let shear = N::splat(self.shear);
        // b (λ/2 tr(b − 1) + G (b − 1)) = s + (b − 1) s of the bracket s.
        let (s_rr, s_yy) = (half.plus_product(shear, rr), half.plus_product(shear, yy));
        let (s_tt, s_ry) = (half.plus_product(shear, tt), shear * ry);
        SymmetricTensor {
            rr: s_rr.plus_product(rr, s_rr).plus_product(ry, s_ry),
            yy: s_yy.plus_product(yy, s_yy).plus_product(ry, s_ry),
            tt: s_tt.plus_product(tt, s_tt),
            ry: s_ry.plus_product(rr, s_ry).plus_product(ry, s_yy),
        }
    }

    /// Returns τ_i and ∂τ_i/∂ln λ_j at principal stretches.
    pub fn principal(&self, stretches: [f64; 3]) -> Response {
        let b = stretches.map(|stretch| stretch * stretch);
        let half = 0.5 * self.lambda() * (b.iter().sum::<f64>() - 3.0);
        Response::new(
            |i| b[i] * (half + self.shear * (b[i] - 1.0)),
            |i, j| {
                let own = half + self.shear * (2.0 * b[i] - 1.0);
                self.lambda() * b[i] * b[j] + if i == j { 2.0 * b[i] * own } else { 0.0 }
            },
        )
    }
}
