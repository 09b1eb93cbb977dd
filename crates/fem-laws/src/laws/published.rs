//! Published laws of the form F = K ξ^γ + C ξⁿ ξ̇ with fixed exponents, and Hertz' law.

use super::power::{ContactLaw, power};
use crate::error::{LawError, not_negative};
use crate::pair::Pair;

/// Returns Hertz' law of a pair.
///
/// Hertz' elastic force, F = K ξ^(3/2) with K = (4/3) E* √R*.
///
/// Hertz (1882); Bordbar & Hyppänen (2007), eq. 7 with γ = 3/2 and C = 0. As a law it is integrated
/// in time like the others; [`crate::HertzImpact`] has the closed forms. Limits: those there.
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

/// Returns the law of a pair and a damping C, N s/m^(5/4).
///
/// Hertz' spring with the damping C ξ^(1/4) ξ̇.
///
/// Falcon, Laroche, Fauve & Coste (1998), who compare exponents of the damping for one ball bouncing
/// on a plane; Bordbar & Hyppänen (2007), section 3-2. The same form as [`super::tsuji()`], with C as it
/// comes from an experiment. The restitution is independent of speed. Limits: those of an empirical
/// law: the material and the sizes at which C was measured.
///
/// # Errors
/// C negative or not finite.
pub fn falcon(pair: &Pair, damping: f64) -> Result<ContactLaw, LawError> {
    power(hertz_stiffness(pair), 1.5, damping, 0.25)
}

/// Returns the law of a pair and a damping C, N s/m.
///
/// Hertz' spring with the constant dashpot C ξ̇: `damping velocity` of LAMMPS.
///
/// The dissipated share falls with speed as v^(−1/5), that of a Maxwell solid whose contact is over before it relaxes: its share is as
/// the contact time. Limits: a force jumps to C v at first touch; C belongs to one pair of sizes.
///
/// # Errors
/// C negative or not finite.
pub fn hertz_dashpot(pair: &Pair, damping: f64) -> Result<ContactLaw, LawError> {
    power(hertz_stiffness(pair), 1.5, damping, 0.0)
}

/// Returns the law of a stiffness K, N/m^(8/5), and a damping C, N s/m^(9/5).
///
/// The law F = K ξ^(8/5) + C ξ^(4/5) ξ̇.
///
/// Mishra & Murty (2001), fitted to drop tests for ball mills; Bordbar & Hyppänen (2007), section 3-2.
/// K and C are measured for one pair of bodies: no elastic theory gives the exponent 8/5. Limits: the
/// pair and the speeds of the fit.
///
/// # Errors
/// K not positive and finite, C negative or not finite.
pub fn mishra_murty(stiffness: f64, damping: f64) -> Result<ContactLaw, LawError> {
    power(stiffness, 1.6, damping, 0.8)
}

/// Returns the law of a pair for η₁, Pa s, and η₂, in (−1, 1).
///
/// Hertz' spring with a damping of the spring's own form.
///
/// ```math
/// F = K\xi^{3/2} + C\sqrt\xi\,\dot\xi, \qquad C = \frac{2\eta_1}{3(1-\eta_2^2)}\sqrt{R^*}
/// ```
///
/// Morgado & Oppenheim (1997), as Bordbar & Hyppänen (2007) give it after eq. 16: K for equal spheres,
/// (2/3) E √R*/(1−ν²), with E and ν replaced by the viscoelastic coefficients η₁ and η₂. Limits: equal
/// materials, a mild loss; the coefficients are hard to find for any material.
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

/// Returns the law of a pair, a dissipation time A, s, and an exponent n.
///
/// The paper's own law: Hertz' spring with a damping of free exponent.
///
/// ```math
/// F = \tfrac43E^*\sqrt{R^*}\,\xi^{3/2} + 2A\,E^*R^{*(1-n)}\,\xi^n\dot\xi
/// ```
///
/// Bordbar & Hyppänen (2007), eq. 18, which divides it by m*; A in s and n are fitted to measured
/// restitutions (the paper: n = 0.65 for ice, n = 1 for glass). For n = 1/2 it is
/// [`super::kuwabara_kono()`]. Limits: the range of the fit; the dissipated share scales as
/// v^((4n−1)/5), so a restitution that falls with speed needs n > 1/4.
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
