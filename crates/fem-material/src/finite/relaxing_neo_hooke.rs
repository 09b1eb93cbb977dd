//! The default law that relaxes, on one number or several side by side.
//!
//! The shape's stress of neo-Hooke is linear in b̄_e, so that all branches are one,
//!
//! ```math
//! \tau = G J^{-2/3}\, \mathrm{dev}\Bigl[F\Bigl(g_\infty 1 + \sum_k g_k \bar C_{v,k}^{-1}\Bigr) F^T\Bigr]
//! + p\,1, \qquad p = K \Bigl[g_\infty J (J-1) + \sum_k g_k J_{e,k} (J_{e,k} - 1)\Bigr]
//! ```
//!
//! or p = K J (J − 1) where the volume is elastic. It is what [`Viscoelastic`](super::Viscoelastic)
//! sums branch by branch for the other laws.

use super::kinematics::{Strain, first_piola, push_forward};
use super::neo_hooke::NeoHooke;
use super::number::{Number, inverse_cube_root};
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::viscous::ViscousStrain;

/// Moduli and weights of a neo-Hooke solid that relaxes.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxingNeoHooke {
    /// Instantaneous moduli, Pa.
    pub(super) moduli: NeoHooke,
    pub(super) equilibrium_weight: f64,
    pub(super) weights: Vec<f64>,
    pub(super) volume_flows: bool,
}

impl RelaxingNeoHooke {
    /// First Piola-Kirchhoff stress, Pa, and J − 1; as of [`NeoHooke::first_piola`], the caller has
    /// to look at J.
    #[inline(always)]
    pub fn first_piola<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        history: &[ViscousStrain<N>],
    ) -> (AxisymmetricTensor<N>, N) {
        let (zero, one) = (N::splat(0.0), N::splat(1.0));
        let law = NeoHooke { bulk: N::splat(self.moduli.bulk), shear: N::splat(self.moduli.shear) };
        let Strain { left, volume_change } = Strain::of(h);
        let jacobian = one + volume_change;

        let mut flown = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
        let mut pull = volume_change * jacobian;
        if self.volume_flows {
            pull = N::splat(self.equilibrium_weight) * pull;
        }
        for (weight, viscous) in self.weights.iter().zip(history) {
            let weight = N::splat(*weight);
            flown = flown.plus(&viscous.inverse().0.times(weight));
            if self.volume_flows {
                let inverse = one / (one + viscous.volume_change);
                let change = (volume_change - viscous.volume_change) * inverse;
                pull = pull + weight * (change * (jacobian * inverse));
            }
        }
        let left = left.plus(&push_forward(&flown, h));
        let y = inverse_cube_root(jacobian);
        let stress = law.stress(&left, law.bulk * pull, y * y);
        (first_piola(&stress, h, y * y * y), volume_change)
    }
}
