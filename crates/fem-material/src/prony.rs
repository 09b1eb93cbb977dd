//! Relaxation as a Prony series: an equilibrium spring in parallel with Maxwell elements.
//!
//! ```math
//! g(t) = g_\infty + \sum_k g_k e^{-t/\tau_k}, \qquad g_\infty = 1 - \sum_k g_k,
//! \qquad G(t) = G_0\, g(t)
//! ```
//!
//! Under a strain e^{iωt} the complex modulus is iω ∫ G(s) e^{−iωs} ds over s > 0, which is the sum of a spring and of
//! Maxwell elements; its parts are the storage and the loss modulus
//!
//! ```math
//! \frac{G'}{G_0} = g_\infty + \sum_k g_k \frac{\omega^2\tau_k^2}{1+\omega^2\tau_k^2},
//! \qquad \frac{G''}{G_0} = \sum_k g_k \frac{\omega\tau_k}{1+\omega^2\tau_k^2}
//! ```
//!
//! The weights g_k = G_k/G_0 refer to the instantaneous modulus. Non-negative weights and
//! positive times make g completely monotonic, so no strain history gains energy.

use crate::error::{MaterialError, not_negative, positive};
use crate::prony_merging::merged;

/// One Maxwell element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PronyTerm {
    /// Weight g_k = G_k/G_0, at least 0.
    pub weight: f64,
    /// Relaxation time τ_k, s.
    pub relaxation_time: f64,
}

/// Which moduli relax.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// Shear and bulk modulus alike: Poisson's ratio stays constant.
    All,
    /// The shear modulus; the bulk modulus stays elastic.
    Shear,
}

/// A checked relaxation function.
#[derive(Debug, Clone, PartialEq)]
pub struct PronySeries {
    terms: Vec<PronyTerm>,
    acts_on: ActsOn,
    equilibrium_weight: f64,
}

/// Weights such as ten times 0.1 sum to 1 only up to rounding.
const WEIGHT_SUM_ROUNDING: f64 = 1e-12;

impl PronySeries {
    /// Creates a series of at least one term; the weights sum to at most 1 (with 1e-12 for rounding).
    ///
    /// # Errors
    /// No term, a negative or non-finite weight, a sum above 1, a relaxation time that is not
    /// positive and finite.
    pub fn new(terms: Vec<PronyTerm>, acts_on: ActsOn) -> Result<Self, MaterialError> {
        if terms.is_empty() {
            return Err(MaterialError::NoRelaxationTerms);
        }
        for (index, term) in terms.iter().enumerate() {
            let PronyTerm { weight, relaxation_time } = *term;
            if !(weight >= 0.0 && weight.is_finite()) {
                return Err(MaterialError::RelaxationWeight { index, value: weight });
            }
            if !(relaxation_time > 0.0 && relaxation_time.is_finite()) {
                return Err(MaterialError::RelaxationTime { index, value: relaxation_time });
            }
        }
        let sum: f64 = terms.iter().map(|term| term.weight).sum();
        if sum > 1.0 + WEIGHT_SUM_ROUNDING {
            return Err(MaterialError::RelaxationWeightSum { sum });
        }
        Ok(Self { terms, acts_on, equilibrium_weight: (1.0 - sum).max(0.0) })
    }

    /// Creates the three-parameter solid: a spring k₁ in series with a Kelvin element (spring k₂ parallel to
    /// dashpot η), fig. 5 of Bordbar & Hyppänen (2007).
    ///
    /// The stress is common, the strains add: σ = k₁ε₁ = k₂ε₂ + ηε̇₂, ε = ε₁ + ε₂. Hold ε from
    /// t = 0, when the dashpot has not moved (ε₂ = 0). Eliminating ε₁ leaves
    ///
    /// ```math
    /// \eta\dot\varepsilon_2 + (k_1+k_2)\varepsilon_2 = k_1\varepsilon
    /// \;\Rightarrow\; \varepsilon_2 = \frac{k_1\varepsilon}{k_1+k_2}\,(1-e^{-t/\tau}),
    /// \quad \tau = \frac{\eta}{k_1+k_2},
    /// ```
    /// ```math
    /// \frac{\sigma}{k_1\varepsilon} = 1-\frac{\varepsilon_2}{\varepsilon}
    /// = \frac{k_2}{k_1+k_2} + \frac{k_1}{k_1+k_2}\,e^{-t/\tau}.
    /// ```
    ///
    /// So k₁ is the instantaneous modulus, and one term has the weight k₁/(k₁+k₂). With k₂ = 0
    /// it is Maxwell's fluid. Moduli in Pa, viscosity in Pa s (or any consistent set).
    ///
    /// # Errors
    /// A series stiffness or viscosity that is not positive and finite, a Kelvin stiffness that
    /// is negative or not finite.
    pub fn three_parameter_solid(
        series_stiffness: f64,
        kelvin_stiffness: f64,
        kelvin_viscosity: f64,
        acts_on: ActsOn,
    ) -> Result<Self, MaterialError> {
        let series = positive("series_stiffness", series_stiffness)?;
        let viscosity = positive("kelvin_viscosity", kelvin_viscosity)?;
        let kelvin = not_negative("kelvin_stiffness", kelvin_stiffness)?;
        let term = PronyTerm {
            weight: series / (series + kelvin),
            relaxation_time: viscosity / (series + kelvin),
        };
        Self::new(vec![term], acts_on)
    }

    /// Returns the same relaxation, within 1e-9 of its weights at any time, with at most seven terms in an octave of rates; with
    /// as many or fewer the series is unchanged.
    pub fn merged(self) -> Self {
        let Self { terms, acts_on, equilibrium_weight } = self;
        Self { terms: merged(terms), acts_on, equilibrium_weight }
    }

    /// Returns g at `time` (s) after a step of strain; 1 at and before 0, up to the rounding of the sum.
    pub fn relaxation(&self, time: f64) -> f64 {
        relaxation_at(self.equilibrium_weight, &self.terms, time)
    }

    /// Returns storage and loss modulus, both over G_0, at an angular frequency (rad/s), at least 0.
    pub fn complex_modulus(&self, angular_frequency: f64) -> [f64; 2] {
        self.terms.iter().fold([self.equilibrium_weight, 0.0], |[storage, loss], term| {
            let [in_phase, out_of_phase] =
                maxwell_element(angular_frequency * term.relaxation_time);
            [storage + term.weight * in_phase, loss + term.weight * out_of_phase]
        })
    }

    /// Returns the equilibrium weight g∞, in 0 ..= 1.
    pub fn equilibrium_weight(&self) -> f64 {
        self.equilibrium_weight
    }

    /// Returns whether any term has a weight: a series without one is an elastic material.
    pub fn relaxes(&self) -> bool {
        self.terms.iter().any(|term| term.weight > 0.0)
    }

    /// Returns the Maxwell elements, in the order given.
    pub fn terms(&self) -> &[PronyTerm] {
        &self.terms
    }

    /// Returns which moduli relax.
    pub fn acts_on(&self) -> ActsOn {
        self.acts_on
    }
}

/// Returns g∞ + Σ g_k e^(−t/τ_k) at `time` (s) after a step, or its value at 0 before that.
pub fn relaxation_at(equilibrium_weight: f64, terms: &[PronyTerm], time: f64) -> f64 {
    let elapsed = if time < 0.0 { 0.0 } else { time };
    let decaying: f64 =
        terms.iter().map(|term| term.weight * (-elapsed / term.relaxation_time).exp()).sum();
    equilibrium_weight + decaying
}

/// Returns storage and loss modulus of a Maxwell element over its modulus at x = ωτ: x²/(1 + x²) and x/(1 + x²).
#[inline]
pub fn maxwell_element(x: f64) -> [f64; 2] {
    // A quotient below 1 does not overflow.
    if x > 1.0 {
        let y = x.recip();
        [(1.0 + y * y).recip(), y / (1.0 + y * y)]
    } else {
        [x * x / (1.0 + x * x), x / (1.0 + x * x)]
    }
}
