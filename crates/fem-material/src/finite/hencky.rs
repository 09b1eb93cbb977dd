//! Hencky: Hooke's law of the logarithmic strain.
//!
//! ```math
//! W = \frac K2 \ln^2 J + G\, |\mathrm{dev}\, h|^2, \qquad h = \ln V = \tfrac12 \ln b, \qquad
//! \tau = K \ln J\, 1 + 2G\, \mathrm{dev}\, h
//! ```
//!
//! (Hencky 1928; Anand 1979, Journal of Applied Mechanics 46:78). The meridian block of b has the
//! eigenvalues m ± ρ; with s = √(m² − ρ²) the root of their product it has the logarithm
//!
//! ```math
//! \tfrac12 \ln b = \tfrac12 \ln s\; 1 + \frac{\mathrm{artanh}\,y}{y}\, \frac{b - m 1}{m + s}, \qquad
//! y^2 = \frac{m - s}{m + s}
//! ```
//!
//! since ½ ln((m + ρ)/(m − ρ)) = 2 artanh y: neither eigenvalue nor eigenvector is needed, and there is no
//! cancellation where they are equal.
//!
//! Limits: elliptic while all stretches lie in 0.2116 .. e^(1/3) = 1.3956 (Bruhns, Xiao & Meyers
//! 2001, Proceedings of the Royal Society A 457:2207); in uniaxial strain the slope is zero at
//! F = e.

use super::kinematics::Strain;
use super::logarithm::{artanh_over_root, ln_of_one_plus};
use super::number::Number;
use super::principal::Response;
use super::tensor::SymmetricTensor;

/// Bulk and shear modulus, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hencky {
    pub bulk: f64,
    pub shear: f64,
}

impl Hencky {
    #[inline(always)]
    pub fn energy<N: Number>(&self, strain: &Strain<N>) -> N {
        self.energy_of(&logarithmic_strain(&strain.left))
    }

    /// Returns the energy of a logarithmic strain.
    #[inline(always)]
    pub fn energy_of<N: Number>(&self, strain: &SymmetricTensor<N>) -> N {
        let SymmetricTensor { rr, yy, tt, ry } = *strain;
        let volumetric = rr + yy + tt;
        let mean = volumetric * N::splat(1.0 / 3.0);
        let deviator = SymmetricTensor { rr: rr - mean, yy: yy - mean, tt: tt - mean, ry };
        N::splat(0.5 * self.bulk) * (volumetric * volumetric)
            + N::splat(self.shear) * deviator.dot(&deviator)
    }

    #[inline(always)]
    pub fn kirchhoff<N: Number>(&self, strain: &Strain<N>) -> SymmetricTensor<N> {
        self.kirchhoff_of(&logarithmic_strain(&strain.left))
    }

    /// Returns Kirchhoff's stress of a logarithmic strain.
    #[inline(always)]
    pub fn kirchhoff_of<N: Number>(&self, strain: &SymmetricTensor<N>) -> SymmetricTensor<N> {
        let SymmetricTensor { rr, yy, tt, ry } = *strain;
        let mean = N::splat(self.bulk - 2.0 / 3.0 * self.shear) * (rr + yy + tt);
        let two_g = N::splat(2.0 * self.shear);
        SymmetricTensor {
            rr: mean.plus_product(two_g, rr),
            yy: mean.plus_product(two_g, yy),
            tt: mean.plus_product(two_g, tt),
            ry: two_g * ry,
        }
    }

    /// Returns τ_i and ∂τ_i/∂ln λ_j at principal stretches.
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

/// Returns ½ ln b for given b − 1.
#[inline(always)]
pub(super) fn logarithmic_strain<N: Number>(left: &SymmetricTensor<N>) -> SymmetricTensor<N> {
    let SymmetricTensor { rr, yy, tt, ry } = *left;
    let (one, half) = (N::splat(1.0), N::splat(0.5));
    let determinant = (rr + yy).plus_product(rr, yy).minus_product(ry, ry);
    let factor = meridian_factor(one + half * (rr + yy), (one + determinant).sqrt());
    let common = N::splat(0.25) * ln_of_one_plus(determinant);
    let difference = half * (rr - yy);
    SymmetricTensor {
        rr: common.plus_product(factor, difference),
        yy: common.minus_product(factor, difference),
        tt: half * ln_of_one_plus(tt),
        ry: factor * ry,
    }
}

/// Returns the ratio of the deviators of ½ ln b and of b in the meridian, for the mean m of b's eigenvalues there and
/// the root s of their product.
#[inline(always)]
pub(super) fn meridian_factor<N: Number>(mean: N, root: N) -> N {
    let inverse = N::splat(1.0) / (mean + root);
    artanh_over_root((mean - root) * inverse) * inverse
}
