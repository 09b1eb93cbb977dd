//! Plastic flow: its onset, and an estimate of the loss where no model computes it.
//!
//! Decided by the peak pressure of Hertz over that of first yield ([`FirstYield`]). Explicit elements compute a material that
//! has a flow rule; below first yield it is computed as elastic. Without a yield strength the largest von Mises stress is
//! reported, with a warning if few materials withstand the peak pressure.

use fem_case::engineering::{range, show};
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_laws::{FirstYield, LawFamily, largest_von_mises};
use fem_material::Material;

use crate::effects::decision::leading_estimate::LeadingEstimate;
use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::simplified_scene::{Transformation, TransformedScene};
use crate::effects::decision::support::Support;
use crate::effects::decision::{Effect, FiniteStrain, MaterialLoss, NamedEffect, PlasticFlow};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Peak pressure over the pair's contact modulus above which only brittle or rubber-like materials do not yield: 1/32 for
/// glass at 0.5 m/s, 1/13 for steel at 5 m/s.
const PRESSURE_LIMIT: f64 = 1.0 / 20.0;
/// Largest Young's modulus (Pa) of elastomers, gels and foams, which tear and do not yield (Ashby 2011, chart of
/// modulus and strength).
const MAX_MODULUS_OF_ELASTOMERS: f64 = 0.1e9;

/// Ratio of moduli below which a body of unknown strength is expected to yield before its partner.
const SOFTER: f64 = 0.5;

/// Contact radius over R* up to which the mean-pressure law is compared with elements, with some room.
const MAX_SIZE: f64 = 0.6;

impl Effect for PlasticFlow {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        Some(match earliest(scene, estimate) {
            Some((body, first)) => of_strength(scene, body, &first, estimate),
            None => without_strength(scene, estimate),
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
            let message = "plastic_flow is \"on\", and no material has a table flow";
            let help = "write [material.NAME.flow], or \"auto\" or \"off\"";
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
        let ignored = earliest(scene, estimate).filter(|(_, first)| is_off && first.ratio() > 1.0);
        ignored.map(|_| self.neglect_error(scene, estimate).unwrap_or_default().warning(Self::NAME))
    }

    /// A body that flows loses more than its material does, and is not strained as a hyperelastic one.
    fn silences(&self, _: &Scene, _: &Estimate) -> &'static [&'static str] {
        &[MaterialLoss::NAME, FiniteStrain::NAME]
    }

    /// The impact of the mean-pressure law within its error and that of the yield strength. The other losses of the run are
    /// added, between none of them and all. The loss of a contact law is the user's, and may be that of plastic flow.
    fn leading_estimate(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        restitution: f64,
    ) -> Option<LeadingEstimate> {
        let (body, first) = earliest(scene, estimate).filter(|(_, first)| first.ratio() > 1.0)?;
        if matches!(scene.model(), ModelChoice::Law { .. }) {
            return None;
        }
        let by = format!(
            "the mean-pressure law ({} yields from {} on)",
            body.name(),
            show(first.speed, "m/s")
        );
        let impacts = first.range(scene.strength_uncertainty(body));
        let [low, high] = impacts.map(|impact| impact.restitution);
        let size = impacts[1].max_contact_radius / estimate.hertz.pair().effective_radius();
        let low = (low.powi(2) - (1.0 - restitution.powi(2)).max(0.0)).max(0.0).sqrt();
        let all = LeadingEstimate::of_impacts(Self::NAME, by, "if it stayed elastic", impacts);
        // Wider contacts are beyond the law.
        let known = if size > MAX_SIZE { all.of_restitution_alone() } else { all };
        known.with_restitution(low, high.min(restitution)).if_it_leads(restitution)
    }

    /// The largest change within the error of the mean-pressure law.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let (_, first) = earliest(scene, estimate)?;
        Some(NeglectError::of_changes(estimate, first.change()))
    }

    /// The change of all quantities by the mean-pressure law, or the error of that law where it is the model. A flowing
    /// contact is wider and its pressure lower, so Hertz' powers do not give them.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let is_the_law = matches!(scene.model(), ModelChoice::Law { law, .. } if law.family == LawFamily::MeanPressure);
        match earliest(scene, estimate) {
            Some((_, first)) if status.is_lacking => {
                NeglectError::errors_of(estimate, first.change())
            }
            Some((_, first)) if is_the_law => {
                let impact = first.impact(0.0);
                let (errors, impact) = (first.errors(&impact), impact.in_order());
                let own = |quantity| Some(errors[quantity as usize] * impact[quantity as usize]);
                QuantityErrors::from_fn(own).checked()
            }
            _ => QuantityErrors::ZERO,
        }
    }
}

impl PlasticFlow {
    /// Checks that the case says where a ball that dents falls next.
    pub(crate) fn check(scene: &Scene) -> Result<(), Rejection> {
        let bounces = scene.gravity().filter(|gravity| scene.flows() && gravity.bounces > 1);
        match bounces.map(|gravity| gravity.spot) {
            None | Some(Some(_)) => Ok(()),
            Some(None) => {
                let message =
                    "the ball dents and bounces, and the case does not say where it falls next";
                let help = "write gravity.spot = \"fresh\" (undented surfaces: it loses energy as in the first contact), \
                            \"same\" (its own dent, on which it loses less), or stop.bounces = 1";
                Err(Rejection::new("gravity", message).with_help(help))
            }
        }
    }

    /// Returns the support of explicit elements: they compute flow if every body that yields has a flow rule.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Support {
        match scene.flows() && !scene.bodies().iter().any(|body| yields_elastic(body, estimate)) {
            true => Support::Computes { idle: "" },
            false => Support::Lacks,
        }
    }
}

/// Returns the body that yields first, of those with a yield strength.
fn earliest<'a>(scene: &'a Scene, estimate: &Estimate) -> Option<(&'a Body, FirstYield)> {
    let bodies = scene.bodies().each_ref().map(Body::yielding);
    let (index, first) = FirstYield::earliest(&estimate.hertz, bodies)?;
    Some((&scene.bodies()[index], first))
}

fn first_yield(body: &Body, estimate: &Estimate) -> Option<FirstYield> {
    Some(FirstYield::new(&estimate.hertz, body.yielding()?))
}

/// Returns whether a body yields that has no flow rule.
fn yields_elastic(body: &Body, estimate: &Estimate) -> bool {
    let yields = first_yield(body, estimate).is_some_and(|first| first.ratio() > 1.0);
    yields && body.material().is_none_or(|material| material.flow().is_none())
}

fn of_strength(scene: &Scene, body: &Body, first: &FirstYield, estimate: &Estimate) -> Relevance {
    let (ratio, name) = (first.ratio(), body.name());
    let is_needed = ratio > 1.0;
    let ends = first.range(scene.strength_uncertainty(body)).map(|impact| impact.restitution);
    let by_law = format!("closed forms give a restitution of {}", range(ends, ""));
    let unknown = scene.bodies().iter().find(|other| is_softer_without_strength(other, body));
    let warning = is_needed.then(|| {
        let computed = match (unknown, body.material().and_then(Material::flow)) {
            (Some(other), _) => format!(
                "for plastic flow give {}, which is softer, its material.NAME.yield_strength first",
                other.name()
            ),
            (None, Some(_)) => {
                let elastic = scene.bodies().iter().find(|other| yields_elastic(other, estimate));
                let too = elastic.map_or(String::new(), |other| {
                    format!("{} yields too: with its own [material.NAME.flow] ", other.name())
                });
                format!("{too}model fem computes plastic flow")
            }
            (None, None) => format!(
                "[material.NAME.flow]{} with model fem computes plastic flow",
                body.material().map_or(String::new(), in_place_of)
            ),
        };
        format!(
            "{name} yields from {} on, and the impact is at {}: {by_law}; {computed}",
            show(first.speed, "m/s"),
            show(estimate.hertz.approach_speed(), "m/s"),
        )
    });
    Relevance {
        is_needed,
        number: format!("peak pressure / pressure of first yield of {name} = {ratio:.2}"),
        if_not_needed: format!("it yields from {} on", show(first.speed, "m/s")),
        open_error: by_law,
        warning,
    }
}

/// Returns what a flow rule excludes and a material has, as words.
fn in_place_of(material: &Material) -> String {
    let excluded = [
        material.relaxation().map(|_| "its relaxation"),
        material.named_law().map(|_| "material.NAME.hyperelastic"),
    ];
    let excluded: Vec<&str> = excluded.into_iter().flatten().collect();
    match excluded.is_empty() {
        true => String::new(),
        false => format!(" in place of {}", excluded.join(" and ")),
    }
}

/// Returns whether a material can yield. Materials as soft as rubber and hyperelastic ones cannot.
fn may_yield(material: &Material) -> bool {
    material.named_law().is_none()
        && material.instantaneous().youngs_modulus() >= MAX_MODULUS_OF_ELASTOMERS
}

/// Returns whether a body can yield, is far softer than another and has no yield strength.
fn is_softer_without_strength(body: &Body, other: &Body) -> bool {
    let modulus = |body: &Body| body.material().map(|it| it.instantaneous().plane_strain_modulus());
    let are_known = modulus(body).zip(modulus(other));
    let is_softer = are_known.is_some_and(|(own, other)| own < SOFTER * other);
    is_softer && body.yielding().is_none() && body.material().is_some_and(may_yield)
}

fn without_strength(scene: &Scene, estimate: &Estimate) -> Relevance {
    let peak = estimate.effective.sizes.peak_pressure;
    let share = peak / estimate.hertz.pair().contact_modulus();
    let reached = |body: &Body| {
        let material = body.material().filter(|material| may_yield(material))?;
        // A stiff body beside a softer one is stressed little.
        let own = 0.5 * material.instantaneous().plane_strain_modulus();
        if share > PRESSURE_LIMIT && peak <= PRESSURE_LIMIT * own {
            return None;
        }
        let nu = body.material()?.instantaneous().poissons_ratio();
        Some(format!("{} {}", body.name(), show(largest_von_mises(nu) * peak, "Pa")))
    };
    let reached: Vec<String> = scene.bodies().iter().filter_map(reached).collect();
    let reached = reached.join(", ");
    let warning = (share > PRESSURE_LIMIT && !reached.is_empty()).then(|| {
        format!(
            "the peak pressure is {} of the contact modulus, which few materials withstand without plastic flow: the \
             stress reaches {reached}; set material.NAME.yield_strength for an estimate",
            if share < 0.5 { format!("1/{:.0}", 1.0 / share) } else { percent(share) }
        )
    });
    Relevance {
        is_needed: false,
        number: format!("peak pressure / contact modulus = {share:.3}"),
        if_not_needed: match reached.is_empty() {
            true => "bodies that are rubber-like, hyperelastic or far stiffer than their partner do not yield"
                .to_string(),
            false => {
                format!("the largest von Mises stress is {reached}; a material with a lower yield strength would flow")
            }
        },
        open_error: String::new(),
        warning,
    }
}
