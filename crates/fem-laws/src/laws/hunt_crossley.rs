//! Hertz' spring with a damping in proportion to its force.
//!
//! ```math
//! F = K\xi^{3/2} + C\xi^{3/2}\dot\xi, \qquad C = \frac{3K(1-e^2)}{4v}
//! ```
//!
//! Hunt & Crossley (1975); Bordbar & Hyppänen (2007), text after eq. 13. C equates the loss
//! ½m*v²(1−e²) with the work of the dashpot along the elastic motion, so the collision returns the
//! wanted e in first order of 1 − e only. Limits: 1 − e small, at the one speed v. The force never
//! attracts: the rate stays above −K/C.

use super::power::{ContactLaw, power};
use super::published::hertz_stiffness;
use crate::error::{LawError, positive, restitution as checked};
use crate::family::{LawContext, LawInput, LawValues};
use crate::pair::Pair;

/// Returns the law of a pair and the restitution, in (0, 1], at an approach speed, m/s.
///
/// # Errors
/// A restitution outside (0, 1], a speed that is not positive and finite.
pub fn hunt_crossley(
    pair: &Pair,
    restitution: f64,
    approach_speed: f64,
) -> Result<ContactLaw, LawError> {
    let e = checked(restitution)?;
    let speed = positive("approach_speed", approach_speed)?;
    let stiffness = hertz_stiffness(pair);
    power(stiffness, 1.5, 0.75 * stiffness * ((1.0 - e) * (1.0 + e) / speed), 1.5)
}

/// Returns the restitution and the speed for which it is specified: the approach speed if none is given.
///
/// # Errors
/// There are none.
pub fn hunt_crossley_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let speed = law.get("v").unwrap_or(context.approach_speed);
    Ok((vec![law.get("e").unwrap_or_default(), speed], context.pair))
}
