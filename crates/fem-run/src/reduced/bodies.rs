//! From a case to a law of its bodies: which one, with which numbers, from the options and from
//! `[model]`.

use fem::Reduced;
use fem_case::{Case, ModelChoice};
use fem_fit::{FitError, Model};
use fem_laws::{EndRule, Family};

use super::laws::{LawArguments, find_key, from_fit_error, parse_value, split};
use crate::failure::Failure;

/// The bodies of a case under a law.
///
/// # Errors
/// Numbers so extreme that they leave the range of f64; Ting's model of bodies that do not relax; a
/// law with another end of its own.
pub fn model_of(case: &Case, family: Family, end_rule: EndRule) -> Result<Model, FitError> {
    let pair = case.scene.pair()?;
    let materials = case.scene.bodies.each_ref().map(|body| body.material().cloned());
    let model = Model::new(&pair, materials, family, end_rule)?;
    Ok(match &case.scene.model {
        ModelChoice::Ting { finite_size: true, .. } => {
            model.with_finite_size(case.scene.finite_size()?)
        }
        _ => model,
    })
}

/// The law that `[model]` names, if it names one.
pub fn family_of(case: &Case) -> Option<Family> {
    match &case.scene.model {
        ModelChoice::Ting { .. } => Some(Family::Ting),
        ModelChoice::Law { law, .. } => Some(law.family()),
        _ => None,
    }
}

/// A law of a case, and what is known of its parameters.
pub struct ChosenLaw {
    pub model: Model,
    given: Vec<Given>,
}

/// Where a parameter's value comes from.
#[derive(Clone, Copy, PartialEq)]
enum Given {
    Nowhere,
    Case(f64),
    Option(f64),
}

impl LawArguments {
    /// The law with the case's numbers and end if the case has the same one, and the options' before
    /// them.
    ///
    /// # Errors
    /// Keys that the law does not have, values without a meaning; see [`model_of`].
    pub fn choose(&self, case: &Case, family: Family) -> Result<ChosenLaw, Failure> {
        let mut given = vec![Given::Nowhere; family.parameters().len()];
        let mut end_rule = family.end_rule().unwrap_or(EndRule::ZeroForce);
        if let ModelChoice::Law { law, end_rule: own, .. } = &case.scene.model
            && law.family() == family
        {
            let reduced = Reduced::new(&case.scene).map_err(|refusal| refusal.in_case(case))?;
            let numbers = reduced.law_numbers().unwrap_or_default();
            given = numbers.iter().copied().map(Given::Case).collect();
            end_rule = *own;
        }
        for text in &self.param {
            let (key, value) = split(text, "--param")?;
            let index = find_key(family, key, "--param")?;
            let value = parse_value(&family.parameters()[index], value, "--param")?;
            given[index] = Given::Option(value);
        }
        let end_rule = self.end.map_or(end_rule, |end| end.rule());
        let model = model_of(case, family, end_rule).map_err(from_fit_error)?;
        Ok(ChosenLaw { model, given })
    }
}

impl ChosenLaw {
    /// What is given in place of `guesses`, in the order of the parameters.
    pub fn values(&self, guesses: &[f64]) -> Vec<f64> {
        let value = |(given, guess): (&Given, &f64)| match given {
            Given::Nowhere => *guess,
            Given::Case(value) | Given::Option(value) => *value,
        };
        self.given.iter().zip(guesses).map(value).collect()
    }

    /// Where to begin with a parameter that is searched for: what an option says; a case's value is
    /// that of another run.
    pub fn start(&self, index: usize) -> Option<f64> {
        match self.given[index] {
            Given::Option(value) => Some(value),
            _ => None,
        }
    }

    /// The key of a parameter that has neither a value nor a default and is not `known` otherwise.
    pub fn missing(&self, known: impl Fn(usize) -> bool) -> Option<&'static str> {
        let parameters = self.model.family().parameters().iter().enumerate();
        let mut missing = parameters.filter(|(index, parameter)| {
            self.given[*index] == Given::Nowhere && parameter.default.is_none() && !known(*index)
        });
        missing.next().map(|(_, parameter)| parameter.key)
    }
}
