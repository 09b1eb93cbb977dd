//! Hertz' spring with a damping of the spring's own form.
//!
//! ```math
//! F = K\xi^{3/2} + C\sqrt\xi\,\dot\xi, \qquad C = \frac{2\eta_1}{3(1-\eta_2^2)}\sqrt{R^*}
//! ```
//!
//! Morgado & Oppenheim (1997), as Bordbar & Hyppänen (2007) give it after eq. 16: K for equal spheres,
//! (2/3) E √R*/(1−ν²), with E and ν replaced by the viscoelastic coefficients η₁ and η₂. Limits: equal
//! materials, a mild loss; the coefficients are hard to find for any material.

use super::hertz::hertz_stiffness;
use super::power::{ContactLaw, power};
use crate::error::{LawError, not_negative};
use crate::pair::Pair;

/// Returns the law of a pair for η₁, Pa s, and η₂, in (−1, 1).
///
/// # Errors
/// η₁ negative or not finite, η₂ outside (−1, 1).
pub fn morgado_oppenheim(pair: &Pair, eta_1: f64, eta_2: f64) -> Result<ContactLaw, LawError> {
    let viscosity = not_negative("eta_1", eta_1)?;
    if !(eta_2 > -1.0 && eta_2 < 1.0) {
        return Err(LawError::OutOfRange { quantity: "eta_2", value: eta_2, range: "(-1, 1)" });
    }
    let damping = 2.0 * viscosity / (3.0 * (1.0 - eta_2 * eta_2)) * pair.effective_radius().sqrt();
    power(hertz_stiffness(pair), 1.5, damping, 0.5)
}
