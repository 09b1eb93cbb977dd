//! The cheapest model that serves, `[model] auto = {}`.
//!
//! What a case asks for is in `[output]` (fields, or none) and in `[accuracy]`. What a model is off by
//! is estimated before anything is computed: what the effects are worth that the scene calls for and
//! the model lacks ([`Effect::neglect_error`]), and what its own approximations are known to cost. Effects
//! that no model has choose none; the plan warns of them.
//! One that lacks what nothing foretells the worth of does not serve, nor one whose result would itself advise another.

use fem_case::{
    Accuracy, CaseFile, CondensedOptions, EffectsTable, ModelChoice, Scene, Snapshots, Switch,
};
use fem_collision::QuantityOfInterest;
use fem_laws::Ting;
use serde::Serialize;

use super::method_of;
use crate::effects::{
    Effect, EffectStatus, FiniteSizeEffect, FiniteStrain, ModelFormError, PartnerWaves, Support,
    Vibration, Viscoelasticity,
};
use crate::estimate::Estimate;
use crate::estimate::viscous_flow;
use crate::estimate::viscous_flow::widest_contact;
use crate::models::method::{Method, Model, SharedModels};
use crate::rejection::Rejection;

/// The cheapest that serves, `[model] auto = {}`.
#[derive(Clone, Copy, Debug)]
pub struct AutoMethod;

impl Method for AutoMethod {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn build(&self, scene: &Scene, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        let chosen = left_open(scene)?;
        method_of(&chosen).build(&chosen, shared)
    }

    fn price(&self, scene: &Scene) -> Result<u64, Rejection> {
        let chosen = left_open(scene)?;
        method_of(&chosen).price(&chosen)
    }

    /// The case names the model that was chosen.
    fn resolve(&self, scene: &Scene, file: CaseFile) -> Result<CaseFile, Rejection> {
        let chosen = left_open(scene)?;
        method_of(&chosen).resolve(&chosen, file)
    }
}

/// A scene that leaves its model open, with the one that serves.
fn left_open(scene: &Scene) -> Result<Scene, Rejection> {
    match scene.model() {
        ModelChoice::Auto => Ok(SelectedModel::of(scene)?.scene),
        _ => Err(Rejection::chose_another(scene, "auto")),
    }
}

/// Expected error of a model, as magnitudes; `None` where it cannot be estimated.
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

impl From<&ModelFormError> for ExpectedError {
    fn from(model_form_error: &ModelFormError) -> Self {
        Self {
            restitution: model_form_error.size(QuantityOfInterest::Restitution),
            contact_time_s: model_form_error.size(QuantityOfInterest::ContactTime),
            peak_force_n: model_form_error.size(QuantityOfInterest::PeakForce),
            peak_pressure_pa: model_form_error.size(QuantityOfInterest::PeakPressure),
        }
    }
}

/// A model that was considered for a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelCandidate {
    /// The model, as `[model]` would say it.
    pub model: &'static str,
    /// Whether it computes the collision.
    pub chosen: bool,
    /// Expected error.
    pub error: ExpectedError,
    /// Why it serves or does not.
    pub reason: String,
}

/// A scene with the model that computes it.
#[derive(Clone, Debug)]
pub struct SelectedModel {
    /// The scene, of which the model is no longer open.
    pub scene: Scene,
    /// All models, from the cheapest to the most expensive; empty if the case names its own.
    pub considered: Vec<ModelCandidate>,
    /// That none serves.
    pub warning: Option<String>,
}

impl SelectedModel {
    /// Chooses, where the case leaves it open.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite, or whose bodies flow into each other.
    pub fn of(scene: &Scene) -> Result<Self, Rejection> {
        if *scene.model() != ModelChoice::Auto {
            return Ok(Self { scene: scene.clone(), considered: Vec::new(), warning: None });
        }
        let estimate = Estimate::checked(scene)?;
        viscous_flow::check(scene, &estimate)?;
        let judged = CANDIDATES.map(|candidate| candidate.judge(scene, &estimate));
        let serves = judged.iter().position(|judged| judged.unfit.is_none());
        let best = serves.unwrap_or_else(|| closest(&judged));
        let excess = judged[best].excess;
        let considered = judged.into_iter().zip(CANDIDATES).enumerate();
        let considered: Vec<ModelCandidate> = considered
            .map(|(k, (judged, candidate))| ModelCandidate {
                model: candidate.name,
                chosen: k == best,
                error: judged.error,
                reason: match judged.unfit {
                    Some(why) if k == best => format!("{why}; it comes closest"),
                    Some(why) => why,
                    None if k == best => "the cheapest that serves".to_string(),
                    None => "serves, and costs more".to_string(),
                },
            })
            .collect();
        let scene = scene.clone().with_model(CANDIDATES[best].choice());
        let warning = serves.is_none().then(|| {
            format!(
                "no model is known to be within the tolerance of the case: {} comes closest, with {:.1} times it",
                considered[best].model, excess
            )
        });
        Ok(Self { scene, considered, warning })
    }
}

/// A model as it could compute a scene.
#[derive(Clone, Copy)]
struct Candidate {
    name: &'static str,
    choice: fn() -> ModelChoice,
    /// Effects that it lacks and others have.
    lacks: &'static [&'static dyn Effect],
    /// Whether it has fields.
    has_fields: bool,
    /// Whether it has the spheres' own compliance to first order in the contact's size.
    is_first_order: bool,
    /// Known errors of the model's approximations at default settings: restitution, contact time, peak
    /// force, peak pressure.
    own: [f64; 4],
}

/// The candidates, from the cheapest to the most expensive.
const CANDIDATES: [Candidate; 6] = [
    Candidate {
        name: "hertz = {}",
        choice: || ModelChoice::Hertz { finite_size: false },
        lacks: &[&Viscoelasticity, &FiniteSizeEffect, &FiniteStrain, &PartnerWaves, &Vibration],
        has_fields: false,
        is_first_order: false,
        own: [0.0; 4],
    },
    Candidate {
        name: "hertz = { finite_size = true }",
        choice: || ModelChoice::Hertz { finite_size: true },
        lacks: &[&Viscoelasticity, &FiniteStrain, &PartnerWaves, &Vibration],
        has_fields: false,
        is_first_order: true,
        own: [0.0; 4],
    },
    Candidate {
        name: "ting = { finite_size = true }",
        choice: || ModelChoice::Ting { finite_size: true, tolerance: Ting::DEFAULT_TOLERANCE },
        lacks: &[&FiniteStrain, &PartnerWaves, &Vibration],
        has_fields: false,
        is_first_order: true,
        own: [2e-4, 2e-4, 2e-4, 1e-3],
    },
    Candidate {
        name: "condensed = {}",
        choice: || ModelChoice::Condensed(CondensedOptions::default()),
        lacks: &[&FiniteStrain, &PartnerWaves, &Vibration],
        has_fields: true,
        is_first_order: false,
        own: [1e-4, 5e-4, 2e-3, 1e-2],
    },
    Candidate {
        name: "condensed = { vibration_modes = 12 }",
        choice: || {
            let options = CondensedOptions { vibration_modes: 12, ..CondensedOptions::default() };
            ModelChoice::Condensed(options)
        },
        lacks: &[&FiniteStrain, &PartnerWaves],
        has_fields: true,
        is_first_order: false,
        own: [1e-4, 5e-4, 3e-3, 1e-2],
    },
    Candidate {
        name: "fem = {}",
        choice: || ModelChoice::Fem,
        lacks: &[],
        has_fields: true,
        is_first_order: false,
        own: [2e-4, 1.5e-3, 3e-3, 1e-2],
    },
];

/// Share of the default tolerances down to which meshes are made as fine as a case asks.
const FINEST: f64 = 0.05;

/// Returns the expected error of a candidate.
struct Judged {
    error: ExpectedError,
    /// The worst of it, in tolerances; infinite where it is not known.
    excess: f64,
    /// Whether it can be had at all.
    is_possible: bool,
    /// Why it does not serve.
    unfit: Option<String>,
}

/// Returns the most accurate candidate that is available.
fn closest(judged: &[Judged]) -> usize {
    let possible = judged.iter().enumerate().filter(|(_, judged)| judged.is_possible);
    let closest = possible.min_by(|(_, a), (_, b)| a.excess.total_cmp(&b.excess));
    closest.map_or(judged.len() - 1, |(k, _)| k)
}

impl Candidate {
    fn choice(&self) -> ModelChoice {
        (self.choice)()
    }

    fn judge(&self, scene: &Scene, estimate: &Estimate) -> Judged {
        let accuracy = scene.accuracy();
        let mut error = self.own_error(scene, estimate);
        let mut worst: Option<(&str, f64)> = None;
        let mut unknown: Option<&str> = None;
        for effect in self.lacks {
            // What elements leave out, too, tells none from another.
            let is_small = effect.name() == FiniteStrain::NAME
                && FiniteStrain::laws(scene, estimate) == [None; 2];
            if is_small {
                continue;
            }
            let Some(change) = self.without(*effect, scene, estimate) else {
                unknown = unknown.or(Some(effect.name()));
                continue;
            };
            error = error.and(change);
            let part = excess(&change, estimate, &accuracy);
            if worst.is_none_or(|(_, most)| part > most) {
                worst = Some((effect.name(), part));
            }
        }
        let told = excess(&error, estimate, &accuracy);
        let impossible = self.impossible(scene, estimate);
        let off = || format!("{told:.2} times the tolerance");
        let unfit = match (&impossible, unknown, told > 1.0, worst) {
            (Some(why), ..) => Some(why.clone()),
            (None, Some(name), ..) => {
                Some(format!("lacks {name}, whose effect cannot be estimated"))
            }
            (None, None, true, Some((name, part))) if part > 0.5 * told => {
                Some(format!("lacks {name}: {}", off()))
            }
            (None, None, true, _) => Some(format!("has an error of {}", off())),
            (None, None, false, _) => None,
        };
        let unfit = unfit.or_else(|| self.called_out(estimate).map(str::to_string));
        let (error, excess) = match unknown {
            Some(_) => (ModelFormError::default(), f64::INFINITY),
            None => (error, told),
        };
        Judged { error: (&error).into(), excess, is_possible: impossible.is_none(), unfit }
    }

    /// Returns the errors of the model's approximations.
    fn own_error(&self, scene: &Scene, estimate: &Estimate) -> ModelFormError {
        let sizes = &estimate.effective.sizes;
        let accuracy = scene.accuracy();
        let default = Accuracy::within(Accuracy::DEFAULT_TOLERANCE);
        let is_made_finer = self.has_fields && scene.mesh().contact_element_size.is_none();
        let own = |headline: QuantityOfInterest| {
            let [restitution, contact_time, peak_force, peak_pressure] = self.own;
            let (own, scale, asked, usual) = match headline {
                QuantityOfInterest::Restitution => {
                    (restitution, 1.0, accuracy.restitution, default.restitution)
                }
                QuantityOfInterest::ContactTime => {
                    (contact_time, sizes.contact_time, accuracy.contact_time, default.contact_time)
                }
                QuantityOfInterest::PeakForce => {
                    (peak_force, sizes.peak_force, accuracy.peak_force, default.peak_force)
                }
                QuantityOfInterest::PeakPressure => (
                    peak_pressure,
                    sizes.peak_pressure,
                    accuracy.peak_pressure,
                    default.peak_pressure,
                ),
                _ => return Some(0.0),
            };
            let share = asked / usual;
            let is_followed = is_made_finer && (FINEST..1.0).contains(&share);
            Some(own * scale * if is_followed { share } else { 1.0 })
        };
        let of_size = EffectStatus { is_lacking: false, neglect_error: None };
        let of_size = match self.is_first_order {
            true => FiniteSizeEffect.model_form_error(scene, estimate, &of_size),
            false => ModelFormError::NOTHING,
        };
        ModelFormError::by(own).and(of_size)
    }

    /// Returns the model-form error by a neglected effect, `None` if the effect is called for and its size
    /// cannot be estimated.
    fn without(
        &self,
        effect: &dyn Effect,
        scene: &Scene,
        estimate: &Estimate,
    ) -> Option<ModelFormError> {
        let is_called_for =
            || effect.relevance(scene, estimate).is_some_and(|relevance| relevance.is_called_for);
        let neglect_error = effect.neglect_error(scene, estimate);
        let model_form_error = match &neglect_error {
            None if is_called_for() => return None,
            None => return Some(ModelFormError::NOTHING),
            // A material's law is taken as it is given: by how much laws differ tells no model from another.
            Some(neglect_error) if effect.name() == FiniteStrain::NAME => {
                ModelFormError::of(neglect_error, estimate)
            }
            Some(_) => {
                let standing = EffectStatus { is_lacking: true, neglect_error };
                effect.model_form_error(scene, estimate, &standing)
            }
        };
        // A contact that does not end has no time to be off by.
        let is_known = [QuantityOfInterest::Restitution, QuantityOfInterest::PeakForce]
            .into_iter()
            .all(|headline| model_form_error.size(headline).is_some());
        let part = match effect.name() == PartnerWaves::NAME {
            true => self.own_waves(scene, estimate),
            false => 1.0,
        };
        is_known.then(|| model_form_error.told().times(part))
    }

    /// Returns the reason why its result would advise another model at any tolerance.
    fn called_out(&self, estimate: &Estimate) -> Option<&'static str> {
        match self.choice() {
            ModelChoice::Condensed(options) => {
                Vibration::advises_another(estimate, options.vibration_modes)
            }
            _ => None,
        }
    }

    /// Relative error of the loss by waves in a large partner.
    fn own_waves(&self, scene: &Scene, estimate: &Estimate) -> f64 {
        let scene = scene.clone().with_model(self.choice());
        let answer = match scene.model() {
            ModelChoice::Ting { .. } => {
                PartnerWaves::of_term(&scene, estimate, PartnerWaves::radiating)
            }
            ModelChoice::Condensed(_) => PartnerWaves::of_condensed(&scene, estimate),
            _ => Support::Lacks,
        };
        match answer {
            Support::Lacks => 1.0,
            _ => PartnerWaves::error_of_term(&scene, estimate),
        }
    }

    /// The switch of the case that it cannot obey.
    fn disobeyed(&self, scene: &Scene) -> Option<&'static str> {
        let EffectsTable {
            viscoelasticity,
            partner_waves,
            mirror_symmetry,
            hourglass_control,
            bulk_viscosity,
            finite_strain,
            ..
        } = *scene.effects();
        let choice = self.choice();
        let is_hertz = matches!(choice, ModelChoice::Hertz { .. });
        let is_fem = choice == ModelChoice::Fem;
        let on = |switch: Option<Switch>| switch == Some(Switch::On);
        let disobeyed = [
            (on(viscoelasticity) && is_hertz, "viscoelasticity"),
            (on(partner_waves) && is_hertz, "partner waves"),
            (on(mirror_symmetry) && !self.has_fields, "mirror symmetry"),
            (on(hourglass_control) && !is_fem, "hourglass control"),
            (on(bulk_viscosity) && !is_fem, "bulk viscosity"),
            (on(finite_strain) && !is_fem, "finite strain"),
            (partner_waves == Some(Switch::Off) && is_fem, "partner waves"),
            (hourglass_control == Some(Switch::Off) && is_fem, "hourglass control"),
        ];
        disobeyed.into_iter().find(|(is, _)| *is).map(|(_, name)| name)
    }

    /// Returns the reason why it cannot compute the scene at any tolerance.
    fn impossible(&self, scene: &Scene, estimate: &Estimate) -> Option<String> {
        if let Some(effect) = self.disobeyed(scene) {
            return Some(format!("cannot obey the switch of {effect}"));
        }
        if !self.has_fields && asks_for_fields(scene) {
            return Some("has no fields to draw".to_string());
        }
        let size = self.is_first_order.then(|| scene.finite_size().ok()).flatten()?;
        size.check(widest_contact(scene, estimate)).err().map(|error| error.to_string())
    }
}

/// The largest error over the tolerance.
fn excess(error: &ModelFormError, estimate: &Estimate, accuracy: &Accuracy) -> f64 {
    let sizes = &estimate.effective.sizes;
    let over =
        |headline: QuantityOfInterest, allowed: f64| error.size(headline).unwrap_or(0.0) / allowed;
    [
        over(QuantityOfInterest::Restitution, accuracy.restitution),
        over(QuantityOfInterest::ContactTime, accuracy.contact_time * sizes.contact_time),
        over(QuantityOfInterest::PeakForce, accuracy.peak_force * sizes.peak_force),
        over(QuantityOfInterest::PeakPressure, accuracy.peak_pressure * sizes.peak_pressure),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

/// Whether the case asks for snapshots or probes.
fn asks_for_fields(scene: &Scene) -> bool {
    match scene.snapshots() {
        _ if !scene.probes().is_empty() => true,
        None => false,
        Some(Snapshots::Labels(labels)) => !labels.is_empty(),
        Some(Snapshots::Count(_)) => true,
        Some(Snapshots::Times(times)) => !times.is_empty(),
    }
}
