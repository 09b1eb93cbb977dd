//! The law of [`super::tsuji`] for a contact that ends at zero force.
//!
//! Zhang & Whiten (1996) found that spring and dashpot pull the bodies together before the overlap
//! is gone, and end the contact when the force is zero. With y = ξ^(5/4), as there, that is the end
//! at zero force of a linear oscillator (y″ = 0), so with φ = arccos ζ and ζ = α/√5
//!
//! ```math
//! e = \exp\frac{-2\zeta\varphi}{\sqrt{1-\zeta^2}},
//! ```
//!
//! solved for ζ by bisection. Limits: a restitution that is to be the same at every speed.

use super::linear::damping_ratio;
use crate::end_rule::EndRule;
use crate::error::{LawError, restitution as checked};

/// α of a restitution, in (0, 1], at the end of force.
///
/// # Errors
/// A restitution outside (0, 1].
pub fn zhang_whiten_coefficient(restitution: f64) -> Result<f64, LawError> {
    let loss = checked(restitution)?.recip().ln();
    Ok(5f64.sqrt() * damping_ratio(loss, EndRule::ZeroForce))
}
