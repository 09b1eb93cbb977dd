//! Neo-Hooke with ln J.
//!
//! ```math
//! W = \frac G2 (\mathrm{tr}\, b - 3) - G \ln J + \frac\lambda2 \ln^2 J, \qquad
//! \tau = G (b - 1) + \lambda \ln J\, 1, \qquad \lambda = K - \tfrac23 G
//! ```
//!
//! (Bonet & Wood 2008, Nonlinear Continuum Mechanics for Finite Element Analysis, section 6.4.3).
//! Limits: polyconvex, hence elliptic, while ln J ≤ 1 + G/λ; it softens beyond, that is in
//! tension, and its resistance to compression is unlimited.

use super::kinematics::Strain;
use super::logarithm::ln_of_one_plus;
use super::number::Number;
use super::principal::Response;
use super::tensor::SymmetricTensor;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct NeoHookeLn {
    pub bulk: f64,
    pub shear: f64,
}

impl NeoHookeLn {
    /// Returns Lamé's λ.
    #[inline(always)]
    fn lambda(&self) -> f64 {
        self.bulk - 2.0 / 3.0 * self.shear
    }

    #[inline(always)]
    pub fn energy<N: Number>(&self, strain: &Strain<N>) -> N {
        let ln = ln_of_one_plus(strain.volume_change);
        let (half_shear, half_lambda) = (0.5 * self.shear, 0.5 * self.lambda());
        N::splat(half_shear) * (strain.left.trace() - (ln + ln)) + N::splat(half_lambda) * (ln * ln)
    }

    #[inline(always)]
    pub fn kirchhoff<N: Number>(&self, strain: &Strain<N>) -> SymmetricTensor<N> {
        let SymmetricTensor { rr, yy, tt, ry } = strain.left;
        let shear = N::splat(self.shear);
        let mean = N::splat(self.lambda()) * ln_of_one_plus(strain.volume_change);
        SymmetricTensor {
            rr: mean.plus_product(shear, rr),
            yy: mean.plus_product(shear, yy),
            tt: mean.plus_product(shear, tt),
            ry: shear * ry,
        }
    }

    /// Returns τ_i and ∂τ_i/∂ln λ_j at principal stretches.
    pub fn principal(&self, stretches: [f64; 3]) -> Response {
        let b = stretches.map(|stretch| stretch * stretch);
        let ln = ln_of_one_plus(stretches.iter().product::<f64>() - 1.0);
        Response::new(
            |i| self.lambda() * ln + self.shear * (b[i] - 1.0),
            |i, j| self.lambda() + if i == j { 2.0 * self.shear * b[i] } else { 0.0 },
        )
    }
}
