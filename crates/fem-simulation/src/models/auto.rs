//! Automatic choice of the model, `[model] auto = {}`: the cheapest one that is expected to be within the tolerance.
//!
//! The error of a model is estimated before the run. It is the sum of the errors of its own approximations and of the
//! effects that it lacks ([`Effect::adequacy`]). A model is skipped if it lacks an effect
//! whose size cannot be estimated, or if its result would come with the advice to use another model. If no model serves, the one
//! with the fewest effects of unknown size comes closest. Where bodies flow the mean-pressure law is the last candidate.

use fem_case::{CaseFile, CondensedOptions, ModelChoice, Scene, defaults};
use fem_collision::QuantityOfInterest;
use fem_laws::{LawFamily, LawInput};
use serde::Serialize;

use super::method_of;
use crate::effects::{self, EFFECTS, Effect, PlasticFlow, Support};
use crate::estimate::{Estimate, Regime, viscous_flow};
use crate::models::method::{Method, Model, SharedModels};
use crate::plan::Plan;
use crate::quantity_errors::{QuantityErrors, tolerance_of};
use crate::rejection::Rejection;

/// The automatic choice of the model.
#[derive(Clone, Copy, Debug)]
pub struct AutoMethod;

impl Method for AutoMethod {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn build(&self, regime: &Regime, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        let chosen = with_chosen_model(regime)?;
        method_of(&chosen.scene).build(&chosen, shared)
    }

    fn support(&self, _: &dyn Effect, _: &Scene, _: &Estimate) -> Option<Support> {
        None
    }

    fn resolve(
        &self,
        regime: &Regime,
        plan: Option<&Plan>,
        file: CaseFile,
    ) -> Result<CaseFile, Rejection> {
        let chosen = with_chosen_model(regime)?;
        method_of(&chosen.scene).resolve(&chosen, plan, file)
    }
}

/// Returns a scene that leaves its model open with the chosen model.
fn with_chosen_model(regime: &Regime) -> Result<Regime, Rejection> {
    match regime.scene.model() {
        ModelChoice::Auto => Ok(SelectedModel::of(regime.clone())?.regime),
        _ => Err(Rejection::chose_another(&regime.scene, "auto")),
    }
}

/// Expected error of a model, as magnitudes; `None` if it cannot be estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ExpectedError {
    /// Error of the restitution.
    pub restitution: Option<f64>,
    /// Error of the contact time, in seconds.
    pub contact_time_s: Option<f64>,
    /// Error of the peak force, in newtons.
    pub peak_force_n: Option<f64>,
    /// Error of the peak pressure, in pascals.
    pub peak_pressure_pa: Option<f64>,
}

impl From<&QuantityErrors> for ExpectedError {
    fn from(error: &QuantityErrors) -> Self {
        let [restitution, contact_time_s, peak_force_n, peak_pressure_pa] =
            JUDGED_QUANTITIES.map(|quantity| error.size(quantity));
        Self { restitution, contact_time_s, peak_force_n, peak_pressure_pa }
    }
}

/// A model that was considered for a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelCandidate {
    /// The model, as written in `[model]`.
    pub model: &'static str,
    /// Whether the model computes the collision.
    pub chosen: bool,
    /// Its expected error.
    pub error: ExpectedError,
    /// Why the model is suitable or not.
    pub reason: String,
}

/// A scene with the model that computes it.
#[derive(Clone, Debug)]
pub struct SelectedModel {
    /// The scene with the chosen model.
    pub regime: Regime,
    /// All models, from the cheapest to the most expensive; empty if the case names its own.
    pub considered: Vec<ModelCandidate>,
    /// A warning if no model is suitable.
    pub warning: Option<String>,
}

impl SelectedModel {
    /// Chooses the model if the case leaves it open.
    ///
    /// # Errors
    /// A scene whose bodies flow into each other.
    pub fn of(regime: Regime) -> Result<Self, Rejection> {
        let Regime { scene, estimate } = &regime;
        if *scene.model() != ModelChoice::Auto {
            return Ok(Self { regime, considered: Vec::new(), warning: None });
        }
        viscous_flow::check(scene, estimate)?;
        let flows = PlasticFlow::is_on(scene, estimate);
        let candidates = if flows { &CANDIDATES[..] } else { &CANDIDATES[..FLOWING] };
        let mut judged: Vec<CandidateVerdict> =
            candidates.iter().map(|candidate| candidate.judge(scene, estimate)).collect();
        let (serves, best, chosen) = loop {
            let serves = judged.iter().position(|judged| judged.rejection_reason.is_none());
            let best = serves.unwrap_or_else(|| closest(&judged));
            let chosen = regime.variant(scene.clone().with_model((candidates[best].choice)()))?;
            let method = method_of(&chosen.scene);
            match method.check(&chosen).and_then(|()| method.expected(&chosen)) {
                // The next one may compute what this one would stop at or reject.
                Err(rejection) if judged[best].is_possible => {
                    judged[best].is_possible = false;
                    judged[best].rejection_reason = Some(rejection.message);
                }
                _ => break (serves, best, chosen),
            }
        };
        let CandidateVerdict { n_unknown, excess, .. } = judged[best];
        let considered = judged.into_iter().zip(candidates).enumerate();
        let considered: Vec<ModelCandidate> = considered
            .map(|(k, (judged, candidate))| ModelCandidate {
                model: candidate.name,
                chosen: k == best,
                error: judged.error,
                reason: match judged.rejection_reason {
                    Some(why) if k == best => format!("{why}; it comes closest"),
                    Some(why) => why,
                    None if k == best => "the cheapest within the tolerance".to_string(),
                    None => "within the tolerance, but more expensive".to_string(),
                },
            })
            .collect();
        let warning = serves.is_none().then(|| {
            let error = match n_unknown == 0 && excess.is_finite() {
                true => format!("with an expected error of {excess:.1} times the tolerance"),
                false => "with an error that is not known".to_string(),
            };
            let model = considered[best].model;
            format!("no model is known to be within the tolerance of the case: {model} comes closest, {error}")
        });
        Ok(Self { regime: chosen, considered, warning })
    }
}

/// A model that may compute the scene.
struct Candidate {
    name: &'static str,
    choice: fn() -> ModelChoice,
    /// Errors of the model's approximations at default settings, of the quantities in [`JUDGED_QUANTITIES`].
    own_errors: [f64; 4],
}

/// The quantities that a tolerance is given for.
const JUDGED_QUANTITIES: [QuantityOfInterest; 4] = [
    QuantityOfInterest::Restitution,
    QuantityOfInterest::ContactTime,
    QuantityOfInterest::PeakForce,
    QuantityOfInterest::PeakPressure,
];

/// The index of the candidate for bodies that flow, which elements may refuse.
const FLOWING: usize = 6;

/// The candidates, from the cheapest to the most expensive, and the law of bodies that flow.
const CANDIDATES: [Candidate; FLOWING + 1] = [
    Candidate {
        name: "hertz = {}",
        choice: || ModelChoice::Hertz { finite_size: false },
        own_errors: [0.0; 4],
    },
    Candidate {
        name: "hertz = { finite_size = true }",
        choice: || ModelChoice::Hertz { finite_size: true },
        own_errors: [0.0; 4],
    },
    Candidate {
        name: "ting = { finite_size = true }",
        choice: || ModelChoice::Ting { finite_size: true, tolerance: defaults::TING_TOLERANCE },
        own_errors: [2e-4, 2e-4, 2e-4, 1e-3],
    },
    Candidate {
        name: "condensed = {}",
        choice: || ModelChoice::Condensed(defaults::CONDENSED),
        own_errors: [1e-4, 5e-4, 2e-3, 1e-2],
    },
    Candidate {
        name: "condensed = { vibration_modes = 12 }",
        choice: || {
            let options = CondensedOptions { vibration_modes: 12, ..defaults::CONDENSED };
            ModelChoice::Condensed(options)
        },
        own_errors: [1e-4, 5e-4, 3e-3, 1e-2],
    },
    Candidate {
        name: "fem = {}",
        choice: || ModelChoice::Fem,
        own_errors: [2e-4, 1.5e-3, 3e-3, 1e-2],
    },
    Candidate {
        name: "law = { mean_pressure = {} }",
        choice: || ModelChoice::Law {
            law: LawInput { family: LawFamily::MeanPressure, values: Vec::new() },
            end_rule: defaults::LAW_END,
            tolerance: defaults::LAW_TOLERANCE,
        },
        own_errors: [0.0; 4],
    },
];

/// Share of the default tolerances down to which meshes are made as fine as a case asks.
const MIN_SHARE_OF_TOLERANCE: f64 = 0.05;

/// The expected error of a candidate.
struct CandidateVerdict {
    error: ExpectedError,
    /// Number of effects whose error is unknown.
    n_unknown: usize,
    /// Largest known error over its tolerance.
    excess: f64,
    /// Whether elements would take minutes for a result whose error is unknown all the same.
    is_futile: bool,
    /// Whether a result would come with the advice to use another model.
    is_advised: bool,
    /// Whether the model can compute the scene at any tolerance.
    is_possible: bool,
    /// Why the model is not suitable.
    rejection_reason: Option<String>,
}

/// Returns the index of the most complete candidate that is possible: of the most accurate one, or of the cheapest within the
/// tolerance but for an effect whose error none knows.
fn closest(judged: &[CandidateVerdict]) -> usize {
    let possible = judged.iter().enumerate().filter(|(_, judged)| judged.is_possible);
    // Positive floats are in the order of their bits.
    let closest = possible.min_by_key(|(_, judged)| {
        let CandidateVerdict { n_unknown, is_futile, is_advised, excess, .. } = judged;
        (*n_unknown, *is_futile, *is_advised, excess.max(1.0).to_bits())
    });
    closest.map_or(judged.len() - 1, |(k, _)| k)
}

impl Candidate {
    /// Judges the model by the tolerance of the case.
    fn judge(&self, scene: &Scene, estimate: &Estimate) -> CandidateVerdict {
        let own = &scene.clone().with_model((self.choice)());
        let support = &|effect: &dyn Effect| method_of(own).support(effect, own, estimate);
        let model = effects::ConsideredModel { case: scene, own, estimate, support };
        let has_fields = matches!(own.model(), ModelChoice::Fem | ModelChoice::Condensed(_));
        let disobeyed = EFFECTS.into_iter().find(|effect| model.disobeys(*effect));
        let disobeyed =
            disobeyed.map(|it| format!("cannot do as [effects] says for {}", it.name()));
        let no_fields = (!has_fields && asks_for_fields(scene))
            .then(|| "cannot write the requested snapshots or probes".to_string());
        let mut found = EFFECTS.map(|effect| (effect.name(), effect.adequacy(&model)));
        let by_effect = found.iter_mut().find_map(|(_, it)| it.impossible.take());
        let impossible = disobeyed.or(no_fields).or(by_effect);
        let advice = found.iter_mut().rev().find_map(|(_, it)| it.advice.take());
        let unknown: Vec<_> = found.iter().filter(|(_, it)| it.error.is_none()).collect();
        let known = || found.iter().filter_map(|(name, it)| Some((*name, it.is_lack, it.error?)));
        let own_error = self.own_error(scene, estimate, has_fields);
        let error = known().fold(own_error, |sum, (_, _, change)| sum.plus(change));
        let lacks = known().filter(|(_, is_lack, _)| *is_lack);
        let worst = lacks
            .map(|(name, _, change)| (name, excess(&change, scene, estimate)))
            .reduce(|worst, next| if next.1 > worst.1 { next } else { worst });
        let total = excess(&error, scene, estimate);
        let (is_possible, is_advised) = (impossible.is_none(), advice.is_some());
        let first_unknown = unknown.first().map(|(name, _)| *name);
        let inaccuracy = || inaccuracy(first_unknown, worst, total);
        CandidateVerdict {
            error: if unknown.is_empty() { (&error).into() } else { ExpectedError::default() },
            n_unknown: unknown.len(),
            is_futile: !unknown.is_empty() && *own.model() == ModelChoice::Fem,
            is_advised,
            excess: total,
            is_possible,
            rejection_reason: impossible.or_else(inaccuracy).or(advice),
        }
    }

    /// Returns the errors of the model's approximations, which fall with the tolerance where it chooses the mesh.
    fn own_error(&self, scene: &Scene, estimate: &Estimate, has_fields: bool) -> QuantityErrors {
        let (usual, asked) = (defaults::accuracy(), scene.accuracy());
        let is_made_finer = has_fields && scene.mesh().contact_element_size.is_none();
        QuantityErrors::from_fn(|quantity| {
            let Some(k) = JUDGED_QUANTITIES.iter().position(|judged| *judged == quantity) else {
                return Some(0.0);
            };
            let share = tolerance_of(&asked, quantity)? / tolerance_of(&usual, quantity)?;
            let is_followed = is_made_finer && (MIN_SHARE_OF_TOLERANCE..1.0).contains(&share);
            let error = self.own_errors[k] * estimate.scale(quantity);
            Some(error * if is_followed { share } else { 1.0 })
        })
    }
}

/// Returns why a model is not accurate enough: it lacks an effect of unknown size, or the sum of its errors, of which the worst is
/// given, is larger than the tolerance.
fn inaccuracy(unknown: Option<&str>, worst: Option<(&str, f64)>, total: f64) -> Option<String> {
    if let Some(name) = unknown {
        return Some(format!("lacks {name}, whose effect cannot be estimated"));
    }
    let lacks = worst.filter(|(_, part)| *part > 0.5 * total).map(|(name, _)| name);
    (total > 1.0).then(|| match lacks {
        Some(name) => format!("lacks {name}: an error of {total:.2} times the tolerance"),
        None => format!("has an error of {total:.2} times the tolerance"),
    })
}

/// Returns the largest error over its tolerance.
fn excess(error: &QuantityErrors, scene: &Scene, estimate: &Estimate) -> f64 {
    let accuracy = scene.accuracy();
    let over = |quantity| {
        let tolerance = tolerance_of(&accuracy, quantity)? * estimate.scale(quantity);
        Some(error.size(quantity).unwrap_or(0.0) / tolerance)
    };
    QuantityOfInterest::ALL.into_iter().filter_map(over).fold(0.0, f64::max)
}

/// Returns whether the case asks for snapshots or probes.
fn asks_for_fields(scene: &Scene) -> bool {
    !scene.probes().is_empty() || scene.snapshots().is_some_and(|asked| !asked.is_empty())
}
