//! Estimate of an impact in which a body flows plastically.

use fem_case::{Body, Scene, Switch};
use fem_laws::{FirstYield, HertzImpact, ImpactQuantities, elastic_plastic_impact};

/// Representative plastic strain of a contact over a/R* (Tabor 1951, *The Hardness of Metals*).
const REPRESENTATIVE_STRAIN: f64 = 0.2;
/// Passes that find the flow stress at the strain and the rate of the contact.
const N_PASSES: usize = 3;

/// Returns the impact of a scene with a flow rule by closed forms; `None` if no body flows, or flow is switched off.
///
/// The flow stress is that at Tabor's representative strain, reached in half of the contact time.
pub(super) fn flowing_impact(scene: &Scene, hertz: &HertzImpact) -> Option<ImpactQuantities> {
    if scene.effects().plastic_flow == Some(Switch::Off) {
        return None;
    }
    let materials = scene.bodies().iter().filter_map(Body::material);
    let rules = materials.filter_map(|material| {
        let (rule, nu) = (material.flow()?, material.instantaneous().poissons_ratio());
        Some((FirstYield::new(hertz, rule.yield_strength(), nu), rule))
    });
    let weakest = rules.min_by(|(a, _), (b, _)| a.pressure.total_cmp(&b.pressure));
    let (_, rule) = weakest.filter(|(first, _)| first.ratio() > 1.0)?;
    let radius = hertz.pair().effective_radius();
    let mut impact = elastic_plastic_impact(hertz, rule.yield_strength());
    for _ in 0..N_PASSES {
        let strain = REPRESENTATIVE_STRAIN * impact.max_contact_radius / radius;
        let stress = rule.flow_stress(strain, 2.0 * strain / impact.contact_time);
        impact = elastic_plastic_impact(hertz, stress);
    }
    Some(impact)
}
