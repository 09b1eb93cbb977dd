//! Hertz' spring with the damping of a Kelvin solid.
//!
//! ```math
//! F = K\left(\xi^{3/2} + \tfrac32 A\sqrt\xi\,\dot\xi\right), \qquad K = \tfrac43 E^*\sqrt{R^*}
//! ```
//!
//! Kuwabara & Kono (1987); Brilliantov, Spahn, Hertzsch & Pöschel (1996); Bordbar & Hyppänen (2007),
//! eqs. 12 and 13. It is the first order in A of K (ξ + A ξ̇)^(3/2), eq. 11. Limits: A ξ̇ ≪ ξ but for
//! a share of the contact time, so a mild loss.

use super::{ContactLaw, hertz_stiffness, power};
use crate::Pair;
use crate::error::{LawError, not_negative};

/// Of a pair and its dissipation time A, s.
///
/// # Errors
/// A negative or not finite.
pub fn kuwabara_kono(pair: &Pair, dissipation_time: f64) -> Result<ContactLaw, LawError> {
    let stiffness = hertz_stiffness(pair);
    let time = not_negative("dissipation_time", dissipation_time)?;
    power(stiffness, 1.5, 1.5 * time * stiffness, 0.5)
}
