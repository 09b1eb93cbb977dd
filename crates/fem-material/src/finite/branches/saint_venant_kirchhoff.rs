//! Branches of St Venant's and Kirchhoff's law, which is quadratic in b_e: the sum of the law of each.

use super::super::kinematics::{Strain, push_forward};
use super::super::number::{Number, inverse_cube_root_change};
use super::super::saint_venant_kirchhoff::SaintVenantKirchhoff;
use super::super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::super::viscous::InverseMetric;
use super::Branches;

#[inline(always)]
pub(super) fn kirchhoff<N: Number>(
    branches: &Branches,
    h: &AxisymmetricTensor<N>,
    strain: &Strain<N>,
    past: impl Iterator<Item = InverseMetric<N>>,
) -> SymmetricTensor<N> {
    let Branches { bulk, shear, equilibrium_weight, volume_flows, .. } = *branches;
    // Where the volume is elastic the branches have the part of the law that goes with G.
    let (of_bulk, lasting_bulk) =
        if volume_flows { (bulk, bulk * equilibrium_weight) } else { (0.0, bulk) };
    let lasting = SaintVenantKirchhoff { bulk: lasting_bulk, shear: shear * equilibrium_weight };
    let mut sum = lasting.kirchhoff(strain);
    for (&weight, viscous) in branches.weights.iter().zip(past) {
        let mut left = strain.left.plus(&push_forward(&viscous.shape, h));
        let mut volume_change = strain.volume_change;
        if volume_flows {
            let z = inverse_cube_root_change(viscous.volume_change);
            left = left.rescaled((z + z).plus_product(z, z));
            volume_change = (volume_change - viscous.volume_change) * viscous.inverse_volume;
        }
        let law = SaintVenantKirchhoff { bulk: weight * of_bulk, shear: weight * shear };
        sum = sum.plus(&law.kirchhoff(&Strain { left, volume_change }));
    }
    sum
}
