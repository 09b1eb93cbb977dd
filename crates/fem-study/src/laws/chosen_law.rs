//! The contact law of a case's bodies, and its values from `[model]` and from the caller.

use fem_case::engineering::show;
use fem_case::{Body, Case, ModelChoice, PlateSupport, Scene};
use fem_data::estimate::{FitError, Model, Point, Problem};
use fem_laws::{EndRule, FreePlate, KeyNeed, LawFamily, LawInput, LawParameter, ParameterRole};
use fem_material::{FlowRule, Material};

use super::law_fault::LawFault;
use fem_data::estimate::{check_value, find_parameter, loss_parameter};
use fem_simulation::{Reduced, free_plate};

/// Returns the plate of a scene that bends under the contact.
///
/// # Errors
/// A plate that is bonded below.
pub(crate) fn plate_of(scene: &Scene) -> Result<Option<FreePlate>, FitError> {
    let mut plates = scene.bodies().iter().filter_map(Body::plate);
    match plates.any(|plate| plate.support != PlateSupport::Free) {
        true => Err(FitError::BondedPlate),
        false => Ok(free_plate(scene)),
    }
}

/// Returns the model of a scene's bodies under a law, with the plate that bends under the contact.
///
/// # Errors
/// A plate is bonded below; the numbers leave the range of f64; no body relaxes under Ting's law; the law ends contacts by another rule.
pub fn model_of(scene: &Scene, family: LawFamily, end_rule: EndRule) -> Result<Model, FitError> {
    let pair = scene.pair()?;
    let materials = scene.bodies().each_ref().map(|body| body.material().cloned());
    let model = Model::new(&pair, materials, family, end_rule)?;
    let model = match plate_of(scene)? {
        Some(plate) => model.with_plate(plate),
        None => model,
    };
    Ok(match scene.model() {
        ModelChoice::Ting { finite_size: true, .. } => model.with_finite_size(scene.finite_size()?),
        _ => model,
    })
}

/// Returns the values of the parameters that a law takes from the case where they are not given.
fn optional_values(scene: &Scene, family: LawFamily) -> Vec<Known> {
    let parameters = family.parameters();
    let (sets, loss) = (family.key_sets(), family.loss_parameter().map(|index| &parameters[index]));
    let set =
        loss.and_then(|loss| sets.iter().find(|set| set.iter().any(|(key, _)| *key == loss.key)));
    let is_optional = |key: &str| set.is_some_and(|set| set.contains(&(key, KeyNeed::Optional)));
    // Those of the case's own loss, if it has one.
    let guess = loss.map(|loss| (loss.key, loss.guess(scene.approach_speed())));
    let mut inputs = [Vec::new(), guess.into_iter().collect()].into_iter();
    let found = match parameters.iter().any(|parameter| is_optional(parameter.key)) {
        true => inputs
            .find_map(|values| Reduced::parameters_of(scene, &LawInput { family, values }).ok()),
        false => None,
    };
    let known = |(index, parameter): (usize, &LawParameter)| match &found {
        Some(values) if parameter.default.is_some() && is_optional(parameter.key) => {
            Known::Case(values[index])
        }
        _ => Known::Nowhere,
    };
    parameters.iter().enumerate().map(known).collect()
}

/// Returns the law that `[model]` names, if it names one.
pub fn family_of(scene: &Scene) -> Option<LawFamily> {
    match scene.model() {
        ModelChoice::Ting { .. } => Some(LawFamily::Ting),
        ModelChoice::Law { law, .. } => Some(law.family),
        _ => None,
    }
}

/// Returns the yield strength at the reference rate of `material.NAME.flow.rate`, Pa, which the case's key has, for a strength of a law,
/// which is at the strain rate of the contact; `None` for a law or for bodies that depend on no rate. The factor between both is that of
/// the case's own strength and speed.
pub(super) fn strength_at_reference_rate(
    scene: &Scene,
    family: LawFamily,
    strength: f64,
) -> Option<f64> {
    let index = family.parameters().iter().position(|it| it.key == "yield_strength")?;
    let at_contact =
        Reduced::parameters_of(scene, &LawInput { family, values: Vec::new() }).ok()?;
    let depends = |body: &&Body| {
        let rule = body.material().and_then(Material::flow);
        rule.and_then(FlowRule::rate).is_some_and(|rate| rate.coefficient > 0.0)
    };
    let own = scene.bodies().iter().filter(depends).filter_map(Body::yield_strength);
    let own = own.fold(f64::INFINITY, f64::min);
    let is_other = own.is_finite() && at_contact[index] > own;
    is_other.then(|| strength * own / at_contact[index])
}

/// Returns the sentence about that strength, Pa.
pub fn strength_words(at_reference_rate: f64) -> String {
    format!(
        "yield_strength is at the strain rate of the contact; at the reference rate it is {}: give that to material.NAME.flow",
        show(at_reference_rate, "Pa")
    )
}

/// Ratio over which a strength with the restitution is searched downwards.
const FARTHEST: f64 = 1e3;
/// Steps of that search, and halvings of the step that holds its end.
const STEPS: u32 = 24;
const HALVINGS: usize = 4;

/// A law of a case and the known values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenLaw {
    model: Model,
    known: Vec<Known>,
}

/// The substitute for a parameter that the data do not determine and that is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandIn {
    /// The stiffness with which the spring alone makes Hertz' contact time at the middle speed of the data.
    HertzTime,
    /// The middle speed of the data, at which the law's loss is stated.
    MiddleSpeed,
    /// Poisson's ratio: the material dissipates in the same form as it deforms elastically.
    PoissonsRatio,
}

impl StandIn {
    /// Returns the origin of the value as text.
    pub fn words(self) -> &'static str {
        match self {
            Self::HertzTime => "of Hertz' contact time",
            Self::MiddleSpeed => "middle of the speeds",
            Self::PoissonsRatio => "Poisson's ratio",
        }
    }
}

/// Values of the parameters by their origin, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Known {
    Nowhere,
    Case(f64),
    Given(f64),
}

impl ChosenLaw {
    /// Creates the law. Values that are given by key (SI) take precedence over those of the case, which count if the
    /// case has the same law.
    ///
    /// # Errors
    /// The law does not have a key, or a value is out of range; see [`model_of`].
    pub fn of(
        case: &Case,
        family: LawFamily,
        given: &[(&str, f64)],
        end_rule: Option<EndRule>,
    ) -> Result<Self, LawFault> {
        let mut known = optional_values(case.scene(), family);
        let mut own_end = family.end_rule().unwrap_or(EndRule::ZeroForce);
        if let ModelChoice::Law { law, end_rule, .. } = case.scene().model()
            && law.family == family
        {
            let reduced = Reduced::new(case.scene()).map_err(|refusal| refusal.in_case(case))?;
            let numbers = reduced.law_numbers().unwrap_or_default();
            known = numbers.iter().copied().map(Known::Case).collect();
            own_end = *end_rule;
        }
        for (key, value) in given {
            let index = find_parameter(family, key)?;
            check_value(&family.parameters()[index], *value)?;
            known[index] = Known::Given(*value);
        }
        let model = model_of(case.scene(), family, end_rule.unwrap_or(own_end))?;
        Ok(Self { model, known })
    }

    /// Returns this law for the bodies of another case, with the same given values and end of contact.
    ///
    /// # Errors
    /// Those of [`ChosenLaw::of`].
    pub fn in_case(&self, case: &Case) -> Result<Self, LawFault> {
        let both = self.family().parameters().iter().zip(&self.known);
        let given = both.filter_map(|(parameter, known)| match known {
            Known::Given(value) => Some((parameter.key, *value)),
            _ => None,
        });
        let given: Vec<(&str, f64)> = given.collect();
        let end_rule = self.family().end_rule().is_none().then(|| self.model.end_rule());
        Self::of(case, self.family(), &given, end_rule)
    }

    /// Returns the bodies under the law.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the family of the law.
    pub fn family(&self) -> LawFamily {
        self.model.family()
    }

    /// Returns the least-squares problem for the parameters with these keys. Without keys these are the parameter of the
    /// loss and, if there are contact times, a stiffness that no theory gives. All others keep their
    /// values, or those of [`StandIn`].
    ///
    /// # Errors
    /// The law has no loss, or does not have a key; a stiffness is searched for without contact times; a
    /// parameter has no value.
    pub fn problem<'a>(
        &'a self,
        points: &'a [Point],
        free: &[&str],
    ) -> Result<Problem<'a>, LawFault> {
        let parameters = self.family().parameters();
        let has_times = points.iter().any(|point| point.contact_time.is_some());
        let mut indices = vec![loss_parameter(self.family())?];
        if free.is_empty() && has_times {
            let of_theory = |index: &usize| self.stand_in(*index) == Some(StandIn::HertzTime);
            indices.extend((0..parameters.len()).filter(of_theory));
            indices.sort_unstable();
        } else if !free.is_empty() {
            let found = free.iter().map(|key| find_parameter(self.family(), key));
            indices = found.collect::<Result<_, _>>()?;
        }
        let is_stiffness = |index: &&usize| parameters[**index].role == ParameterRole::Stiffness;
        if let (false, Some(index)) = (has_times, indices.iter().find(is_stiffness)) {
            let (law, key) = (self.family().name(), parameters[*index].key);
            return Err(LawFault::NeedsTimes { law, key });
        }
        let keys: Vec<&str> = indices.iter().map(|index| parameters[*index].key).collect();
        let mut problem = Problem::new(&self.model, points, &keys)?;
        problem.values = self.values(&problem.values);
        let speed = problem.middle_speed();
        for index in (0..parameters.len()).filter(|index| !indices.contains(index)) {
            let Some(stand_in) = self.stand_in(index) else { continue };
            problem.values[index] = match stand_in {
                StandIn::HertzTime => self.model.stiffness_of_hertz(&problem.values, speed)?,
                StandIn::MiddleSpeed => speed,
                StandIn::PoissonsRatio => {
                    self.model.poissons_ratio().unwrap_or(problem.values[index])
                }
            };
        }
        for free in &mut problem.free {
            free.start = self.start(free.index);
        }
        let has_value = |index| indices.contains(&index) || self.stand_in(index).is_some();
        match self.missing(has_value) {
            Some(key) => Err(LawFault::Missing { law: self.family().name(), key, free: keys }),
            None => Ok(problem),
        }
    }

    /// Returns the substitute for a parameter of a fit that has neither a value nor a default, and that
    /// restitutions do not determine in addition to the loss.
    pub fn stand_in(&self, index: usize) -> Option<StandIn> {
        let parameter = &self.family().parameters()[index];
        if self.known[index] != Known::Nowhere || parameter.default.is_some() {
            return None;
        }
        match (parameter.role, parameter.key) {
            (ParameterRole::Stiffness, _) => Some(StandIn::HertzTime),
            (ParameterRole::Speed, _) => Some(StandIn::MiddleSpeed),
            (ParameterRole::Number, "eta_2") => Some(StandIn::PoissonsRatio),
            _ => None,
        }
    }

    /// Returns the error of the restitution by the law with values of all of its parameters, SI, at an approach speed, m/s; infinite if it
    /// is not known, and 0 for laws that do not dent, whose parameters have no meaning apart from them.
    pub(super) fn error_at(&self, scene: &Scene, values: &[f64], speed: f64) -> f64 {
        if self.family().strength_parameter().is_none() {
            return 0.0;
        }
        let keys = self.family().parameters().iter().map(|parameter| parameter.key);
        let law =
            LawInput { family: self.family(), values: keys.zip(values.iter().copied()).collect() };
        Reduced::restitution_error(scene, law, speed).unwrap_or(f64::INFINITY)
    }

    /// Returns the least and the largest value of a strength, SI, with which the law gives the mean of restitutions with weights within its
    /// own error; `values` are the found ones. The upper end is infinite if bodies that do not flow have that mean too, within the
    /// `uncertainty` of the mean, and the lower end is 0 if the law's error is not known. Both ends are the found value for another
    /// parameter.
    pub(super) fn range(
        &self,
        scene: &Scene,
        index: usize,
        values: &[f64],
        points: &[(Point, f64)],
        uncertainty: f64,
    ) -> (f64, f64) {
        let (family, found) = (self.family(), values[index]);
        if family.strength_parameter() != Some(index) {
            return (found, found);
        }
        let is_known =
            |(point, _): &(Point, f64)| self.error_at(scene, values, point.speed).is_finite();
        if !points.iter().all(is_known) {
            return (0.0, f64::INFINITY);
        }
        // The sum of the distances of the law's restitutions from the measured ones beyond its error, upwards or downwards.
        let beyond = |value: f64, sign: f64, uncertainty: f64| {
            let mut values = values.to_vec();
            values[index] = value;
            let of_point = |(point, weight): &(Point, f64)| {
                let outcome = self.model.outcome(&values, point.speed);
                let e = outcome.map_or(f64::NAN, |it| it.restitution);
                let error = self.error_at(scene, &values, point.speed) + uncertainty;
                weight * (sign * (e - point.restitution) - error)
            };
            points.iter().map(of_point).sum::<f64>()
        };
        let low = edge(found, found / FARTHEST, |value| beyond(value, -1.0, 0.0) > 0.0);
        let fastest = points.iter().fold(0.0, |fastest, (point, _)| f64::max(fastest, point.speed));
        let strongest = self.model.natural_size(&family.parameters()[index], values, fastest);
        let strongest = strongest.unwrap_or(f64::INFINITY);
        match beyond(strongest, 1.0, uncertainty) > 0.0 {
            true => (low, edge(found, strongest, |value| beyond(value, 1.0, 0.0) > 0.0)),
            false => (low, f64::INFINITY),
        }
    }

    /// Replaces `guesses` by substitute values, in the order of the parameters.
    pub(crate) fn values(&self, guesses: &[f64]) -> Vec<f64> {
        let value = |(known, guess): (&Known, &f64)| match known {
            Known::Nowhere => *guess,
            Known::Case(value) | Known::Given(value) => *value,
        };
        self.known.iter().zip(guesses).map(value).collect()
    }

    /// Returns the key of a parameter that has neither a value nor a default and is not known `otherwise`.
    pub(super) fn missing(&self, otherwise: impl Fn(usize) -> bool) -> Option<&'static str> {
        let parameters = self.family().parameters().iter().enumerate();
        let mut missing = parameters.filter(|(index, parameter)| {
            let is_known = self.known[*index] != Known::Nowhere || parameter.default.is_some();
            !is_known && !otherwise(*index)
        });
        missing.next().map(|(_, parameter)| parameter.key)
    }

    /// Returns the starting value of a free parameter: the given one. The case's value may be that of another run.
    fn start(&self, index: usize) -> Option<f64> {
        match self.known[index] {
            Known::Given(value) => Some(value),
            _ => None,
        }
    }
}

/// Returns the lower end of a range of strengths, SI, that has no upper end; `None` if it has one or none is known.
pub(super) fn open_from((low, high): (f64, f64)) -> Option<f64> {
    (high == f64::INFINITY && low > 0.0).then_some(low)
}

/// Returns where a condition begins to hold on the way from one value to another, in the logarithm; the other value if it never does.
fn edge(from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let at = |share: f64| from * (to / from).powf(share);
    let Some(first) = (1..=STEPS).find(|k| holds(at(f64::from(*k) / f64::from(STEPS)))) else {
        return to;
    };
    let (mut low, mut high) =
        (f64::from(first - 1) / f64::from(STEPS), f64::from(first) / f64::from(STEPS));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(at(middle)) { high = middle } else { low = middle }
    }
    at(high)
}
