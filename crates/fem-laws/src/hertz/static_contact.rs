//! Hertz' contact under a constant force.
//!
//! ```math
//! a^3 = \frac{3FR^*}{4E^*}, \qquad \delta = \frac{a^2}{R^*}, \qquad p_0 = \frac{3F}{2\pi a^2}
//! ```
//!
//! Johnson (1985), Contact Mechanics, eqs. 4.22 to 4.24. With equilibrium moduli it is where bodies that
//! relax come to rest.

use std::f64::consts::PI;

use crate::error::{LawError, positive};
use crate::pair::Pair;

/// Two bodies pressed together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticHertz {
    /// Approach δ, m.
    pub approach: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Pressure p₀ on the axis, Pa.
    pub peak_pressure: f64,
}

impl StaticHertz {
    /// Creates the contact of a pair under a constant force, N.
    ///
    /// # Errors
    /// A force that is not positive and finite; values that leave the range of f64.
    pub fn new(pair: &Pair, force: f64) -> Result<Self, LawError> {
        let force = positive("static force", force)?;
        let radius = pair.effective_radius();
        let contact_radius = (0.75 * force / pair.contact_modulus()).cbrt() * radius.cbrt();
        let contact_radius = positive("static contact_radius", contact_radius)?;
        Ok(Self {
            approach: positive("static approach", contact_radius * (contact_radius / radius))?,
            contact_radius,
            peak_pressure: 1.5 * force / (PI * contact_radius * contact_radius),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hertz::HertzImpact;
    use crate::pair::Partner;

    /// At the approach of a force, Hertz' spring has that force and his contact that radius.
    #[test]
    fn static_hertz_equals_the_spring_at_its_force() {
        let ball = Partner::Sphere { radius: 0.01, mass: 0.01, plane_strain_modulus: 2e6 };
        let pair = Pair::new(ball, Partner::Wall).unwrap();
        let at_rest = StaticHertz::new(&pair, 0.1).unwrap();
        let hertz = HertzImpact::new(&pair, 1.0).unwrap();
        let pressure = hertz.pressure(at_rest.approach);
        for (found, expected) in [
            (hertz.force(at_rest.approach), 0.1),
            (at_rest.contact_radius, pressure.contact_radius),
            (at_rest.peak_pressure, pressure.peak_pressure),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        }
        assert!(
            StaticHertz::new(&pair, 0.0).is_err() && StaticHertz::new(&pair, f64::NAN).is_err()
        );
    }
}
