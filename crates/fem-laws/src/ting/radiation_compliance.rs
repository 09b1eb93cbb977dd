//! Waves that leave, as a compliance in series with a contact.
//!
//! A body so large that they do not come back moves by u = S F − γ Ḟ ([`crate::radiation_damping`]):
//! the far field comes nearer by −γ Ḟ than the contact alone lets it. That is the first order of low
//! frequencies; taken at its word it runs away. The passive body that agrees with it to that order is
//!
//! ```math
//! -\gamma s\;\to\;\frac{-\gamma s}{1+\tau s}, \qquad
//! \delta = u + \ldots + \frac\gamma\tau\,(f-F), \qquad \tau\dot f = F-f,
//! ```
//!
//! with the slow force f. Its work splits exactly into what is gone and what is held,
//!
//! ```math
//! \int F\,\mathrm d\Bigl[\tfrac\gamma\tau(f-F)\Bigr]
//! = \gamma\int\dot f^2\,\mathrm dt + \frac{\gamma}{2\tau}(f^2-F^2),
//! ```
//!
//! (ḟ = (F−f)/τ) so that what is radiated is never negative. Loaded fast the contact is the stiffer, and
//! it stays stable while γ F′(u) < τ. Taken is
//!
//! ```math
//! \tau = \max\bigl(2.5\,\gamma F'(u_{\max}),\; 0.0025\,T\bigr):
//! ```
//!
//! the first is some a/c_s, which is what a half-space itself remembers; the loss is too small by the
//! order of (τ/T)², 4e-4 of itself by the second. Waves back and forth in the contact itself, of the next
//! order in a/(c_s T), are left out.
//!
//! Everything is dimensionless; see [`crate::ting`].

use crate::finite_size::correction::Correction;
use crate::numerics::exp;
use crate::ting::collocation::{Interpolation, N, POINTS, Vector, derivative, dot, fading_moments};

/// Times γ F′(u_max) that τ is at least.
const STIFFNESS_TIMES: f64 = 2.5;

/// Share of the contact time that τ is at least. As many steps as without waves are enough.
pub(crate) const SHARE_OF_CONTACT: f64 = 0.0025;

/// The same for a forecast.
pub(crate) const COARSE_SHARE_OF_CONTACT: f64 = 0.01;

/// The constants of waves that leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Radiation {
    /// The ratio γ/τ.
    pub compliance: f64,
    /// The rate 1/τ.
    pub rate: f64,
}

impl Radiation {
    /// Creates the compliance from γ, the largest Hertz approach u and the contact time of the same
    /// collision without waves, and the smallest τ as a share of that contact time.
    pub fn new(damping: f64, largest: f64, contact_time: f64, share: f64) -> Self {
        let stiffness = 1.5 * largest.sqrt();
        let time = (STIFFNESS_TIMES * damping * stiffness).max(share * contact_time);
        Self { compliance: damping / time, rate: time.recip() }
    }

    /// Returns the approach that radiation adds, at a force and a slow force.
    pub fn approach(&self, force: f64, slow_force: f64) -> f64 {
        self.compliance * (slow_force - force)
    }

    /// Returns the rate ḟ.
    pub fn slow_rate(&self, force: f64, slow_force: f64) -> f64 {
        self.rate * (force - slow_force)
    }

    /// Returns the radiated power γ ḟ².
    pub fn power(&self, force: f64, slow_force: f64) -> f64 {
        self.compliance * self.rate * (force - slow_force).powi(2)
    }

    /// Returns the energy stored in the body near the contact: negative while the force is above the slow one.
    pub fn held(&self, force: f64, slow_force: f64) -> f64 {
        0.5 * self.compliance * (slow_force - force) * (slow_force + force)
    }
}

/// The slow force of a step as far as it is known before the force is.
pub(crate) struct SlowForce {
    radiation: Radiation,
    /// At the points, of the past.
    faded: Vector,
    weights: [Vector; N],
    /// Share of a change of u^(3/2) within the step that the force shows, about.
    response: f64,
}

/// Effect of the waves at the points of a step, by the last iteration of its force.
pub(crate) struct Waves {
    /// Effect of the force that follows u at once.
    correction: Correction,
    /// Part of the approach, and of its rate, by the slow force and by what of the force lags behind.
    approach: Vector,
    rate: Vector,
}

/// From a fifth to rounding.
const NEWTON_ITERATIONS: usize = 6;

impl SlowForce {
    pub fn new(
        radiation: Radiation,
        interpolation: &Interpolation,
        length: f64,
        start: f64,
        response: f64,
    ) -> Self {
        let z = radiation.rate * length;
        let faded = POINTS.map(|theta| exp(-z * theta) * start);
        let weights = POINTS
            .map(|theta| interpolation.weights(&fading_moments(theta, z)).map(|weight| z * weight));
        Self { radiation, faded, weights, response }
    }

    /// Returns the waves for forces and Hertz' approaches at the points.
    pub fn waves(
        &self,
        interpolation: &Interpolation,
        length: f64,
        correction: Correction,
        force: &Vector,
        hertz: &Vector,
    ) -> Waves {
        let Radiation { compliance, .. } = self.radiation;
        let lag: Vector =
            std::array::from_fn(|i| force[i] - self.response * hertz[i] * hertz[i].sqrt());
        let lag_polynomial = interpolation.coefficients(&lag);
        let slow: Vector = std::array::from_fn(|i| self.faded[i] + dot(&self.weights[i], force));
        Waves {
            correction: Correction {
                alpha: correction.alpha - compliance * self.response,
                ..correction
            },
            approach: std::array::from_fn(|i| compliance * (slow[i] - lag[i])),
            rate: std::array::from_fn(|i| {
                let lag_rate = derivative(&lag_polynomial, POINTS[i]) / length;
                compliance * (self.radiation.slow_rate(force[i], slow[i]) - lag_rate)
            }),
        }
    }
}

impl Waves {
    /// Returns u and ∂u/∂δ at point `i`, and the part of the rate from the contact itself.
    pub fn hertz_approach(
        &self,
        i: usize,
        approach: f64,
        rate: f64,
        remembered: &Correction,
    ) -> (f64, f64, f64) {
        let own = approach - self.approach[i];
        let (hertz, slope) =
            self.correction.hertz_approach_after(NEWTON_ITERATIONS, own, remembered);
        (hertz, slope, rate - self.rate[i])
    }
}
