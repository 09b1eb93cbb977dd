//! The law F = K ξ^(8/5) + C ξ^(4/5) ξ̇.
//!
//! Mishra & Murty (2001), fitted to drop tests for ball mills; Bordbar & Hyppänen (2007), section 3-2.
//! K and C are measured for one pair of bodies: no elastic theory gives the exponent 8/5. Limits: the
//! pair and the speeds of the fit.

use super::power::{ContactLaw, power};
use crate::error::LawError;

/// Returns the law of a stiffness K, N/m^(8/5), and a damping C, N s/m^(9/5).
///
/// # Errors
/// K not positive and finite, C negative or not finite.
pub fn mishra_murty(stiffness: f64, damping: f64) -> Result<ContactLaw, LawError> {
    power(stiffness, 1.6, damping, 0.8)
}
