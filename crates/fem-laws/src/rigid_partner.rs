//! What taking a stiff body as rigid costs.
//!
//! The contact lacks the body's share s = E*/E′ of its compliance, E′ = E/(1−ν²), so that E* becomes
//! E*/(1−s), and by Hertz' powers
//!
//! ```math
//! \frac{\Delta T}T = (1-s)^{2/5}-1, \qquad \frac{\Delta F}F = (1-s)^{-2/5}-1.
//! ```
//!
//! The restitution stays as long as the body is elastic and radiates nothing. A sphere's finite size is
//! of a smaller order, (a/R) s.

use crate::difference::RelativeError;
use crate::pair::{Pair, Partner};

/// The error of a collision of the pair with this one of its partners rigid; `None` if the other is.
pub fn rigid_partner(pair: &Pair, partner: &Partner) -> Option<RelativeError> {
    let share = pair.contact_modulus() / partner.plane_strain_modulus();
    // E* of a pair with one rigid body is the other's E′ itself.
    (share < 1.0).then(|| {
        let logarithm = 0.4 * (-share).ln_1p();
        RelativeError {
            restitution: 0.0,
            contact_time: logarithm.exp_m1(),
            peak_force: (-logarithm).exp_m1(),
        }
    })
}
