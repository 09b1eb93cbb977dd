//! Shear relaxes, bulk is elastic: the mean stress is that of the displacement, the deviatoric
//! stress that of the effective displacement.
//!
//! ```math
//! f = -K_{bulk}\, u - K_{shear}\, w
//! ```

use super::elastic::Elastic;
use super::kernel::{Moduli, subtract_split_internal_forces};
use super::prony::Relaxes;
use crate::part::Field;

/// Shear alone relaxes.
#[derive(Debug)]
pub(super) struct RelaxingShear;

impl Relaxes for RelaxingShear {
    fn relaxing(Moduli { shear, .. }: Moduli) -> Moduli {
        Moduli { bulk: 0.0, shear }
    }

    fn lasting(Moduli { bulk, shear }: Moduli, equilibrium_weight: f64) -> Moduli {
        Moduli { bulk, shear: equilibrium_weight * shear }
    }

    fn subtract_forces(
        Elastic { elements, moduli }: &Elastic,
        u: &Field,
        w: &Field,
        f: &mut Field,
    ) {
        subtract_split_internal_forces(elements, *moduli, u, w, f);
    }
}
