//! The paper's own law: Hertz' spring with a damping of free exponent.
//!
//! ```math
//! F = \tfrac43E^*\sqrt{R^*}\,\xi^{3/2} + 2A\,E^*R^{*(1-n)}\,\xi^n\dot\xi
//! ```
//!
//! Bordbar & Hyppänen (2007), eq. 18, which divides it by m*; A in s and n are fitted to measured
//! restitutions (the paper: n = 0.65 for ice, n = 1 for glass). For n = 1/2 it is
//! [`super::kuwabara_kono`]. Limits: the range of the fit; the dissipated share scales as
//! v^((4n−1)/5), so a restitution that falls with speed needs n > 1/4.

use super::hertz::hertz_stiffness;
use super::power::{ContactLaw, power};
use crate::error::{LawError, not_negative};
use crate::pair::Pair;

/// Returns the law of a pair, a dissipation time A, s, and an exponent n.
///
/// # Errors
/// A or n negative or not finite.
pub fn bordbar_hyppanen(
    pair: &Pair,
    dissipation_time: f64,
    damping_exponent: f64,
) -> Result<ContactLaw, LawError> {
    let time = not_negative("dissipation_time", dissipation_time)?;
    let n = not_negative("damping_exponent", damping_exponent)?;
    let damping = 2.0 * time * pair.contact_modulus() * pair.effective_radius().powf(1.0 - n);
    power(hertz_stiffness(pair), 1.5, damping, n)
}
