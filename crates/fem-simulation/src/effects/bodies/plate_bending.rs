//! A plate bends under the impact, and its bending waves carry energy away. Closed forms, contact laws and condensed bodies have
//! the plate as a dashpot in series.
//!
//! Decided by the waves that return from the far face and the edge within the contact ([`PlateImpact`]). While none does, the
//! plate is a half-space, exactly, and is computed as one.

use fem_case::engineering::{number, show};
use fem_case::{ModelChoice, PlateSupport, Scene, Switch};
use fem_collision::{Collision, QuantityOfInterest};
use fem_laws::{plate_slow_contact_error, plate_thickness_error};

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::simplified_scene::{Transformation, TransformedScene};
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, NamedEffect, PlateBending};
use crate::effects::ting_prediction::TingPrediction;
use crate::estimate::Estimate;
use crate::estimate::plate_impact::{LARGE_DEFLECTION, PlateImpact, PlateRegime, THIN};
use crate::plan::limits::check_size_of_elements;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Deflection over the thickness below which the stretching of a plate of elements is left out: 0.25 % of its loss.
const NO_STRETCHING: f64 = 0.05;

/// Changes of the quantities, relative to those of a half-space, over the [local stiffening](PlateImpact::local_stiffening) of a free
/// plate: the largest of six pairs of steel, glass, PMMA and alumina between condensed bodies and explicit elements. Exact
/// elastodynamics of layers of 2 to 12 mm has 0.36 to 0.41 in the approach. On 130 random plates of 0.2 to 6 ball radii the bars hold all
/// differences from explicit elements, the largest with 0.70 of the bar.
const OF_LOCAL_STIFFENING: [f64; 6] = [0.0, 0.31, 0.31, 0.42, 0.27, 0.25];

impl PlateBending {
    /// Returns whether the scene has a plate that is not a half-space to its impact.
    pub(in crate::effects) fn is_needed(scene: &Scene, estimate: &Estimate) -> bool {
        let switch = scene.effects().plate_bending;
        PlateImpact::of(scene, estimate).is_some_and(|plate| match switch {
            Some(Switch::Off) => false,
            Some(Switch::On) => true,
            Some(Switch::Auto) | None => !plate.is_half_space(),
        })
    }

    /// Returns the support of a model that computes the plate of a scene, if there is one.
    pub(crate) fn of_model(scene: &Scene) -> Option<Support> {
        scene.bodies().iter().find_map(|body| body.plate())?;
        Some(match Self::check(scene) {
            Ok(()) => Support::Inherent { idle: "" },
            Err(_) => Support::Lacks,
        })
    }

    /// Returns the error of the plate in the model of a scene that computes it; `None` if it is unknown.
    fn error_of_term(scene: &Scene, estimate: &Estimate) -> Option<QuantityErrors> {
        if !Self::is_needed(scene, estimate) {
            return Some(QuantityErrors::ZERO);
        }
        let neglect_error = Self.neglect_error(scene, estimate);
        let status = EffectStatus { is_lacking: false, neglect_error };
        let error = Self.model_form_error(scene, estimate, &status);
        error.size(QuantityOfInterest::Restitution).is_some().then_some(error)
    }

    /// Returns the difference between Ting's impacts on the plate without an edge and on a half-space.
    fn change_by_bending(scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let side = scene.bodies().iter().position(|body| body.plate().is_some())?;
        let bent = PlateBending.switched(scene, Some(Switch::On));
        let half_space = PlateBending.switched(&bent.with_half_space(side), None);
        let [bent, half_space] = [bent, half_space].map(|scene| estimate.regime_of(scene).ok());
        let (bent, half_space) = (bent?, half_space?);
        let sized = [&bent, &half_space].map(|regime| TingPrediction::of(regime, true));
        let [bent, half_space] = match sized {
            [Ok(bent), Ok(half_space)] => [bent, half_space],
            // A contact too wide for the first order of the spheres' size.
            _ => [
                TingPrediction::on_thick_plate(&bent).ok()?,
                TingPrediction::of(&half_space, false).ok()?,
            ],
        };
        Some(bent.change_from(&half_space))
    }

    /// Checks that the model of a scene, which effects have transformed, computes its plate.
    ///
    /// # Errors
    /// A bonded plate in a model other than explicit elements.
    pub(crate) fn check(scene: &Scene) -> Result<(), Rejection> {
        let mut bodies = scene.bodies().iter().enumerate();
        let Some((side, plate)) = bodies.find_map(|(k, body)| Some((k, body.plate()?))) else {
            return Ok(());
        };
        let model = scene.model().name();
        match scene.model() {
            ModelChoice::Fem => Ok(()),
            _ if plate.support == PlateSupport::Bonded => {
                let message = format!(
                    "model {model} cannot compute a plate that is bonded: a rigid base gives its waves back within the contact"
                );
                let help = match check_size_of_elements(scene) {
                    Ok(()) => "use model fem, or auto, which chooses it".to_string(),
                    Err(rejection) => rejection.help.unwrap_or(rejection.message),
                };
                Err(Rejection::new(format!("body.{side}.plate.support"), message).with_help(help))
            }
            _ => Ok(()),
        }
    }
}

impl Effect for PlateBending {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let plate = PlateImpact::of(scene, estimate)?;
        let name = plate.body.name();
        let thicknesses = number(plate.thicknesses, 2);
        let mut text = match plate.regime {
            PlateRegime::Thick => {
                format!(
                    "waves travel {thicknesses} thicknesses of {name} during the contact and do not return"
                )
            }
            _ => format!(
                "waves travel {thicknesses} thicknesses of {name} during the contact; λ = {}",
                number(plate.lambda, 2)
            ),
        };
        match plate.edge_return {
            0.0 => text += "; the contact lasts until waves are back from its edge",
            ..=1.0 => {
                let share = number(plate.edge_return, 2);
                text += &format!("; surface waves are back from its edge after {share} of it");
            }
            _ => {}
        }
        let open = match (plate.edge_return <= 1.0, plate.regime) {
            (true, _) => Some(format!(
                "waves return from the edge of {name} within the contact, and this model does not know what they give back"
            )),
            (_, PlateRegime::Between) if !has_thickness(scene) => Some(format!(
                "{name} is neither thin nor a half-space to this impact: waves travel {thicknesses} thicknesses, and \
                 thin-plate theory holds from {THIN}; model fem or condensed, or finite_size = true of ting and hertz, has the thickness"
            )),
            _ => None,
        };
        Some(Relevance {
            is_needed: Self::is_needed(scene, estimate),
            number: text,
            if_not_needed: "it is a half-space".to_string(),
            open_error: "the plate is not computed".to_string(),
            warning: open,
        })
    }

    fn transform(
        &self,
        scene: &Scene,
        estimate: &Estimate,
    ) -> Result<Option<TransformedScene>, Rejection> {
        let Some(side) = scene.bodies().iter().position(|body| body.plate().is_some()) else {
            return Ok(None);
        };
        check_edge(scene, estimate, side)?;
        if Self::is_needed(scene, estimate) {
            return Ok(None);
        }
        let relevance = self.relevance(scene, estimate).unwrap_or_default();
        let support = Support::decided(false, format!("{}: a half-space", relevance.number));
        let scene = PlateBending.switched(&scene.with_half_space(side), None);
        Ok(Some(TransformedScene { scene, outcome: Transformation::Decides(support) }))
    }

    fn forced(&self, scene: &Scene, estimate: &Estimate) -> Option<String> {
        let plate = PlateImpact::of(scene, estimate)?;
        let is_off = scene.effects().plate_bending == Some(Switch::Off);
        (is_off && !plate.is_half_space()).then(|| {
            let change = self.neglect_error(scene, estimate).unwrap_or_default();
            change.warning(Self::NAME)
        })
    }

    /// Difference between Ting's impacts on the thin plate and on a half-space, with its waves.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let plate = PlateImpact::of(scene, estimate)?;
        if plate.is_half_space() {
            return Some(NeglectError::NOTHING);
        }
        plate.is_dashpot().then(|| Self::change_by_bending(scene, estimate)).flatten()
    }

    /// Every model has the error of its plate theory, and nothing without a plate. That of elements is not known before the run where
    /// the contact lasts.
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        let fault = Self::check(model.own).err();
        let fault = fault.filter(|_| Self::is_needed(model.own, model.estimate));
        let lasts =
            || PlateImpact::of(model.own, model.estimate).is_some_and(|plate| plate.lasts());
        let error = match *model.own.model() == ModelChoice::Fem && lasts() {
            true => None,
            false => Self::error_of_term(model.own, model.estimate),
        };
        Adequacy { error, impossible: fault.map(|fault| fault.message), ..Adequacy::FULL }
    }

    /// All models leave out that a plate stretches as it bends. A model with a plate as a dashpot has the error of the fit to elements that includes its finite thickness; without it that is
    /// part of the error of finite size. Where waves return from the edge, the error is unknown.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let Some(plate) = PlateImpact::of(scene, estimate) else { return QuantityErrors::ZERO };
        let is_of_elements = *scene.model() == ModelChoice::Fem;
        if plate.is_half_space() || is_of_elements && plate.deflection < NO_STRETCHING {
            return QuantityErrors::ZERO;
        }
        let change = match is_of_elements {
            true => Self::change_by_bending(scene, estimate),
            false => status.neglect_error.filter(|_| plate.is_dashpot()),
        };
        let Some((change, stretching)) = change.zip(plate.linear_theory_error()) else {
            return QuantityErrors::default();
        };
        let all = change.of_all_quantities(estimate);
        if status.is_lacking {
            return all;
        }
        if is_of_elements {
            return all.times(stretching);
        }
        let share = plate_thickness_error(plate.thicknesses) + stretching + plate.relaxation_error;
        let stiffer = plate.local_stiffening(estimate);
        QuantityErrors::from_fn(|quantity| {
            let slow = match quantity {
                QuantityOfInterest::ContactTime => plate_slow_contact_error(plate.lambda),
                _ => 0.0,
            };
            let local = OF_LOCAL_STIFFENING[quantity as usize] * stiffer * estimate.scale(quantity);
            Some(all.size(quantity)? * (share + slow) + local)
        })
    }

    fn warnings_of_result(&self, scene: &Scene, estimate: &Estimate, _: &Collision) -> Vec<String> {
        let Some(plate) = PlateImpact::of(scene, estimate) else { return Vec::new() };
        if !Self::is_needed(scene, estimate) {
            return Vec::new();
        }
        let stretched = (plate.deflection > LARGE_DEFLECTION).then(|| {
            format!(
                "{} would bend by {} of its thicknesses: from {LARGE_DEFLECTION} on it stretches, which linear plate theory leaves \
                 out, and the result means nothing; use a slower or lighter body, or a thicker plate",
                plate.body.name(),
                number(plate.deflection, 2)
            )
        });
        let is_of_elements = *scene.model() == ModelChoice::Fem;
        let of_term = self.relevance(scene, estimate).and_then(|relevance| relevance.warning);
        stretched.into_iter().chain(of_term.filter(|_| !is_of_elements)).collect()
    }
}

/// Returns whether the model of a scene has the finite thickness of its plate.
fn has_thickness(scene: &Scene) -> bool {
    matches!(
        scene.model(),
        ModelChoice::Fem
            | ModelChoice::Condensed(_)
            | ModelChoice::Hertz { finite_size: true }
            | ModelChoice::Ting { finite_size: true, .. }
    )
}

/// Checks that a plate is wider than its contact.
fn check_edge(scene: &Scene, estimate: &Estimate, side: usize) -> Result<(), Rejection> {
    let diameter = scene.bodies()[side].plate().and_then(|plate| plate.diameter);
    let least = 4.0 * estimate.contact_radius;
    let Some(diameter) = diameter.filter(|diameter| *diameter < least) else { return Ok(()) };
    let message = format!(
        "the diameter of the plate is {}, too small for the contact, whose radius is {}",
        show(diameter, "m"),
        show(estimate.contact_radius, "m")
    );
    let help = format!("the diameter must be at least {}", show(least, "m"));
    Err(Rejection::new(format!("body.{side}.plate.diameter"), message).with_help(help))
}
