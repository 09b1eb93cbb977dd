//! The impact of a scene in which a body flows plastically, by the mean-pressure law.
//!
//! Estimates, exports and error bars know such an impact from here: with the plate of the scene, hardening and rate of the body that
//! flows, and the error of the law.

use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_collision::QuantityOfInterest;
use fem_laws::{FirstYield, HertzImpact, ImpactQuantities, LawFamily, LawInput};
use fem_material::{FlowRule, RateFactor};

use crate::estimate::plate_impact::free_plate;
use crate::estimate::{Estimate, Regime};
use crate::models::Reduced;
use crate::quantity_errors::QuantityErrors;

/// An impact in which a body flows, by the mean-pressure law.
#[derive(Clone, Copy, Debug)]
pub struct FlowingImpact {
    /// Restitution, contact time, force, approach, radius and pressure.
    pub quantities: ImpactQuantities,
    /// Relative errors of the law beside finite elements, in the order of [`ImpactQuantities::in_order`].
    pub errors: [f64; 6],
    /// Rate of the plastic strain, 1/s; 0 without a flow rule.
    pub strain_rate: f64,
}

impl FlowingImpact {
    fn of(first: &FirstYield, strain_rate: f64) -> Self {
        let quantities = first.impact();
        Self { quantities, errors: first.errors(&quantities), strain_rate }
    }
}

/// Returns the body of a scene that flows first, with its rule; `None` if no body flows, or flow is switched off.
pub(crate) fn flowing_body<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
) -> Option<(&'a Body, &'a FlowRule)> {
    let (body, _, _) = first_flow(scene, hertz, None)?;
    Some((body, body.material()?.flow()?))
}

/// Returns the impact of a scene by the mean-pressure law, or that of elastic bodies if it is slower than first yield; `None` if no
/// body has a yield strength.
pub(crate) fn mean_pressure_impact(scene: &Scene, hertz: &HertzImpact) -> Option<FlowingImpact> {
    let (_, first, strain_rate) = first_yield_of(scene, hertz, |_| true, None)?;
    Some(FlowingImpact::of(&first, strain_rate))
}

/// Returns the impact of a scene with a flow rule by the mean-pressure law; `None` if no body flows. A rule that does not depend
/// on the rate takes the given factor.
pub fn flowing_impact(
    scene: &Scene,
    hertz: &HertzImpact,
    of_rate: Option<RateFactor>,
) -> Option<FlowingImpact> {
    let (_, first, strain_rate) = first_flow(scene, hertz, of_rate)?;
    Some(FlowingImpact::of(&first, strain_rate))
}

/// Returns the body with a flow rule that flows first, its first yield with hardening, and the rate of its plastic strain, 1/s.
fn first_flow<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
    of_rate: Option<RateFactor>,
) -> Option<(&'a Body, FirstYield, f64)> {
    if scene.effects().plastic_flow == Some(Switch::Off) {
        return None;
    }
    let has_rule = |body: &Body| body.material().is_some_and(|material| material.flow().is_some());
    let found = first_yield_of(scene, hertz, has_rule, of_rate)?;
    Some(found).filter(|(_, first, _)| first.ratio() > 1.0)
}

/// Returns the body that yields first, of those with a yield strength, and its first yield on the scene's plate, with the hardening
/// of its flow rule.
pub(crate) fn first_yield<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
) -> Option<(&'a Body, FirstYield)> {
    let (body, first, _) = first_yield_of(scene, hertz, |_| true, None)?;
    Some((body, first))
}

fn first_yield_of<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
    is_meant: impl Fn(&Body) -> bool,
    of_rate: Option<RateFactor>,
) -> Option<(&'a Body, FirstYield, f64)> {
    let bodies = scene.bodies().each_ref();
    let yielding = |body: &Body| body.yielding().filter(|_| is_meant(body));
    let (index, first) = FirstYield::earliest(hertz, bodies.map(yielding))?;
    let body = bodies[index];
    let first = on_plate(scene, first)?;
    let Some(rule) = body.material().and_then(|material| material.flow()) else {
        return Some((body, first, 0.0));
    };
    let of_rate = of_rate.filter(|_| rule.rate().is_none());
    let (first, strain_rate) = first.hardened(|strain, rate| {
        let factor = of_rate.map_or(1.0, |factor| factor.at(rate));
        rule.closed_form(strain, rate).times(factor)
    });
    Some((body, first, strain_rate))
}

/// Returns a first yield on the plate of a scene, if it has one; `None` if the impact leaves the range of f64.
pub(crate) fn on_plate(scene: &Scene, first: FirstYield) -> Option<FirstYield> {
    match free_plate(scene) {
        Some(plate) => first.with_plate(&plate).ok(),
        None => Some(first),
    }
}

/// Returns the error of the restitution by a law that dents with the given values at an approach speed, m/s; `None` for laws that do not
/// dent, and if the law cannot be made of the scene.
pub fn restitution_error(scene: &Scene, law: LawInput, speed: f64) -> Option<f64> {
    let end_rule = law.family.end_rule().unwrap_or_default();
    let model = ModelChoice::Law { law, end_rule, tolerance: fem_case::defaults::LAW_TOLERANCE };
    let scene = scene.touching_at(speed)?.with_model(model);
    let Regime { scene, estimate } = Regime::of(scene).ok()?;
    law_error(&scene, &estimate)?.size(QuantityOfInterest::Restitution)
}

/// Returns the errors of a scene's law that dents, where it has a yield strength: its difference from the mean-pressure law of the
/// same strength, which follows finite elements, and the error of that law. `None` for other models and laws.
pub(crate) fn law_error(scene: &Scene, estimate: &Estimate) -> Option<QuantityErrors> {
    let ModelChoice::Law { law, .. } = scene.model() else { return None };
    let is_it = law.family == LawFamily::MeanPressure;
    law.family.strength_parameter()?;
    let first = on_plate(scene, Reduced::flow_of(scene, estimate, law)?)?;
    let elements = first.impact();
    let (errors, values) = (first.errors(&elements), elements.in_order());
    let own = match is_it {
        true => values,
        false => {
            let impact = Reduced::new(scene).ok()?.impact(estimate.hertz.approach_speed()).ok()?;
            impact.quantities(impact.peak_pressure.unwrap_or(f64::NAN)).in_order()
        }
    };
    let error = |quantity: QuantityOfInterest| {
        let k = quantity as usize;
        Some((own[k] - values[k]).abs() + errors[k] * values[k])
    };
    Some(QuantityErrors::from_fn(error).checked())
}
