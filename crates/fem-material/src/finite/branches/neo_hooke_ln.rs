//! Branches of neo-Hooke with ln J, whose stress is linear in b_e and in ln J_e = ln J − ln J_v:
//!
//! ```math
//! \tau = G \Bigl[F\Bigl(g_\infty 1 + \sum_k g_k J_{v,k}^{-2/3} \bar C_{v,k}^{-1}\Bigr) F^T - 1\Bigr]
//! + \lambda \Bigl[\ln J - \sum_k g_k \ln J_{v,k}\Bigr] 1
//! ```
//!
//! without the terms of J_v where the volume is elastic.

use super::super::kinematics::{Strain, push_forward};
use super::super::logarithm::ln_of_one_plus;
use super::super::number::{Number, inverse_cube_root_change};
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
    let zero = N::splat(0.0);
    let mut flown = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
    let (mut rescaled, mut ln) = (zero, ln_of_one_plus(volume_change));
    for (weight, viscous) in branches.weights.iter().zip(past) {
        let weight = N::splat(*weight);
        let mut factor = weight;
        if branches.volume_flows {
            let z = inverse_cube_root_change(viscous.volume_change);
            let change = (z + z).plus_product(z, z);
            factor = weight.plus_product(weight, change);
            rescaled = rescaled.plus_product(weight, change);
            ln = ln.minus_product(weight, ln_of_one_plus(viscous.volume_change));
        }
        flown = flown.plus_multiple(factor, &viscous.shape);
    }
    let left = left.rescaled(rescaled).plus(&push_forward(&flown, h));
    let shear = N::splat(branches.shear);
    let mean = N::splat(branches.bulk - 2.0 / 3.0 * branches.shear) * ln;
    SymmetricTensor {
        rr: mean.plus_product(shear, left.rr),
        yy: mean.plus_product(shear, left.yy),
        tt: mean.plus_product(shear, left.tt),
        ry: shear * left.ry,
    }
}
