//! Hencky: Hooke's law of the logarithmic strain.
//!
//! ```math
//! W = \frac K2 \ln^2 J + G\, |\mathrm{dev}\, h|^2, \qquad h = \ln V = \tfrac12 \ln b, \qquad
//! \tau = K \ln J\, 1 + 2G\, \mathrm{dev}\, h
//! ```
//!
//! (Hencky 1928; Anand 1979, Journal of Applied Mechanics 46:78). The logarithm of the meridian
//! block with mean eigenvalue m and half difference ρ is
//! ½ ln(m² − ρ²) 1 + (artanh(x)/x)(b − m 1)/m, x = ρ/m: no eigenvector is needed.
//!
//! Limits: elliptic while all stretches lie in 0.2116 .. e^(1/3) = 1.3956 (Bruhns, Xiao & Meyers
//! 2001, Proceedings of the Royal Society A 457:2207); in uniaxial strain the slope is zero at
//! F = e.

use super::kinematics::Strain;
use super::logarithm::{artanh_over, ln_of_one_plus};
use super::principal::Response;
use super::tensor::SymmetricTensor;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hencky {
    pub bulk: f64,
    pub shear: f64,
}

impl Hencky {
    pub fn energy(&self, strain: &Strain) -> f64 {
        let SymmetricTensor { rr, yy, tt, ry } = logarithmic_strain(&strain.left);
        let volumetric = rr + yy + tt;
        let mean = volumetric / 3.0;
        let (rr, yy, tt) = (rr - mean, yy - mean, tt - mean);
        let shape = rr * rr + yy * yy + tt * tt + 2.0 * ry * ry;
        0.5 * self.bulk * volumetric * volumetric + self.shear * shape
    }

    #[inline]
    pub fn kirchhoff(&self, strain: &Strain) -> SymmetricTensor {
        let SymmetricTensor { rr, yy, tt, ry } = logarithmic_strain(&strain.left);
        let mean = (self.bulk - 2.0 / 3.0 * self.shear) * (rr + yy + tt);
        let two_g = 2.0 * self.shear;
        SymmetricTensor {
            rr: mean + two_g * rr,
            yy: mean + two_g * yy,
            tt: mean + two_g * tt,
            ry: two_g * ry,
        }
    }

    /// τ_i and ∂τ_i/∂ln λ_j at principal stretches.
    pub fn principal(&self, stretches: [f64; 3]) -> Response {
        let ln = stretches.map(|stretch| ln_of_one_plus(stretch - 1.0));
        let lambda = self.bulk - 2.0 / 3.0 * self.shear;
        let two_g = 2.0 * self.shear;
        let volumetric = ln.iter().sum::<f64>();
        Response::new(
            |i| lambda * volumetric + two_g * ln[i],
            |i, j| lambda + if i == j { two_g } else { 0.0 },
        )
    }
}

/// ½ ln b of b − 1.
#[inline]
fn logarithmic_strain(left: &SymmetricTensor) -> SymmetricTensor {
    let SymmetricTensor { rr, yy, tt, ry } = *left;
    let half_difference = 0.5 * (rr - yy);
    let mean = 1.0 + 0.5 * (rr + yy);
    let radius_squared = half_difference * half_difference + ry * ry;
    let ratio = artanh_over(radius_squared / (mean * mean)) / mean;
    let common = 0.25 * ln_of_one_plus(rr + yy + (rr * yy - ry * ry));
    let own = 0.5 * ratio * half_difference;
    SymmetricTensor {
        rr: common + own,
        yy: common - own,
        tt: 0.5 * ln_of_one_plus(tt),
        ry: 0.5 * ratio * ry,
    }
}
