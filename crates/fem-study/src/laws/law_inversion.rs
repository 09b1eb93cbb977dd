//! The parameter of a law that gives a wanted restitution at one speed.

use fem_case::{Case, Scene, UncertainInput, central_change};
use fem_data::estimate::{InputPart, Inversion, Model, Point, Problem, SPEED, invert};
use fem_data::table::Measured;
use fem_laws::{LawFamily, LawParameter, ParameterRole};
use serde_json::{Value, json};

use super::chosen_law::{ChosenLaw, open_from, strength_at_reference_rate};
use super::law_fault::LawFault;
use fem_data::estimate::{find_parameter, loss_parameter};

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
    /// Changes of each value, SI, by the uncertainty of the restitution and of the inputs of the case.
    pub inputs: Vec<InputPart>,
    /// The least and the largest value, SI, with which the law gives the restitution within its own error, for each solution. Equal for
    /// laws that do not dent; infinite at the upper end if bodies that do not flow have that restitution too.
    pub by_law: Vec<(f64, f64)>,
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
        let by_law = inversion.solutions.iter().map(|value| (*value, *value)).collect();
        Ok(Self { model, index, inversion, speed, values, inputs: Vec::new(), by_law })
    }

    /// Adds the uncertainties of the restitution, of the inputs of the case and of the law, by solving again with each. `law` is that of the
    /// inversion; the speed is that of the case unless one is `given`.
    pub fn with_inputs(
        mut self,
        case: &Case,
        law: &ChosenLaw,
        restitution: Measured,
        given: Option<f64>,
    ) -> Self {
        let key = self.parameter().key;
        let own = &self.inversion.solutions;
        let changes = |law: &ChosenLaw, speed: f64, restitution: f64| -> Option<Vec<f64>> {
            let others = Self::of(law, Some(key), speed, restitution).ok()?.inversion.solutions;
            let pairs = own.iter().zip(&others);
            (others.len() == own.len()).then(|| pairs.map(|(own, other)| other - own).collect())
        };
        let replaced: &[&str] = if given.is_some() { &[SPEED] } else { &[] };
        let mut inputs = InputPart::of(case, own.len(), replaced, |case: &Case| {
            let speed = given.unwrap_or_else(|| case.scene().approach_speed());
            changes(&law.in_case(case).ok()?, speed, restitution.value)
        });
        let Measured { value, uncertainty } = restitution;
        if uncertainty > 0.0 {
            let at = |sign: f64| changes(law, self.speed, value + sign * uncertainty);
            let changes = central_change(at).unwrap_or_else(|| vec![f64::NAN; own.len()]);
            let input = UncertainInput { key: "restitution".to_string(), value, uncertainty };
            inputs.insert(0, InputPart { input, changes });
        }
        let point = Point::new(self.speed, restitution.value);
        let range = |own: &f64| {
            let mut values = self.values.clone();
            values[self.index] = *own;
            law.range(case.scene(), self.index, &values, &[(point, 1.0)], restitution.uncertainty)
        };
        let by_law = own.iter().map(range).collect();
        self.by_law = by_law;
        self.inputs = inputs;
        self
    }

    /// Returns the least value, SI, if the restitution is that of all larger ones too, within the error of the law.
    pub fn at_least(&self, solution: usize) -> Option<f64> {
        open_from(self.by_law[solution])
    }

    /// Returns the error of a solution, SI, by that of the law.
    pub fn error_by_law(&self, solution: usize) -> f64 {
        let (value, (low, high)) = (self.inversion.solutions[solution], self.by_law[solution]);
        (value - low).max(high - value)
    }

    /// Returns the stored form of the parts of its standard error, SI.
    pub fn input_numbers(&self, solution: usize) -> Value {
        let part = |InputPart { input, changes }: &InputPart| {
            let UncertainInput { key, value, uncertainty } = input;
            json!({ "key": key, "value": value, "uncertainty": uncertainty, "change": changes[solution] })
        };
        self.inputs.iter().map(part).collect()
    }

    /// Returns the standard error of a solution, SI; `None` if nothing is uncertain or there is no solution with an input.
    pub fn standard_error(&self, solution: usize) -> Option<f64> {
        let by_law = self.error_by_law(solution);
        let error = InputPart::sum(&self.inputs, solution).hypot(by_law);
        let is_exact = self.inputs.is_empty() && by_law == 0.0;
        (!is_exact && error.is_finite()).then_some(error)
    }

    /// Returns the parameter that is found.
    pub fn parameter(&self) -> &'static LawParameter {
        &self.model.family().parameters()[self.index]
    }

    /// Returns the yield strength at the reference rate of a scene's flow rule, Pa, for one that is found; `None` if both are equal or
    /// another parameter is found.
    pub fn strength_at_reference_rate(&self, scene: &Scene, found: f64) -> Option<f64> {
        match self.parameter().key {
            "yield_strength" => strength_at_reference_rate(scene, self.model.family(), found),
            _ => None,
        }
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
