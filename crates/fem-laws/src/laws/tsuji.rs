//! Hertz' spring with the damping that makes the restitution independent of speed.
//!
//! ```math
//! F = K\xi^{3/2} + \alpha\sqrt{m^*K}\,\xi^{1/4}\dot\xi
//! ```
//!
//! Tsuji, Tanaka & Ishida (1992). Zhang & Whiten (1996) end the contact at zero force instead of zero overlap, before
//! spring and dashpot pull the bodies together. With y = ξ^(5/4) and ds = ξ^(1/4) dt the motion is y″ + α y′ + (5/4) y
//! = 0 in suitable units, a linear oscillator of the damping ratio ζ = α/√5, so that at zero overlap
//!
//! ```math
//! e = \exp\frac{-\pi\zeta}{\sqrt{1-\zeta^2}}, \qquad
//! \alpha = \frac{-\sqrt5\,\ln e}{\sqrt{\pi^2+\ln^2 e}}
//! ```
//!
//! (Antypov & Elliott 2011). The end at zero force is that of the same oscillator, y″ = 0, so that with
//! φ = arccos ζ
//!
//! ```math
//! e = \exp\frac{-2\zeta\varphi}{\sqrt{1-\zeta^2}},
//! ```
//!
//! solved for ζ by bisection. Limits: a restitution that is the same at every speed.

use std::f64::consts::PI;

use super::linear::damping_ratio;
use super::power::{ContactLaw, EndRule, power};
use super::published::hertz_stiffness;
use crate::error::{LawError, not_negative, restitution as checked};
use crate::family::{LawContext, LawInput, LawValues};
use crate::pair::Pair;

/// Returns the law of a pair and α ≥ 0; from α = √5 on there is no rebound at zero overlap.
///
/// # Errors
/// α negative or not finite.
pub fn tsuji(pair: &Pair, damping_coefficient: f64) -> Result<ContactLaw, LawError> {
    let alpha = not_negative("damping_coefficient", damping_coefficient)?;
    let stiffness = hertz_stiffness(pair);
    power(stiffness, 1.5, alpha * pair.effective_mass().sqrt() * stiffness.sqrt(), 0.25)
}

/// Returns α for a restitution, in (0, 1], at the end of overlap.
///
/// # Errors
/// A restitution outside (0, 1].
pub fn tsuji_coefficient(restitution: f64) -> Result<f64, LawError> {
    let loss = checked(restitution)?.recip().ln();
    Ok(5f64.sqrt() * loss / PI.hypot(loss))
}

/// Returns α for a restitution, in (0, 1], at the end of force.
///
/// # Errors
/// A restitution outside (0, 1].
pub fn zhang_whiten_coefficient(restitution: f64) -> Result<f64, LawError> {
    let loss = checked(restitution)?.recip().ln();
    Ok(5f64.sqrt() * damping_ratio(loss, EndRule::ZeroForce))
}

/// Returns α as given, or that of a restitution under the end rule.
///
/// # Errors
/// A restitution outside (0, 1].
pub fn tsuji_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let alpha = match (law.get("e"), context.end_rule) {
        (Some(e), EndRule::ZeroOverlap) => tsuji_coefficient(e)?,
        (Some(e), EndRule::ZeroForce) => zhang_whiten_coefficient(e)?,
        (None, _) => law.get("alpha").unwrap_or_default(),
    };
    Ok((vec![alpha], context.pair))
}
