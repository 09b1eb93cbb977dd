//! The parameter of a law that gives a wanted restitution at one speed.

use crate::fit::{Inversion, Model, Point, Problem, invert};
use fem_laws::{LawFamily, LawParameter, ParameterRole};

use super::chosen_law::ChosenLaw;
use super::law_fault::LawFault;
use super::parameter::{find_parameter, loss_parameter};

/// A law with the values of one parameter that give a restitution.
#[derive(Clone, Debug, PartialEq)]
pub struct LawInversion {
    /// The bodies under the law.
    pub model: Model,
    /// Index of the parameter that is found.
    pub index: usize,
    /// The parameter values that give the restitution.
    pub inversion: Inversion,
    /// Approach speed, m/s.
    pub speed: f64,
    /// Values of all parameters; that of the wanted one is only a guess.
    values: Vec<f64>,
}

impl LawInversion {
    /// Finds the values of a parameter, by default that of the loss, with which a collision at `speed` (m/s)
    /// has a restitution.
    ///
    /// # Errors
    /// The law does not have the key or has no loss; a parameter has no value; no value gives the restitution.
    pub fn of(
        law: &ChosenLaw,
        key: Option<&str>,
        speed: f64,
        restitution: f64,
    ) -> Result<Self, LawFault> {
        let family = law.family();
        let index = match key {
            Some(key) => find_parameter(family, key)?,
            None => loss_parameter(family)?,
        };
        // A parameter that is a speed has the speed of the collision.
        let is_known = |other: usize| {
            other == index || family.parameters()[other].role == ParameterRole::Speed
        };
        if let Some(key) = law.missing(is_known) {
            return Err(LawFault::Missing { law: family.name(), key, free: Vec::new() });
        }
        let at_speed = [Point::new(speed, restitution)];
        let values = law.values(&Problem::new(law.model(), &at_speed, &[])?.values);
        let model = law.model().clone();
        let inversion = invert(&model, index, &values, speed, restitution)?;
        Ok(Self { model, index, inversion, speed, values })
    }

    /// Returns the parameter that is found.
    pub fn parameter(&self) -> &'static LawParameter {
        &self.model.family().parameters()[self.index]
    }

    /// Returns its values, SI, each with its contact time, s; `None` if the bodies stay together.
    pub fn solutions(&self) -> Vec<(f64, Option<f64>)> {
        let contact_time = |value: f64| {
            let mut values = self.values.clone();
            values[self.index] = value;
            self.model.outcome(&values, self.speed).ok()?.contact_time
        };
        self.inversion.solutions.iter().map(|value| (*value, contact_time(*value))).collect()
    }
}

/// Whether a law has parameters other than its loss that no theory gives.
pub fn needs_more(family: LawFamily) -> bool {
    let Some(loss) = family.loss_parameter() else { return true };
    let mut parameters = family.parameters().iter().enumerate();
    parameters.any(|(index, parameter)| {
        index != loss && parameter.default.is_none() && parameter.role != ParameterRole::Speed
    })
}
