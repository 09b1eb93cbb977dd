//! All moduli relax alike, so that Poisson's ratio stays the same: the whole stress is that of the
//! effective displacement.
//!
//! ```math
//! f = -(K_{bulk} + K_{shear})\, w
//! ```

use super::elastic::Elastic;
use super::kernel::{Moduli, subtract_internal_forces};
use super::prony::Relaxes;
use crate::part::Field;

/// Bulk relaxes with shear.
#[derive(Debug)]
pub(super) struct ConstantPoisson;

impl Relaxes for ConstantPoisson {
    fn relaxing(instantaneous: Moduli) -> Moduli {
        instantaneous
    }

    fn lasting(Moduli { bulk, shear }: Moduli, equilibrium_weight: f64) -> Moduli {
        Moduli { bulk: equilibrium_weight * bulk, shear: equilibrium_weight * shear }
    }

    fn subtract_forces(
        Elastic { elements, moduli }: &Elastic,
        _: &Field,
        w: &Field,
        f: &mut Field,
    ) {
        subtract_internal_forces(elements, *moduli, w, f);
    }
}
