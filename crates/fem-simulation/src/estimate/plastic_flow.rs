//! Estimate of an impact in which a body flows plastically.

use fem_case::{Body, Scene, Switch};
use fem_laws::{FirstYield, HertzImpact, ImpactQuantities};
use fem_material::{FlowRule, RateFactor};

/// An impact in which a body flows, by the mean-pressure law.
#[derive(Clone, Copy, Debug)]
pub struct FlowingImpact {
    /// Restitution, contact time, force, approach, radius and pressure.
    pub quantities: ImpactQuantities,
    /// Relative errors of the law beside finite elements, in the order of [`ImpactQuantities::in_order`].
    pub errors: [f64; 6],
    /// Rate of the plastic strain, 1/s.
    pub strain_rate: f64,
}

/// Returns the body of a scene that flows first, with its rule; `None` if no body flows, or flow is switched off.
pub(crate) fn flowing_body<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
) -> Option<(&'a Body, &'a FlowRule)> {
    let (body, rule, _) = first_yield(scene, hertz)?;
    Some((body, rule))
}

/// Returns the impact of a scene with a flow rule by the mean-pressure law; `None` if no body flows. A rule that does not depend
/// on the rate takes the given factor.
pub fn flowing_impact(
    scene: &Scene,
    hertz: &HertzImpact,
    of_rate: Option<RateFactor>,
) -> Option<FlowingImpact> {
    let (_, rule, first) = first_yield(scene, hertz)?;
    let of_rate = of_rate.filter(|_| rule.rate().is_none());
    let (first, hardening, strain_rate) = first.hardened(|strain, rate| {
        of_rate.map_or(1.0, |factor| factor.at(rate)) * rule.flow_stress(strain, rate)
    });
    let quantities = first.impact(hardening);
    Some(FlowingImpact { quantities, errors: first.errors(&quantities), strain_rate })
}

/// Returns the body that flows first, its rule and its first yield.
fn first_yield<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
) -> Option<(&'a Body, &'a FlowRule, FirstYield)> {
    if scene.effects().plastic_flow == Some(Switch::Off) {
        return None;
    }
    let flowing = |body: &Body| body.material()?.flow().and_then(|_| body.yielding());
    let (index, first) = FirstYield::earliest(hertz, scene.bodies().each_ref().map(flowing))?;
    let body = &scene.bodies()[index];
    Some((body, body.material()?.flow()?, first)).filter(|_| first.ratio() > 1.0)
}
