//! A density, instantaneous moduli and, if the material relaxes, a Prony series, or if it flows, a flow rule.
//!
//! ```math
//! G(t) = G_0\, g(t), \qquad K(t) = K_0\, g(t) \text{ or } K_0, \qquad
//! c_d = \sqrt{(K_0+\tfrac43 G_0)/\rho}, \quad c_s = \sqrt{G_0/\rho}
//! ```
//!
//! A wave front travels at the speed of the instantaneous moduli. E(t) and ν(t) are formed from
//! K(t) and G(t) by the elastic identities. So ν(t) is not the viscoelastic Poisson's ratio of a creep or relaxation
//! test.

use crate::elastic::ElasticModuli;
use crate::error::{MaterialError, positive};
use crate::finite::HyperelasticLaw;
use crate::flow::FlowRule;
use crate::prony::{ActsOn, PronySeries};

/// A checked isotropic material: elastic, viscoelastic or elastic–plastic.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    density: f64,
    instantaneous: ElasticModuli,
    relaxation: Option<PronySeries>,
    law: Option<HyperelasticLaw>,
    flow: Option<Box<FlowRule>>,
}

impl Material {
    /// Creates a material from a density (kg/m³), instantaneous moduli and a relaxation; without one it is elastic.
    ///
    /// # Errors
    /// A density that is not positive and finite.
    pub fn new(
        density: f64,
        instantaneous: ElasticModuli,
        relaxation: Option<PronySeries>,
    ) -> Result<Self, MaterialError> {
        let density = positive("density", density)?;
        Ok(Self { density, instantaneous, relaxation, law: None, flow: None })
    }

    /// Sets the law at finite strain; it has no effect at small strain.
    #[must_use]
    pub fn with_law(self, law: HyperelasticLaw) -> Self {
        Self { law: Some(law), ..self }
    }

    /// Adds plastic flow, which is computed at finite strain with Hencky's law.
    ///
    /// # Errors
    /// The material relaxes, or its law is another one.
    pub fn with_flow(self, flow: FlowRule) -> Result<Self, MaterialError> {
        if self.relaxation.is_some() {
            return Err(MaterialError::FlowWithRelaxation);
        }
        match self.law {
            None | Some(HyperelasticLaw::Hencky) => Ok(Self { flow: Some(Box::new(flow)), ..self }),
            Some(law) => Err(MaterialError::FlowWithLaw { law: law.name() }),
        }
    }

    /// Returns the elastic material with the same density and instantaneous moduli.
    pub fn without_relaxation(&self) -> Self {
        Self { relaxation: None, ..self.clone() }
    }

    /// Returns the material without plastic flow; the law of a material that flowed stays Hencky's.
    pub fn without_flow(&self) -> Self {
        let law = if self.flow.is_some() { Some(self.law()) } else { self.law };
        Self { flow: None, law, ..self.clone() }
    }

    /// Returns the elastic material with the same density and the equilibrium moduli;
    /// `None` for a fluid.
    pub fn at_equilibrium(&self) -> Option<Self> {
        let Some(series) = &self.relaxation else { return Some(self.clone()) };
        let left = series.equilibrium_weight();
        let bulk_left = if self.bulk_relaxes() { left } else { 1.0 };
        let now = &self.instantaneous;
        let bulk = now.bulk_modulus() * bulk_left;
        let moduli = ElasticModuli::from_bulk_shear(bulk, now.shear_modulus() * left).ok()?;
        Some(Self { instantaneous: moduli, relaxation: None, ..self.clone() })
    }

    /// Returns the density ρ, kg/m³.
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Returns the law at finite strain; the default is neo-Hooke's, and Hencky's for a material that flows.
    pub fn law(&self) -> HyperelasticLaw {
        let default = match self.flow {
            Some(_) => HyperelasticLaw::Hencky,
            None => HyperelasticLaw::default(),
        };
        self.law.unwrap_or(default)
    }

    /// Returns the law at finite strain, if it was set.
    pub fn named_law(&self) -> Option<HyperelasticLaw> {
        self.law
    }

    /// Returns the instantaneous moduli.
    pub fn instantaneous(&self) -> &ElasticModuli {
        &self.instantaneous
    }

    /// Returns the relaxation; `None` for an elastic material.
    pub fn relaxation(&self) -> Option<&PronySeries> {
        self.relaxation.as_ref()
    }

    /// Returns the flow rule; `None` for a material that does not flow plastically.
    pub fn flow(&self) -> Option<&FlowRule> {
        self.flow.as_deref()
    }

    /// Returns G at `time` (s) after a step of strain.
    pub fn shear_modulus_at(&self, time: f64) -> f64 {
        self.instantaneous.shear_modulus() * self.shear_fraction(time)
    }

    /// Returns K at `time` (s) after a step of strain.
    pub fn bulk_modulus_at(&self, time: f64) -> f64 {
        if self.bulk_relaxes() {
            self.instantaneous.bulk_modulus() * self.shear_fraction(time)
        } else {
            self.instantaneous.bulk_modulus()
        }
    }

    /// Returns the equilibrium shear modulus G∞.
    pub fn equilibrium_shear_modulus(&self) -> f64 {
        let weight = self.relaxation.as_ref().map_or(1.0, PronySeries::equilibrium_weight);
        self.instantaneous.shear_modulus() * weight
    }

    /// Returns the speed of dilatational waves c_d, m/s.
    pub fn dilatational_wave_speed(&self) -> f64 {
        (self.instantaneous.p_wave_modulus() / self.density).sqrt()
    }

    /// Returns the speed of shear waves c_s, m/s.
    pub fn shear_wave_speed(&self) -> f64 {
        (self.instantaneous.shear_modulus() / self.density).sqrt()
    }

    fn shear_fraction(&self, time: f64) -> f64 {
        self.relaxation.as_ref().map_or(1.0, |series| series.relaxation(time))
    }

    fn bulk_relaxes(&self) -> bool {
        self.relaxation.as_ref().is_some_and(|series| series.acts_on() == ActsOn::All)
    }
}
