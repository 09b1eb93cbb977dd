//! Hertz' elastic force, F = K ξ^(3/2) with K = (4/3) E* √R*.
//!
//! Hertz (1882); Bordbar & Hyppänen (2007), eq. 7 with γ = 3/2 and C = 0. As a law it is integrated
//! in time like the others; [`crate::HertzImpact`] has the closed forms. Limits: those there.

use super::power::{ContactLaw, power};
use crate::error::LawError;
use crate::pair::Pair;

/// Returns Hertz' law of a pair.
///
/// # Errors
/// A stiffness outside the range of f64.
pub fn hertz(pair: &Pair) -> Result<ContactLaw, LawError> {
    power(hertz_stiffness(pair), 1.5, 0.0, 0.0)
}

/// Returns K = (4/3) E* √R*, N/m^(3/2), of Hertz' force.
pub(super) fn hertz_stiffness(pair: &Pair) -> f64 {
    4.0 / 3.0 * pair.contact_modulus() * pair.effective_radius().sqrt()
}
