//! Maxwell branches (one per Prony term) of the default law, whose deviatoric stress is linear in b̄_e:
//!
//! ```math
//! \tau = G J^{-2/3}\, \mathrm{dev}\Bigl[F\Bigl(g_\infty 1 + \sum_k g_k \bar C_{v,k}^{-1}\Bigr) F^T\Bigr]
//! + p\,1, \qquad p = K \Bigl[g_\infty J (J-1) + \sum_k g_k J_{e,k} (J_{e,k} - 1)\Bigr]
//! ```
//!
//! or p = K J (J − 1) where the volume is elastic.

use super::super::kinematics::{Strain, push_forward};
use super::super::neo_hooke::NeoHooke;
use super::super::number::{Number, inverse_cube_root};
use super::super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::super::viscous::InverseMetric;
use super::Branches;

#[inline(always)]
pub(super) fn kirchhoff<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    &Strain { left, volume_change }: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let (zero, one) = (N::splat(0.0), N::splat(1.0));
    let law = NeoHooke { bulk: N::splat(branches.bulk), shear: N::splat(branches.shear) };
    let jacobian = one + volume_change;
    let mut flown = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
    let mut pull = volume_change * jacobian;
    if branches.volume_flows {
        pull = N::splat(branches.equilibrium_weight) * pull;
    }
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        flown = flown.plus_multiple(weight, &viscous.shape);
        if branches.volume_flows {
            let inverse = viscous.inverse_volume;
            let change = (volume_change - viscous.volume_change) * inverse;
            pull = pull.plus_product(weight * change, jacobian * inverse);
        }
    }
    let left = left.plus(&push_forward(&flown, h));
    let y = inverse_cube_root(jacobian);
    law.stress(&left, law.bulk * pull, y * y)
}
