//! Kelvin's damping of Hertz' contact with its coefficient from material data.
//!
//! ```math
//! C = C_n\frac{E}{1-\nu^2}\sqrt{R^*} = 2C_nE^*\sqrt{R^*}, \quad n = \tfrac12, \qquad
//! C_n = A = \frac{(3\eta_2-\eta_1)^2}{3(3\eta_2+2\eta_1)}\,\frac{(1-\nu^2)(1-2\nu)}{E\nu^2}
//! ```
//!
//! Schwager & Pöschel (1998); Bordbar & Hyppänen (2007), eq. 14, whose division by m* makes it an
//! acceleration. The second form of C also holds for unlike materials (eq. 17). It is
//! [`super::kuwabara_kono`] with A = C_n; A from the viscosities of shear η₁ and bulk η₂ is
//! Brilliantov et al. (1996), eq. 20. Limits: Kelvin's solid, a mild loss; ν away from 0, where A
//! diverges.

use fem_material::ElasticModuli;

use super::power::{ContactLaw, power};
use super::published::hertz_stiffness;
use crate::error::{LawError, not_negative, positive};
use crate::family::{LawContext, LawInput, LawInputError, LawValues};
use crate::pair::Pair;

/// Returns the law of a pair for C_n, s.
///
/// # Errors
/// C_n negative or not finite.
pub fn schwager_poeschel(pair: &Pair, normal_damping: f64) -> Result<ContactLaw, LawError> {
    let time = not_negative("normal_damping", normal_damping)?;
    let damping = 2.0 * time * pair.contact_modulus() * pair.effective_radius().sqrt();
    power(hertz_stiffness(pair), 1.5, damping, 0.5)
}

/// Returns A, s, of moduli and the viscosities of shear and bulk, Pa s.
///
/// # Errors
/// A viscosity that is not positive and finite; ν = 0.
pub fn dissipation_time(
    moduli: &ElasticModuli,
    shear_viscosity: f64,
    bulk_viscosity: f64,
) -> Result<f64, LawError> {
    let shear = positive("shear_viscosity", shear_viscosity)?;
    let bulk = positive("bulk_viscosity", bulk_viscosity)?;
    let nu = moduli.poissons_ratio();
    let viscosity = (3.0 * bulk - shear).powi(2) / (3.0 * (3.0 * bulk + 2.0 * shear));
    let shape = (1.0 - nu * nu) * (1.0 - 2.0 * nu) / (nu * nu);
    not_negative("dissipation_time", viscosity * shape / moduli.youngs_modulus())
}

/// Returns C_n as given, or that of the viscosities of one material.
///
/// # Errors
/// A viscosity that is not positive and finite; ν = 0; two walls; bodies of different materials.
pub fn schwager_poeschel_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let (Some(shear), Some(bulk)) = (law.get("eta_1"), law.get("eta_2")) else {
        return Ok((vec![law.get("a").unwrap_or_default()], context.pair));
    };
    let mut moduli = context.materials.iter().flatten().map(|material| material.instantaneous());
    let Some(first) = moduli.next() else { return Err(LawError::TwoWalls.into()) };
    if moduli.any(|other| other != first) {
        return Err(LawInputError::Materials {
            message: "the viscosities of schwager_poeschel are those of one material, and the \
                      bodies' differ",
            help: "give a, or take kuwabara_kono",
        });
    }
    Ok((vec![dissipation_time(first, shear, bulk)?], context.pair))
}
