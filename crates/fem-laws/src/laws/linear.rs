//! The linear spring parallel to a linear dashpot.
//!
//! ```math
//! F = K\xi + C\dot\xi, \qquad \omega_0^2 = \frac K{m^*}, \quad \zeta = \frac C{2\sqrt{m^*K}}
//! ```
//!
//! Bordbar & Hyppänen (2007), eq. 9. With cos φ = ζ and ω = ω₀√(1−ζ²) the contact ends
//!
//! ```math
//! \text{at zero overlap:}\quad T = \frac\pi\omega,\ e = \exp\frac{-\pi\zeta}{\sqrt{1-\zeta^2}};
//! \qquad \text{at zero force:}\quad
//! T = \frac{2\varphi}\omega,\ e = \exp\frac{-2\zeta\varphi}{\sqrt{1-\zeta^2}}
//! ```
//!
//! (for ζ > 1 the second continues with φ/√(1−ζ²) → arcosh ζ/√(ζ²−1), the first has no end). Limits:
//! both T and e are independent of speed, which no pair of spheres shows; a force jumps to C v at
//! first touch. For a stiffness and a restitution, C = 2 ζ √(m\* K): at zero overlap
//!
//! ```math
//! C = \frac{-2\ln e\,\sqrt{m^*K}}{\sqrt{\pi^2+\ln^2 e}}
//! ```
//!
//! (Kawaguchi, Tanaka & Tsuji 1992, as the manual of PFC derives it: "Calibrating the Normal Critical Damping Ratio").

use std::f64::consts::PI;

use super::power::{ContactLaw, EndRule, power};
use crate::error::{LawError, positive, restitution as checked};
use crate::family::{LawContext, LawInput, LawValues};
use crate::numerics::bisection::last_where;
use crate::pair::Pair;

/// Returns the law of a stiffness K, N/m, and a damping C, N s/m.
///
/// # Errors
/// K not positive and finite, C negative or not finite.
pub fn linear(stiffness: f64, damping: f64) -> Result<ContactLaw, LawError> {
    power(stiffness, 1.0, damping, 0.0)
}

/// Returns the law with a restitution in (0, 1] and a contact time, s, for the end rule under which it is to run.
///
/// # Errors
/// A restitution outside (0, 1], a time that is not positive and finite.
pub fn linear_from_restitution(
    pair: &Pair,
    restitution: f64,
    contact_time: f64,
    end_rule: EndRule,
) -> Result<ContactLaw, LawError> {
    let loss = checked(restitution)?.recip().ln();
    let time = positive("contact_time", contact_time)?;
    let ratio = damping_ratio(loss, end_rule);
    // ω₀ T.
    let phase = match end_rule {
        EndRule::ZeroOverlap => PI.hypot(loss),
        EndRule::ZeroForce => zero_force_phase(ratio),
    };
    let frequency = phase / time;
    let mass = pair.effective_mass();
    linear(mass * frequency * frequency, 2.0 * ratio * mass * frequency)
}

/// Returns the damping C, N s/m, of a stiffness, N/m, that gives a restitution in (0, 1] under the end rule.
///
/// # Errors
/// A restitution outside (0, 1], a stiffness that is not positive and finite.
pub fn linear_damping(
    pair: &Pair,
    stiffness: f64,
    restitution: f64,
    end_rule: EndRule,
) -> Result<f64, LawError> {
    let loss = checked(restitution)?.recip().ln();
    let stiffness = positive("stiffness", stiffness)?;
    Ok(2.0 * damping_ratio(loss, end_rule) * (pair.effective_mass() * stiffness).sqrt())
}

/// Returns ζ at which −ln e is `loss`.
pub(super) fn damping_ratio(loss: f64, end_rule: EndRule) -> f64 {
    match end_rule {
        EndRule::ZeroOverlap => loss / PI.hypot(loss),
        // e = exp(−2ζψ) rises by 1 a ζ at first, then as ln ζ.
        EndRule::ZeroForce => {
            last_where(0.0, loss + loss.exp(), |ratio| ratio * zero_force_phase(ratio) < loss)
        }
    }
}

/// Returns ω₀ T = 2φ/√(1−ζ²) of the end at zero force.
fn zero_force_phase(ratio: f64) -> f64 {
    let complement = (1.0 - ratio) * (1.0 + ratio);
    if complement > 1e-12 {
        2.0 * ratio.acos() / complement.sqrt()
    } else if complement < -1e-12 {
        2.0 * ratio.acosh() / (-complement).sqrt()
    } else {
        2.0
    }
}

/// Returns k and c as given, or those of a restitution and a contact time or a stiffness.
///
/// # Errors
/// Those of [`linear_from_restitution`] and [`linear_damping`].
pub fn linear_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let LawContext { pair, end_rule, .. } = *context;
    let stiffness = law.get("k").unwrap_or_default();
    let values = match (law.get("e"), law.get("contact_time")) {
        (Some(restitution), Some(time)) => {
            let made = linear_from_restitution(&pair, restitution, time, end_rule)?;
            vec![made.stiffness(), made.damping()]
        }
        (Some(restitution), None) => {
            vec![stiffness, linear_damping(&pair, stiffness, restitution, end_rule)?]
        }
        (None, _) => vec![stiffness, law.get("c").unwrap_or_default()],
    };
    Ok((values, pair))
}
