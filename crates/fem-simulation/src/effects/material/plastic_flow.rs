//! Plastic flow: which bodies yield, and what a model without it leaves open.
//!
//! A body yields where the peak pressure of the elastic contact, or the lower one that its yielding partner bears, exceeds that
//! of its first yield ([`FirstYield`]). Explicit elements compute the flow of a material with a known strength; below first
//! yield it is computed as elastic. The results of a run without flow are bounds. A material without a strength is judged by
//! that of the library's material with the nearest stiffness and density.

use fem_case::engineering::{Unit, number, show};
use fem_case::library::LikeMaterial;
use fem_case::{Body, MAX_MODULUS_OF_POLYMERS, Scene, Switch};
use fem_laws::{FirstYield, largest_von_mises};
use fem_material::{FlowRule, Material};

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::simplified_scene::{Transformation, TransformedScene};
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, FiniteStrain, MaterialLoss, NamedEffect, PlasticFlow};
use crate::estimate::Estimate;
use crate::estimate::plastic_flow::{first_yield, law_error, on_plate};
use crate::plan::limits::check_size_of_elements;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Largest Young's modulus (Pa) of elastomers, gels and foams, which tear and do not yield (Ashby 2011, chart of
/// modulus and strength).
const MAX_MODULUS_OF_ELASTOMERS: f64 = 0.1e9;
/// Mean pressure of a fully plastic contact over the flow stress (Tabor, *The Hardness of Metals*, 1951).
const FULLY_PLASTIC: f64 = 3.0;
/// Plastic strain and strain rate (1/s) up to which the flow stress of a struck body grows.
const STRAIN_AND_RATE_OF_DENTS: (f64, f64) = (0.2, 1e5);

/// First yield of a body in an elastic contact.
struct Onset<'a> {
    body: &'a Body,
    first: FirstYield,
    /// Material of the library whose strength stands for that of the body, which is not known.
    like: Option<LikeMaterial>,
}

impl<'a> Onset<'a> {
    /// Returns the onset of a body that may yield and whose strength, or that of its like in the library, is known.
    fn of(scene: &Scene, body: &'a Body, estimate: &Estimate) -> Option<Self> {
        let like = match body.yield_strength() {
            Some(_) => None,
            None if body.is_meant_elastic() => return None,
            None => Some(LikeMaterial::of(body.material().filter(|it| may_yield(it))?)?),
        };
        let strength = like.map_or(body.yield_strength(), |like| like.yield_strength)?;
        let first = FirstYield::new(&estimate.hertz, body.yielding_at(strength)?);
        Some(Self { body, first: on_plate(scene, first)?, like })
    }

    /// Returns the onsets of both bodies.
    fn of_both(scene: &'a Scene, estimate: &Estimate) -> [Option<Self>; 2] {
        scene.bodies().each_ref().map(|body| Self::of(scene, body, estimate))
    }

    /// Returns the onsets of the bodies that yield, the earliest first.
    fn of_yielding(scene: &'a Scene, estimate: &Estimate) -> Vec<Self> {
        let onsets = Self::of_both(scene, estimate);
        let borne =
            onsets.each_ref().map(|onset| onset.as_ref().map_or(f64::INFINITY, Self::borne));
        let both = onsets.into_iter().zip([borne[1], borne[0]]);
        let yields = |onset: &Self, borne: f64| {
            onset.elastic_pressure(estimate).min(borne) > onset.first.pressure
        };
        let both = both.filter_map(|(onset, borne)| onset.filter(|it| yields(it, borne)));
        let mut yielding: Vec<Self> = both.collect();
        yielding.sort_by(|a, b| a.first.pressure.total_cmp(&b.first.pressure));
        yielding
    }

    /// Returns the peak pressure of the elastic contact, Pa, with relaxed moduli and on the scene's plate.
    fn elastic_pressure(&self, estimate: &Estimate) -> f64 {
        self.first.elastic().peak_pressure.min(estimate.effective.sizes.peak_pressure)
    }

    /// Returns the largest pressure, Pa, that the body bears as it flows.
    fn borne(&self) -> f64 {
        let (strain, rate) = STRAIN_AND_RATE_OF_DENTS;
        let of_rule = |rule: &FlowRule| rule.flow_stress(strain, rate);
        let own = self.body.material().and_then(Material::flow).map(of_rule);
        FULLY_PLASTIC * own.unwrap_or(self.first.body().yield_strength)
    }

    /// Returns whether the body yields and has no flow rule.
    fn is_without_rule(&self) -> bool {
        self.body.material().is_none_or(|material| material.flow().is_none())
    }

    /// Returns the approach speed from which on the body yields, as text with the two digits that a strength deserves.
    fn speed(&self, estimate: &Estimate) -> String {
        let relaxed = self.first.elastic().peak_pressure / self.elastic_pressure(estimate);
        let speed = self.first.speed * relaxed.powf(2.5);
        let unit = Unit::fitting(speed, "m/s");
        format!("{} {}", number(unit.scaled(speed), 2), unit.symbol())
    }

    /// Returns why a model without flow gives bounds, and what to do.
    fn warning(&self, scene: &Scene, estimate: &Estimate) -> String {
        let (name, speed) = (self.body.name(), self.speed(estimate));
        if let Some(like) = self.like {
            let how = if like.is_alike { "as stiff and heavy as" } else { "most like" };
            let key = self.body.material_key("yield_strength");
            let elastic = self.body.material_key("elastic");
            return format!(
                "the strength of {name} is unknown, and it is {how} {0}, which yields from {speed} on: set {key}, or {elastic} = true",
                like.name
            );
        }
        let yields = format!("{name} yields from {speed} on");
        let material = self.body.material().filter(|_| self.is_without_rule());
        match material.map(|material| (material.relaxation(), material.named_law())) {
            Some((Some(_), _)) => {
                let key = self.body.material_key("relaxation");
                format!(
                    "{yields}, and a material that relaxes does not flow here: remove {key} for plastic flow"
                )
            }
            Some((_, Some(_))) => {
                let key = self.body.material_key("hyperelastic");
                format!("{yields}, and a hyperelastic material does not flow: remove {key}")
            }
            _ => {
                let is_narrow = scene
                    .bodies()
                    .iter()
                    .any(|it| it.plate().is_some_and(|plate| plate.diameter.is_some()));
                let has_mesh = !is_narrow || check_size_of_elements(scene).is_ok();
                let advice = if has_mesh { "model fem, or law" } else { "law" };
                let model = scene.model().name();
                format!("{yields}, and model {model} is elastic: use {advice} mean_pressure")
            }
        }
    }
}

impl Effect for PlasticFlow {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let yielding = Onset::of_yielding(scene, estimate);
        let is_needed = !yielding.is_empty();
        // What stands in the way of flow is told first.
        let told = yielding.iter().find(|onset| onset.like.is_some() || onset.is_without_rule());
        let warning = told.or(yielding.first()).map(|onset| onset.warning(scene, estimate));
        let others = Onset::of_both(scene, estimate).into_iter().flatten();
        let earliest = yielding
            .into_iter()
            .chain(others)
            .reduce(|a, b| if b.first.pressure < a.first.pressure { b } else { a });
        let Some(onset) = earliest else { return Some(without_strength(scene, estimate)) };
        let ratio = onset.elastic_pressure(estimate) / onset.first.pressure;
        let of_whom = match onset.like {
            Some(like) => format!("{} with the strength of lib:{}", onset.body.name(), like.name),
            None => onset.body.name().to_string(),
        };
        Some(Relevance {
            is_needed,
            number: format!("peak pressure / pressure of first yield of {of_whom} = {ratio:.2}"),
            if_not_needed: format!("it yields from {} on", onset.speed(estimate)),
            open_error: "the results are bounds".to_string(),
            warning,
        })
    }

    /// Makes materials elastic that do not flow in this impact, or are not to.
    fn transform(
        &self,
        scene: &Scene,
        estimate: &Estimate,
    ) -> Result<Option<TransformedScene>, Rejection> {
        let is_possible = scene.flows();
        let switch = scene.effects().plastic_flow;
        if !is_possible && switch == Some(Switch::On) {
            let message = "plastic_flow is \"on\", and no material has a strength";
            let help = "give a material its yield_strength, or write \"auto\" or \"off\"";
            return Err(Rejection::new("effects.plastic_flow", message).with_help(help));
        }
        let Relevance { is_needed, number, if_not_needed, .. } =
            self.relevance(scene, estimate).unwrap_or_default();
        let why = match switch {
            Some(Switch::Off) => "switched off".to_string(),
            None | Some(Switch::Auto) if !is_needed => {
                format!("{if_not_needed}, and is computed as elastic")
            }
            _ => return Ok(None),
        };
        let elastic = scene.bodies().each_ref().map(|body| Some(body.material()?.without_flow()));
        let support = Support::decided(false, format!("{number}; {why}"));
        let scene = self.switched(scene, None).with_materials(elastic);
        Ok(is_possible
            .then_some(TransformedScene { scene, outcome: Transformation::Decides(support) }))
    }

    fn forced(&self, scene: &Scene, estimate: &Estimate) -> Option<String> {
        let is_off = scene.effects().plastic_flow == Some(Switch::Off) && scene.flows();
        let ignored = Onset::of_yielding(scene, estimate).into_iter().next().filter(|_| is_off);
        ignored.map(|onset| {
            format!(
                "{} yields from {} on, and effects.plastic_flow is \"off\": the results are bounds, those of elastic bodies",
                onset.body.name(),
                onset.speed(estimate)
            )
        })
    }

    /// A body that flows loses more than its material does, and is not strained as a hyperelastic one.
    fn silences(&self, _: &Scene, _: &Estimate) -> &'static [&'static str] {
        &[MaterialLoss::NAME, FiniteStrain::NAME]
    }

    /// The change by the mean-pressure law.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let (_, first) = first_yield(scene, &estimate.hertz)?;
        Some(NeglectError::of_changes(estimate, first.change()))
    }

    /// Flow that no model computes makes no difference between them. A law that dents has an error of its own.
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        match (Self::of_elements(model.case, model.estimate), law_error(model.own, model.estimate))
        {
            (Support::Lacks, _) => Adequacy::FULL,
            (_, Some(error)) => Adequacy { error: Some(error), ..Adequacy::FULL },
            _ => model.with_or_without(self),
        }
    }

    /// Without flow all quantities are bounds. A contact law that dents has an error of its own.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        match status.is_lacking && !Onset::of_yielding(scene, estimate).is_empty() {
            true => QuantityErrors::default(),
            false => law_error(scene, estimate).unwrap_or(QuantityErrors::ZERO),
        }
    }

    fn is_dissipative(&self) -> bool {
        true
    }
}

impl PlasticFlow {
    /// Returns whether the impact makes a body flow whose material has a flow rule, and the case allows it.
    pub(crate) fn is_on(scene: &Scene, estimate: &Estimate) -> bool {
        let has_rule = |onset: &Onset| !onset.is_without_rule();
        scene.effects().plastic_flow != Some(Switch::Off)
            && Onset::of_yielding(scene, estimate).iter().any(has_rule)
    }

    /// Returns the support of explicit elements: they compute flow if every body that yields has a flow rule.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Support {
        let yielding = Onset::of_yielding(scene, estimate);
        match scene.flows() && !yielding.iter().any(Onset::is_without_rule) {
            true => Support::Computes { idle: "" },
            false => Support::Lacks,
        }
    }
}

/// Returns whether a material without a strength is judged by its like: not one as soft as rubber, which tears, and not a polymer
/// that relaxes or has a hyperelastic law, whose strength is that of its rate.
fn may_yield(material: &Material) -> bool {
    let is_plain = material.named_law().is_none() && material.relaxation().is_none();
    let softest = if is_plain { MAX_MODULUS_OF_ELASTOMERS } else { MAX_MODULUS_OF_POLYMERS };
    material.instantaneous().youngs_modulus() >= softest
}

/// Returns the relevance for bodies whose strength is neither known nor that of a material of the library.
fn without_strength(scene: &Scene, estimate: &Estimate) -> Relevance {
    let peak = estimate.effective.sizes.peak_pressure;
    let stress = |body: &Body| {
        let nu = body.material()?.instantaneous().poissons_ratio();
        Some(format!("{} {}", body.name(), show(largest_von_mises(nu) * peak, "Pa")))
    };
    let stresses: Vec<String> = scene.bodies().iter().filter_map(stress).collect();
    Relevance {
        number: format!("the largest von Mises stress is {}", stresses.join(", ")),
        if_not_needed: "bodies like these are not known to yield".to_string(),
        ..Relevance::default()
    }
}
