//! Collision of two elastic spheres with Hertz' force.
//!
//! The contact force at the approach δ is that of two half-spaces (Hertz 1882; Johnson, *Contact
//! Mechanics*, eq. 4.23); with it, energy and the equation of motion m* δ̈ = −F give
//!
//! ```math
//! F = K\delta^{3/2}, \quad K = \tfrac43 E^*\sqrt{R^*}, \qquad
//! \tfrac12 m^*v^2 = \tfrac25 K\delta_{\max}^{5/2},
//! ```
//! ```math
//! T = 2\int_0^{\delta_{\max}}\!\!\frac{\mathrm d\delta}{\dot\delta}
//! = \frac{2\delta_{\max}}{v}\int_0^1\!\frac{\mathrm dx}{\sqrt{1-x^{5/2}}}
//! = \frac{2\sqrt\pi\,\Gamma(7/5)}{\Gamma(9/10)}\,\frac{\delta_{\max}}{v},
//! \qquad a = \sqrt{R^*\delta}, \quad p_0 = \frac{2E^*}{\pi}\sqrt{\delta/R^*}.
//! ```
//!
//! Limits: a ≪ R, small strain, no friction, no vibration (v far below the wave speeds), no loss.
//! A sphere is a little stiffer than a half-space, by first order in a/R.

mod history;
mod pressure;
mod static_contact;
mod stress_field;

use std::f64::consts::PI;

use statrs::function::gamma::gamma;

use crate::error::{LawError, positive};
use crate::pair::Pair;
pub use history::HertzInstant;
pub use pressure::{AxisStress, HertzPressure};
pub use static_contact::StaticHertz;

/// One collision, from first touch to separation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzImpact {
    pair: Pair,
    approach_speed: f64,
    stiffness: f64,
    max_approach: f64,
}

impl HertzImpact {
    /// Creates the collision of a pair at an approach speed, m/s.
    ///
    /// # Errors
    /// A speed that is not positive and finite; values so extreme that a result leaves the range
    /// of f64.
    pub fn new(pair: &Pair, approach_speed: f64) -> Result<Self, LawError> {
        let speed = positive("approach_speed", approach_speed)?;
        let stiffness = 4.0 / 3.0 * pair.contact_modulus() * pair.effective_radius().sqrt();
        // The powers are taken apart so that v² cannot leave the range of f64.
        let max_approach = (1.25 * (pair.effective_mass() / stiffness)).powf(0.4) * speed.powf(0.8);
        let impact = Self { pair: *pair, approach_speed, stiffness, max_approach };
        positive("hertz contact_time", impact.contact_time())?;
        positive("hertz peak_force", impact.peak_force())?;
        positive("hertz peak_pressure", impact.peak_pressure())?;
        Ok(impact)
    }

    /// Returns the pair of bodies.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// Returns the approach speed v, m/s.
    pub fn approach_speed(&self) -> f64 {
        self.approach_speed
    }

    /// Returns the stiffness K of Hertz' spring, N/m^(3/2).
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the relative speed after over before: Hertz' collision loses nothing.
    pub fn restitution(&self) -> f64 {
        1.0
    }

    /// Returns the contact time T, s.
    pub fn contact_time(&self) -> f64 {
        contact_time_coefficient() * (self.max_approach / self.approach_speed)
    }

    /// Returns the largest force, N, at T/2.
    pub fn peak_force(&self) -> f64 {
        self.force(self.max_approach)
    }

    /// Returns the largest approach δ_max, m.
    pub fn max_approach(&self) -> f64 {
        self.max_approach
    }

    /// Returns the largest contact radius, m.
    pub fn max_contact_radius(&self) -> f64 {
        self.pressure(self.max_approach).contact_radius
    }

    /// Returns the largest pressure, Pa, which acts on the axis at T/2.
    pub fn peak_pressure(&self) -> f64 {
        self.pressure(self.max_approach).peak_pressure
    }

    /// Returns F, N, at an approach, m; 0 when the contact is open (δ < 0).
    pub fn force(&self, approach: f64) -> f64 {
        let closed = closed(approach);
        self.stiffness * closed * closed.sqrt()
    }

    /// Returns the pressure distribution at an approach, m; zero when the contact is open (δ < 0).
    pub fn pressure(&self, approach: f64) -> HertzPressure {
        let closed = closed(approach);
        let radius = self.pair.effective_radius();
        HertzPressure {
            contact_radius: radius.sqrt() * closed.sqrt(),
            peak_pressure: 2.0 / PI * self.pair.contact_modulus() * (closed / radius).sqrt(),
        }
    }
}

/// Returns T v/δ_max = 2√π Γ(7/5)/Γ(9/10) = 2.94328.
pub fn contact_time_coefficient() -> f64 {
    2.0 * PI.sqrt() * gamma(1.4) / gamma(0.9)
}

fn closed(approach: f64) -> f64 {
    if approach < 0.0 { 0.0 } else { approach }
}
