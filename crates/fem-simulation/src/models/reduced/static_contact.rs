//! The contact of a reduced model under a force that stays.

use fem_collision::StaticContact;
use fem_laws::laws::ContactLaw;
use fem_laws::{LawError, Pair, StaticHertz};

use super::collision::HERTZ_EXPONENT;

/// Hertz' contact with what is left of the modulus; `None` if nothing is left.
///
/// # Errors
/// Values that leave the range of f64.
pub(super) fn of_hertz(
    pair: &Pair,
    equilibrium_weight: f64,
    force: f64,
) -> Result<Option<StaticContact>, LawError> {
    if equilibrium_weight == 0.0 {
        return Ok(None);
    }
    let hertz = StaticHertz::new(&pair.with_modulus_share(equilibrium_weight)?, force)?;
    Ok(Some(StaticContact {
        force,
        approach: hertz.approach,
        contact_radius: Some(hertz.contact_radius),
        centre_pressure: Some(hertz.peak_pressure),
    }))
}

/// The spring of a law alone: F = K δ^γ.
///
/// # Errors
/// Values that leave the range of f64.
pub(super) fn of_law(law: &ContactLaw, pair: &Pair, force: f64) -> Result<StaticContact, LawError> {
    let approach = (force / law.stiffness()).powf(law.elastic_exponent().recip());
    if !(approach > 0.0 && approach.is_finite()) {
        return Err(LawError::NotPositive { quantity: "static approach", value: approach });
    }
    let has_radius = law.elastic_exponent() == HERTZ_EXPONENT;
    let contact_radius = has_radius.then(|| (pair.effective_radius() * approach).sqrt());
    Ok(StaticContact { force, approach, contact_radius, centre_pressure: None })
}
