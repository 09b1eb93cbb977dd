//! A pair of bodies under a law of a [`LawFamily`]: restitution and contact time from the law's parameters.

use std::f64::consts::PI;

use fem_laws::laws::ContactLaw;
use fem_laws::{
    EndRule, FiniteSize, FreePlate, HertzImpact, Impact, LawError, LawFamily, LawImpact,
    LawParameter, Pair, PairRelaxation, ParameterRole, Ting,
};
use fem_material::{Material, PronySeries, PronyTerm};
use statrs::function::gamma::gamma;

use crate::estimate::error::FitError;

/// Relative accuracy of a collision: differences over steps of 1e-4 in a parameter are accurate to 1e-5.
const TOLERANCE: f64 = 1e-10;

/// Two bodies, a law and the rule by which a contact ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    pair: Pair,
    materials: [Option<Material>; 2],
    family: LawFamily,
    end_rule: EndRule,
    finite_size: Option<FiniteSize>,
    plate: Option<FreePlate>,
}

/// The results by which collisions are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The restitution e.
    pub restitution: f64,
    /// Contact time T, s; `None` if the bodies stay together.
    pub contact_time: Option<f64>,
}

impl Model {
    /// Creates the model of a pair and the materials of its bodies (`None` is a rigid wall), which only
    /// [`LawFamily::Ting`] uses.
    ///
    /// # Errors
    /// No body relaxes under [`LawFamily::Ting`], or the law ends contacts by another rule.
    pub fn new(
        pair: &Pair,
        materials: [Option<Material>; 2],
        family: LawFamily,
        end_rule: EndRule,
    ) -> Result<Self, FitError> {
        if family.end_rule().is_some_and(|own| own != end_rule) {
            return Err(FitError::OwnEnd { law: family.name() });
        }
        let model =
            Self { pair: *pair, materials, family, end_rule, finite_size: None, plate: None };
        if family == LawFamily::Ting && model.fastest_rate().is_none() {
            return Err(FitError::NoRelaxation);
        }
        Ok(model)
    }

    /// Returns this model with the spheres' own compliance in series, which only [`LawFamily::Ting`] uses.
    pub fn with_finite_size(self, finite_size: FiniteSize) -> Self {
        Self { finite_size: Some(finite_size), ..self }
    }

    /// Returns this model with a plate that bends under the contact.
    pub fn with_plate(self, plate: FreePlate) -> Self {
        Self { plate: Some(plate), ..self }
    }

    /// Returns these bodies under another law, with the end rule of that law if it has one.
    ///
    /// # Errors
    /// Those of [`Model::new`].
    pub fn with_family(&self, family: LawFamily) -> Result<Self, FitError> {
        let end_rule = family.end_rule().unwrap_or(self.end_rule);
        let model = Self::new(&self.pair, self.materials.clone(), family, end_rule)?;
        let (finite_size, plate) = (self.finite_size.clone(), self.plate.clone());
        Ok(Self { finite_size, plate, ..model })
    }

    /// Returns the pair of bodies.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// Returns the family of the law.
    pub fn family(&self) -> LawFamily {
        self.family
    }

    /// Returns the plate that bends under the contact.
    pub fn plate(&self) -> Option<&FreePlate> {
        self.plate.as_ref()
    }

    /// Returns the rule by which a contact ends.
    pub fn end_rule(&self) -> EndRule {
        self.end_rule
    }

    /// Returns the law with values for all parameters; `None` for [`LawFamily::Ting`].
    ///
    /// # Errors
    /// A value is out of range.
    pub fn law(&self, values: &[f64]) -> Option<Result<ContactLaw, LawError>> {
        self.family.law(&self.pair, values)
    }

    /// Computes the whole collision at an approach speed, m/s.
    ///
    /// # Errors
    /// The law rejects a value or the speed, does not describe the collision, or cannot compute it to its end.
    pub fn impact(&self, values: &[f64], speed: f64) -> Result<Impact, LawError> {
        let mobility = match &self.plate {
            // A contact that dents follows elements most closely on the thin plate.
            Some(plate) => plate.mobility_in(&HertzImpact::new(&self.pair, speed)?)?.map(|thick| {
                if self.family.is_elastic_plastic() { plate.thin_mobility() } else { thick }
            }),
            None => None,
        };
        match (self.family.law(&self.pair, values), values) {
            (Some(law), _) => {
                let model = LawImpact::new(&self.pair, law?).with_end_rule(self.end_rule);
                let model = model.with_tolerance(TOLERANCE)?;
                match mobility {
                    Some(mobility) => model.with_plate(mobility)?.impact(speed),
                    None => model.impact(speed),
                }
            }
            (None, &[rate, ..]) => {
                let [first, second] = self.materials_at_rate(rate)?;
                let relaxation = PairRelaxation::new(first.as_ref(), second.as_ref())?;
                let mut ting = Ting::new(&self.pair, relaxation);
                if let Some(mobility) = mobility {
                    ting = ting.with_plate(mobility)?;
                }
                match &self.finite_size {
                    Some(size) => ting.with_finite_size(size.clone()).impact(speed),
                    None => ting.impact(speed),
                }
            }
            (None, []) => Err(LawError::NotPositive { quantity: "decay_rate", value: 0.0 }),
        }
    }

    /// Returns restitution and contact time at an approach speed, m/s. A creep that is too long to compute, with a
    /// restitution below 1e-8, counts as a contact without an end.
    ///
    /// # Errors
    /// The law rejects a value or the speed, or does not describe the collision.
    pub fn outcome(&self, values: &[f64], speed: f64) -> Result<Outcome, LawError> {
        match self.impact(values, speed) {
            Ok(impact) => {
                Ok(Outcome { restitution: impact.restitution, contact_time: impact.contact_time })
            }
            Err(LawError::NotFinished { .. }) => {
                Ok(Outcome { restitution: 0.0, contact_time: None })
            }
            Err(error) => Err(error),
        }
    }

    /// Returns the decay rates of the bodies' terms, 1/s, scaled so that `decay_rate` is the largest.
    pub fn decay_rates(&self, decay_rate: f64) -> [Vec<f64>; 2] {
        let factor = self.fastest_rate().map_or(1.0, |fastest| decay_rate / fastest);
        self.materials.each_ref().map(|material| {
            let series = material.as_ref().and_then(Material::relaxation);
            let terms = series.map_or(&[][..], PronySeries::terms);
            terms.iter().map(|term| factor / term.relaxation_time).collect()
        })
    }

    /// Returns the β of the case, the largest decay rate of both bodies, 1/s.
    pub fn fastest_rate(&self) -> Option<f64> {
        let series = self.materials.iter().flatten().filter_map(Material::relaxation);
        let terms = series.flat_map(|series| series.terms().iter());
        let relaxing = terms.filter(|term| term.weight > 0.0);
        relaxing.map(|term| term.relaxation_time.recip()).reduce(f64::max)
    }

    /// Returns the natural size of a parameter, at which it changes a collision at `speed` by the order of 1; for
    /// a plain number its default or else the middle of its limits.
    ///
    /// # Errors
    /// Hertz' impact has an error.
    pub fn natural_size(
        &self,
        parameter: &LawParameter,
        values: &[f64],
        speed: f64,
    ) -> Result<f64, LawError> {
        let hertz = HertzImpact::new(&self.pair, speed)?;
        let index = self.family.parameters().iter().position(|other| other == parameter);
        let index = index.unwrap_or(0);
        let mut unit = values.to_vec();
        if let Some(value) = unit.get_mut(index) {
            *value = 1.0;
        }
        let law = || self.family.law(&self.pair, &unit);
        let size = match parameter.role {
            ParameterRole::Rate => hertz.contact_time().recip(),
            ParameterRole::Strength => hertz.peak_pressure(),
            ParameterRole::Damping => match law() {
                Some(law) => {
                    let law = law?;
                    let braking = law.damping() * hertz.max_approach().powf(law.damping_exponent());
                    self.pair.effective_mass() / (braking * hertz.contact_time())
                }
                None => 1.0,
            },
            ParameterRole::Stiffness => match law() {
                Some(law) => {
                    let exponent = law?.elastic_exponent();
                    hertz.peak_force() / hertz.max_approach().powf(exponent)
                }
                None => 1.0,
            },
            ParameterRole::Speed | ParameterRole::Number => parameter.guess(speed),
        };
        if size.is_finite() && (size > 0.0 || parameter.role == ParameterRole::Number) {
            Ok(size)
        } else {
            Err(LawError::NotPositive { quantity: parameter.key, value: size })
        }
    }

    /// Returns the stiffness K, N/m^γ, of a law whose stiffness no theory gives, with which its spring alone makes Hertz'
    /// contact time at a speed, m/s. For a spring K ξ^γ between masses
    ///
    /// ```math
    /// T = \frac{2\xi_m}{v}\,\frac{\sqrt\pi\,\Gamma(1+q)}{\Gamma(\frac12+q)}, \qquad q = \frac1{\gamma+1}, \qquad
    /// \frac{K\xi_m^{\gamma+1}}{\gamma+1} = \tfrac12m^*v^2
    /// ```
    ///
    /// (the integral of dξ/√(v² − 2Kξ^(γ+1)/((γ+1)m*)), a beta function).
    ///
    /// # Errors
    /// Hertz' impact has an error, or a value is out of range.
    pub fn stiffness_of_hertz(&self, values: &[f64], speed: f64) -> Result<f64, LawError> {
        let time = HertzImpact::new(&self.pair, speed)?.contact_time();
        let exponent = self.law(values).transpose()?.map_or(1.5, |law| law.elastic_exponent());
        let q = (exponent + 1.0).recip();
        let integral = PI.sqrt() * gamma(1.0 + q) / gamma(0.5 + q);
        let overlap = 0.5 * time * speed / integral;
        let energy = 0.5 * self.pair.effective_mass() * speed * speed;
        Ok((exponent + 1.0) * energy / overlap.powf(exponent + 1.0))
    }

    /// Returns Poisson's ratio of the first body that has a material.
    pub fn poissons_ratio(&self) -> Option<f64> {
        let mut materials = self.materials.iter().flatten();
        materials.next().map(|material| material.instantaneous().poissons_ratio())
    }

    fn materials_at_rate(&self, rate: f64) -> Result<[Option<Material>; 2], LawError> {
        let factor = rate / self.fastest_rate().unwrap_or(rate);
        let wrong = |_| LawError::NotPositive { quantity: "decay_rate", value: rate };
        let mut scaled = self.materials.clone();
        for material in scaled.iter_mut().flatten() {
            let Some(series) = material.relaxation() else { continue };
            let terms = series.terms().iter().map(|term| PronyTerm {
                weight: term.weight,
                relaxation_time: term.relaxation_time / factor,
            });
            let series = PronySeries::new(terms.collect(), series.acts_on()).map_err(wrong)?;
            *material = Material::new(material.density(), *material.instantaneous(), Some(series))
                .map_err(wrong)?;
        }
        Ok(scaled)
    }
}
