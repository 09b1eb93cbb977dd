//! Estimate of an impact in which a body flows plastically.

use fem_case::{Body, Scene, Switch};
use fem_laws::{FirstYield, HertzImpact, ImpactQuantities, elastic_plastic_impact};
use fem_material::{FlowRule, RateFactor};

/// Representative plastic strain of a contact over a/R* (Tabor 1951, *The Hardness of Metals*).
const REPRESENTATIVE_STRAIN: f64 = 0.2;
/// Passes that find the flow stress at the strain and the rate of the contact.
const N_PASSES: usize = 3;

/// An impact in which a body flows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlowingImpact {
    pub quantities: ImpactQuantities,
    /// Rate of the plastic strain, 1/s.
    pub strain_rate: f64,
}

/// Returns the body of a scene that flows first, with its rule; `None` if no body flows, or flow is switched off.
pub(crate) fn flowing_body<'a>(
    scene: &'a Scene,
    hertz: &HertzImpact,
) -> Option<(&'a Body, &'a FlowRule)> {
    if scene.effects().plastic_flow == Some(Switch::Off) {
        return None;
    }
    let rules = scene.bodies().iter().filter_map(|body| {
        let material = body.material()?;
        let (rule, nu) = (material.flow()?, material.instantaneous().poissons_ratio());
        Some((FirstYield::new(hertz, rule.yield_strength(), nu), body, rule))
    });
    let weakest = rules.min_by(|(a, ..), (b, ..)| a.pressure.total_cmp(&b.pressure));
    weakest.filter(|(first, ..)| first.ratio() > 1.0).map(|(_, body, rule)| (body, rule))
}

/// Returns the impact of a scene with a flow rule by closed forms; `None` if no body flows. A rule that does not depend on
/// the rate takes the given factor.
///
/// The flow stress is that at Tabor's representative strain, reached in half of the contact time.
pub(crate) fn flowing_impact(
    scene: &Scene,
    hertz: &HertzImpact,
    of_rate: Option<RateFactor>,
) -> Option<FlowingImpact> {
    let (_, rule) = flowing_body(scene, hertz)?;
    let of_rate = of_rate.filter(|_| rule.rate().is_none());
    let radius = hertz.pair().effective_radius();
    let mut quantities = elastic_plastic_impact(hertz, rule.yield_strength());
    let mut strain_rate = 0.0;
    for _ in 0..N_PASSES {
        let strain = REPRESENTATIVE_STRAIN * quantities.max_contact_radius / radius;
        strain_rate = 2.0 * strain / quantities.contact_time;
        let factor = of_rate.map_or(1.0, |factor| factor.at(strain_rate));
        quantities = elastic_plastic_impact(hertz, factor * rule.flow_stress(strain, strain_rate));
    }
    Some(FlowingImpact { quantities, strain_rate })
}
