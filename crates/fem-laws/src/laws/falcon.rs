//! Hertz' spring with the damping C ξ^(1/4) ξ̇.
//!
//! Falcon, Laroche, Fauve & Coste (1998), who compare exponents of the damping for one ball bouncing
//! on a plane; Bordbar & Hyppänen (2007), section 3-2. The same form as [`super::tsuji`], with C as it
//! comes from an experiment. The restitution is independent of speed. Limits: those of an empirical
//! law: the material and the sizes at which C was measured.

use super::hertz::hertz_stiffness;
use super::power::{ContactLaw, power};
use crate::error::LawError;
use crate::pair::Pair;

/// Returns the law of a pair and a damping C, N s/m^(5/4).
///
/// # Errors
/// C negative or not finite.
pub fn falcon(pair: &Pair, damping: f64) -> Result<ContactLaw, LawError> {
    power(hertz_stiffness(pair), 1.5, damping, 0.25)
}
