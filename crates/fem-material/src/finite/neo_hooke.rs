//! Neo-Hooke with a separate volumetric energy, the default law at finite strain.
//!
//! ```math
//! W = \frac G2 \left(J^{-2/3} \mathrm{tr}\, b - 3\right) + \frac K2 (J-1)^2, \qquad
//! \tau = G J^{-2/3}\, \mathrm{dev}\, b + K J (J-1)\, 1
//! ```
//!
//! with b = F Fᵀ (Simo & Hughes 1998, Computational Inelasticity, section 9.2, with the simplest
//! energy of the volume). Shape and volume are uncoupled: the pressure is a function of J alone, so
//! that the law serves nearly incompressible solids. Written over [`Number`], without a branch.
//!
//! Limits: polyconvex (Hartmann & Neff 2003, International Journal of Solids and Structures
//! 40:2767), hence elliptic at every deformation. The energy of the volume stays finite at J = 0,
//! where the shape alone resists.

use super::kinematics::{Strain, first_piola};
use super::number::{Number, inverse_cube_root, inverse_cube_root_change};
use super::principal::Response;
use super::tensor::{AxisymmetricTensor, SymmetricTensor};

/// The default law, on one number or on lanes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHooke<N = f64> {
    /// Bulk modulus K, Pa.
    pub bulk: N,
    /// Shear modulus G, Pa.
    pub shear: N,
}

impl<N: Number> NeoHooke<N> {
    /// Returns the first Piola-Kirchhoff stress, Pa, of the displacement gradient, and J − 1.
    ///
    /// The stress is valid where J − 1 > −1, which the caller has to check.
    #[inline(always)]
    pub fn first_piola(&self, h: &AxisymmetricTensor<N>) -> (AxisymmetricTensor<N>, N) {
        let strain = Strain::of(h);
        let y = inverse_cube_root(N::splat(1.0) + strain.volume_change);
        let stress = self.stress(&strain.left, self.pull(&strain), y * y);
        (first_piola(&stress, h, y * y * y), strain.volume_change)
    }

    /// Returns the energy per undeformed volume, J/m³, of the displacement gradient, and J − 1.
    #[inline(always)]
    pub fn energy(&self, h: &AxisymmetricTensor<N>) -> (N, N) {
        let strain = Strain::of(h);
        (self.energy_of(&strain), strain.volume_change)
    }

    #[inline(always)]
    pub(super) fn kirchhoff(&self, strain: &Strain<N>) -> SymmetricTensor<N> {
        let y = inverse_cube_root(N::splat(1.0) + strain.volume_change);
        self.stress(&strain.left, self.pull(strain), y * y)
    }

    /// Returns K J (J − 1), the mean of τ.
    #[inline(always)]
    fn pull(&self, strain: &Strain<N>) -> N {
        self.bulk * (strain.volume_change * (N::splat(1.0) + strain.volume_change))
    }

    /// Returns τ for b − 1 (or a weighted sum over branches), the mean of τ, and J^(−2/3).
    #[inline(always)]
    pub(super) fn stress(
        &self,
        left: &SymmetricTensor<N>,
        pull: N,
        unimodular: N,
    ) -> SymmetricTensor<N> {
        let scale = self.shear * unimodular;
        let mean = pull.minus_product(scale, left.trace() * N::splat(1.0 / 3.0));
        SymmetricTensor {
            rr: mean.plus_product(scale, left.rr),
            yy: mean.plus_product(scale, left.yy),
            tt: mean.plus_product(scale, left.tt),
            ry: scale * left.ry,
        }
    }

    #[inline(always)]
    pub(super) fn energy_of(&self, strain: &Strain<N>) -> N {
        let Strain { left, volume_change } = *strain;
        let z = inverse_cube_root_change(volume_change);
        let unimodular_change = z + z + z * z;
        let trace = left.trace();
        let shape = trace + (N::splat(3.0) + trace) * unimodular_change;
        N::splat(0.5) * (self.shear * shape + self.bulk * volume_change * volume_change)
    }
}

impl NeoHooke {
    /// Returns τ_i and ∂τ_i/∂ln λ_j at principal stretches.
    pub(super) fn principal(&self, stretches: [f64; 3]) -> Response {
        let Self { bulk, shear } = *self;
        let jacobian: f64 = stretches.iter().product();
        let y = inverse_cube_root(jacobian);
        let b = stretches.map(|stretch| stretch * stretch * y * y);
        let mean = b.iter().sum::<f64>() / 3.0;
        let pull = bulk * jacobian * (jacobian - 1.0);
        let pull_slope = bulk * jacobian * (2.0 * jacobian - 1.0);
        Response::new(
            |i| pull + shear * (b[i] - mean),
            |i, j| {
                let own = if i == j { 2.0 * b[i] } else { 0.0 };
                pull_slope + shear * (own - 2.0 / 3.0 * (b[i] + b[j] - mean))
            },
        )
    }
}
