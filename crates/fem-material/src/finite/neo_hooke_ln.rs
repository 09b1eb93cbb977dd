//! Neo-Hooke with ln J.
//!
//! ```math
//! W = \frac G2 (\mathrm{tr}\, b - 3) - G \ln J + \frac\lambda2 \ln^2 J, \qquad
//! \tau = G (b - 1) + \lambda \ln J\, 1, \qquad \lambda = K - \tfrac23 G
//! ```
//!
//! (Bonet & Wood 2008, Nonlinear Continuum Mechanics for Finite Element Analysis, section 6.4.3).
//! Limits: polyconvex, hence elliptic, while ln J ≤ 1 + G/λ; it softens beyond, that is in
//! tension, and resists compression without end.

use super::kinematics::Strain;
use super::logarithm::ln_of_one_plus;
use super::principal::Response;
use super::tensor::SymmetricTensor;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct NeoHookeLn {
    pub bulk: f64,
    pub shear: f64,
}

impl NeoHookeLn {
    fn lambda(&self) -> f64 {
        self.bulk - 2.0 / 3.0 * self.shear
    }

    pub fn energy(&self, strain: &Strain) -> f64 {
        let ln = ln_of_one_plus(strain.volume_change);
        0.5 * self.shear * (strain.left.trace() - 2.0 * ln) + 0.5 * self.lambda() * ln * ln
    }

    #[inline]
    pub fn kirchhoff(&self, strain: &Strain) -> SymmetricTensor {
        let SymmetricTensor { rr, yy, tt, ry } = strain.left;
        let mean = self.lambda() * ln_of_one_plus(strain.volume_change);
        SymmetricTensor {
            rr: mean + self.shear * rr,
            yy: mean + self.shear * yy,
            tt: mean + self.shear * tt,
            ry: self.shear * ry,
        }
    }

    /// τ_i and ∂τ_i/∂ln λ_j at principal stretches.
    pub fn principal(&self, stretches: [f64; 3]) -> Response {
        let b = stretches.map(|stretch| stretch * stretch);
        let ln = ln_of_one_plus(stretches.iter().product::<f64>() - 1.0);
        Response::new(
            |i| self.lambda() * ln + self.shear * (b[i] - 1.0),
            |i, j| self.lambda() + if i == j { 2.0 * self.shear * b[i] } else { 0.0 },
        )
    }
}
