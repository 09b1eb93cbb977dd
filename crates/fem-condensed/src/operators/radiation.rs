//! Radiation of waves from a body so large that they do not return within the contact.
//!
//! A body that is much larger than the path of waves within the contact time acts as a half-space. To first order
//! in frequency, a force F on a small area displaces it by
//!
//! ```math
//! u = S F - \gamma\dot F, \qquad \gamma = \frac{C(\nu)}{\mu c_s},
//! ```
//!
//! equally at all points of the contact, and radiates the power γ Ḟ² (Lamb 1904; Miller & Pursey 1955; Hunter 1957).
//! The term −γ Ḟ alone makes the compliance negative at high frequencies, and is unstable. A passive element that
//! agrees to first order creeps with a time τ, in series with a body whose instantaneous compliance is lower by γ/τ:
//!
//! ```math
//! \frac{-\gamma s}{1+\tau s} = -\frac\gamma\tau + \frac{\gamma/\tau}{1+\tau s}, \qquad
//! u = -\gamma\dot y, \qquad y + \tau\dot y = F .
//! ```
//!
//! The instantaneous compliance is positive as long as γ/τ is less than 1/k, that under a rigid punch over all
//! points. So τ = [`LAG_OVER_SHORTEST`] γ k, a few times the time of a wave across the contact. The energy supplied is
//!
//! ```math
//! \int F\dot u\,dt = -\gamma\dot y\left(y + \tfrac12\tau\dot y\right) + \int\gamma\dot y^2\,dt,
//! ```
//!
//! The first term is stored (together with the strain energy it is never negative), the second radiated. They tend
//! to −γ F Ḟ and ∫γ Ḟ² as τ → 0, and the loss is exact to second order in τ over the contact time.
//!
//! Two radiating bodies are one element with the sum of their γ. Limits: small losses; waves do not return within
//! the contact. For a relaxing body γ is a constant of its effective moduli, while τ follows from its instantaneous
//! stiffness, so that the loss is underestimated the more, the more the body relaxes.

/// τ/(γ k), the lag over the shortest one with a positive compliance.
const LAG_OVER_SHORTEST: f64 = 2.0;

/// State of the radiated waves of both bodies.
#[derive(Debug, Clone)]
pub(crate) struct WaveRadiation {
    /// Radiation coefficient γ of each body, s m/N.
    coefficients: [f64; 2],
    /// Sum of both coefficients.
    total: f64,
    /// Lag τ, s.
    lag: f64,
    /// Coefficients of a step, y_{n+1} = `before[0]` y_n + `before[1]` F_n + `now` F_{n+1}.
    before: [f64; 2],
    now: f64,
    /// Decrease γ (1 − now)/τ of the compliance, m/N.
    stiffening: f64,
    /// Contact force F, N.
    force: f64,
    /// Lagging force y, N.
    lagging_force: f64,
}

impl WaveRadiation {
    /// Creates the state at rest for coefficients γ (s m/N), the stiffness under a rigid punch (N/m) and a time step
    /// (s); `None` if nothing is radiated.
    pub fn new(
        coefficients: [Option<f64>; 2],
        punch_stiffness: f64,
        time_step: f64,
    ) -> Option<Self> {
        let coefficients = coefficients.map(|coefficient| coefficient.unwrap_or(0.0));
        let total = coefficients[0] + coefficients[1];
        if total <= 0.0 {
            return None;
        }
        let lag = LAG_OVER_SHORTEST * total * punch_stiffness;
        // Exact for a force that changes at a constant rate.
        let gone = -(-time_step / lag).exp_m1();
        let mean = gone * lag / time_step;
        Some(Self {
            coefficients,
            total,
            lag,
            before: [1.0 - gone, mean - (1.0 - gone)],
            now: 1.0 - mean,
            stiffening: total * mean / lag,
            force: 0.0,
            lagging_force: 0.0,
        })
    }

    /// Returns the change of the gap at all points within a step per force, m/N; negative.
    pub fn compliance(&self) -> f64 {
        -self.stiffening
    }

    /// Returns y at the end of a step with zero force there, N.
    fn past(&self) -> f64 {
        self.before[0] * self.lagging_force + self.before[1] * self.force
    }

    /// Returns the displacement at the end of a step with zero force there, m.
    pub fn past_displacement(&self) -> f64 {
        self.total / self.lag * self.past()
    }

    /// Returns the current displacement, m.
    pub fn displacement(&self) -> f64 {
        -self.total * self.rate()
    }

    /// Advances to the end of a step with this force, N.
    pub fn advance(&mut self, force: f64) {
        self.lagging_force = self.past() + self.now * force;
        self.force = force;
    }

    /// Returns ẏ, N/s.
    fn rate(&self) -> f64 {
        (self.force - self.lagging_force) / self.lag
    }

    /// Returns the energy stored in the element, J.
    pub fn stored(&self) -> f64 {
        let rate = self.rate();
        -self.total * rate * (self.lagging_force + 0.5 * self.lag * rate)
    }

    /// Returns the power radiated by each body, W.
    pub fn power(&self) -> [f64; 2] {
        let rate = self.rate();
        self.coefficients.map(|coefficient| coefficient * rate * rate)
    }
}
