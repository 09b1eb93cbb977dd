//! Hertz' spring with the damping of a Kelvin solid.
//!
//! ```math
//! F = K\left(\xi^{3/2} + \tfrac32 A\sqrt\xi\,\dot\xi\right), \qquad K = \tfrac43 E^*\sqrt{R^*}
//! ```
//!
//! Kuwabara & Kono (1987); Brilliantov, Spahn, Hertzsch & Pöschel (1996); Bordbar & Hyppänen (2007),
//! eqs. 12 and 13. It is the first order in A of K (ξ + A ξ̇)^(3/2), eq. 11. Limits: A ξ̇ ≪ ξ but for
//! a share of the contact time, so a mild loss.
//!
//! A from the viscosities of Kelvin's solid, shear η₁ (deviatoric stress 2η₁ė) and bulk η₂: the
//! correspondence principle puts G + η₁s and K + η₂s into the contact modulus
//! 4G(3K+G)/(3K+4G) = E/(1−ν²), and A is the first order in s,
//!
//! ```math
//! A_i = \frac{\mathrm d}{\mathrm ds}\ln\frac{E_i}{1-\nu_i^2}\Big|_0 = \frac{1+\nu}{(1-\nu)E}
//! \left[\tfrac43\eta_1(1-\nu+\nu^2) + \eta_2(1-2\nu)^2\right], \qquad
//! A = E^*\sum_i\frac{1-\nu_i^2}{E_i}A_i,
//! ```
//!
//! the form of Goldobin, Susloparov, Pimenova & Brilliantov (2015). It corrects that of Brilliantov
//! et al. (1996), [`super::dissipation_time`], which has no loss at ν = 1/2 and none of the third
//! law between unlike bodies.

use fem_material::ElasticModuli;

use super::power::{ContactLaw, power};
use super::published::hertz_stiffness;
use crate::error::{LawError, not_negative};
use crate::family::{LawContext, LawInput, LawInputError, LawValues};
use crate::pair::Pair;

/// Returns the law of a pair and its dissipation time A, s.
///
/// # Errors
/// `dissipation_time` is negative or not finite.
pub fn kuwabara_kono(pair: &Pair, dissipation_time: f64) -> Result<ContactLaw, LawError> {
    let stiffness = hertz_stiffness(pair);
    let time = not_negative("dissipation_time", dissipation_time)?;
    power(stiffness, 1.5, 1.5 * time * stiffness, 0.5)
}

/// Returns A, s, of the viscosities of shear and bulk, Pa s, that both bodies have; `None` is a rigid wall.
///
/// # Errors
/// A viscosity that is negative or not finite; two walls.
pub fn corrected_dissipation_time(
    bodies: [Option<&ElasticModuli>; 2],
    shear_viscosity: f64,
    bulk_viscosity: f64,
) -> Result<f64, LawError> {
    let shear = not_negative("shear_viscosity", shear_viscosity)?;
    let bulk = not_negative("bulk_viscosity", bulk_viscosity)?;
    let (mut compliance, mut weighted) = (0.0, 0.0);
    for moduli in bodies.into_iter().flatten() {
        let nu = moduli.poissons_ratio();
        let viscosity = 4.0 / 3.0 * shear * (1.0 - nu + nu * nu) + bulk * (1.0 - 2.0 * nu).powi(2);
        let time = (1.0 + nu) / (1.0 - nu) * viscosity / moduli.youngs_modulus();
        let share = moduli.plane_strain_modulus().recip();
        compliance += share;
        weighted += share * time;
    }
    if compliance == 0.0 {
        return Err(LawError::TwoWalls);
    }
    not_negative("dissipation_time", weighted / compliance)
}

/// Returns A as given, that of viscosities, or that of Kelvin's solid as the slow limit of the materials:
/// then with the pair's relaxed moduli.
///
/// # Errors
/// A viscosity that is negative or not finite; two walls; no material relaxes, or one flows.
pub fn kuwabara_kono_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    const GIVE: &str = "give a, or eta_1 and eta_2";
    if let Some(time) = law.get("a") {
        return Ok((vec![time], context.pair));
    }
    if let (Some(shear), Some(bulk)) = (law.get("eta_1"), law.get("eta_2")) {
        let moduli = context.materials.map(|material| Some(material?.instantaneous()));
        return Ok((vec![corrected_dissipation_time(moduli, shear, bulk)?], context.pair));
    }
    let relaxation = context.relaxation;
    if relaxation.terms().is_empty() {
        let message = "no material relaxes, so nothing gives kuwabara_kono its dissipation";
        return Err(LawInputError::Materials { message, help: GIVE });
    }
    let Some(time) = relaxation.dissipation_time() else {
        let message = "a material flows (its weights sum to 1), so it has no slow limit with a \
                       lasting stiffness";
        return Err(LawInputError::Materials { message, help: GIVE });
    };
    Ok((vec![time], context.pair.with_modulus_share(relaxation.equilibrium_weight())?))
}
