//! Uncertainty of the results by the uncertain inputs of a case, `"70 ± 2 GPa"`.
//!
//! Each input x with the uncertainty u changes a result y by half of y(x + u) − y(x − u) ([`Case::change_by`]), and the changes
//! of independent inputs are added as squares (JCGM 100:2008, *Guide to the expression of uncertainty in measurement*, 5.1.2),
//!
//! ```math
//! u_y^2 = \sum_k \left[\tfrac12 y(x_k+u_k) - \tfrac12 y(x_k-u_k)\right]^2 .
//! ```
//!
//! The loss within the measured band of a relaxation, and what may lie outside, are two more inputs (`relaxation_band`).
//!
//! A material of both bodies is one input. The changes are those of the case's contact law, or of Hertz' or Ting's impact
//! between half-spaces, or of the elastic–plastic impact of a body that flows, relative to it; that of the restitution is
//! absolute. Waves that take energy from these impacts take it
//! by the closed forms of [`PartnerWaves`].

use fem_case::{Body, Case, ModelChoice, Scene, Switch};
use fem_collision::Collision;
use fem_laws::{HertzImpact, Impact, ImpactQuantities};

use super::relaxation_band::variants;
use super::summary::Quantities;
use super::tangential::PatchChange;
use crate::effects::{PartnerWaves, SimplifiedScene};
use crate::estimate::quasi_static::ting_of;
use crate::estimate::{Estimate, Regime};
use crate::models::Reduced;
use crate::quantity_errors::QuantityErrors;
use crate::simulation::Simulation;

/// Number of changes by an input: of the six quantities, and of what a rebound depends on.
const N_CHANGES: usize = 10;
/// Relative accuracy of the impacts, whose differences count.
const TOLERANCE: f64 = 1e-6;

/// What the uncertain inputs of a case change.
pub(super) struct InputUncertainty {
    /// Uncertainties of the numbers of a collision.
    pub axial: QuantityErrors,
    /// Changes of the rebound of an oblique impact, one per input.
    pub across: Vec<PatchChange>,
}

/// Returns what the uncertain inputs change; `None` if the case has none.
pub(super) fn input_uncertainty(
    simulation: &Simulation,
    collision: &Collision,
    numbers: &Quantities,
) -> Option<InputUncertainty> {
    let file = simulation.case().file().clone();
    let case = Case::of(simulation.with_approach(file, &collision.approach)).ok()?;
    let inputs = case.scene().uncertain_inputs();
    let bodies = case.scene().bodies();
    let has_band = |body: &Body| body.measured().is_some_and(|it| it.frequencies.is_some());
    if inputs.is_empty() && !bodies.iter().any(has_band) {
        return None;
    }
    let estimate = &simulation.setup().estimate;
    let own = impact_of(case.scene(), estimate)?;
    let from_own = |other: &Case| {
        let axial = impact_of(other.scene(), estimate)?.change_from(&own);
        Some([&axial[..], &PatchChange::between(case.scene(), other.scene()).0].concat())
    };
    // Unknown changes are no numbers.
    let unknown = || vec![f64::NAN; N_CHANGES];
    let change = |input| case.change_by(input, from_own).unwrap_or_else(unknown);
    let mut changes: Vec<Vec<f64>> = inputs.iter().map(change).collect();
    let is_one = bodies[0].material() == bodies[1].material();
    for side in 0..if is_one { 1 } else { 2 } {
        for (other, share) in variants(&case, side, own.contact_time) {
            let change = from_own(&other).unwrap_or_else(unknown);
            changes.push(change.into_iter().map(|change| share * change).collect());
        }
    }
    if changes.is_empty() {
        return None;
    }
    let sum = |k: usize| changes.iter().map(|change| change[k].powi(2)).sum::<f64>().sqrt();
    let errors = QuantityErrors::from_fn(|quantity| {
        Some(sum(quantity as usize) * quantity.scale(numbers.number(quantity)?))
    });
    let across = changes.iter().filter_map(|change| change[6..].try_into().ok()).map(PatchChange);
    Some(InputUncertainty { axial: errors.checked(), across: across.collect() })
}

/// Returns the closed-form impact of a variant of an estimated scene.
fn impact_of(scene: &Scene, estimate: &Estimate) -> Option<ImpactQuantities> {
    let speed = scene.approach_speed();
    if matches!(scene.model(), ModelChoice::Law { .. }) {
        return Some(quantities(&Reduced::new(scene).ok()?.impact(speed).ok()?));
    }
    // The speed may be what differs.
    let estimate = estimate.of_variant(scene, speed).ok()?;
    let Regime { scene, estimate } = SimplifiedScene::quiet(scene.clone(), &estimate)?;
    let pair = scene.pair().ok()?;
    let kept = share_beside_waves(&scene, &estimate);
    let mut materials = scene.bodies().iter().filter_map(Body::material);
    let has_plate = scene.bodies().iter().any(|body| body.plate().is_some());
    let impact = if let Some(flow) = estimate.flow {
        flow
    } else if !has_plate && materials.all(|material| material.relaxation().is_none()) {
        ImpactQuantities::from(&HertzImpact::new(&pair, speed).ok()?)
    } else {
        let ting = ting_of(&scene, &pair, true, None).ok()?.with_coarse_waves();
        quantities(&*estimate.impacts.impact(ting.with_tolerance(TOLERANCE).ok()?, speed).ok()?)
    };
    Some(ImpactQuantities { restitution: kept * impact.restitution, ..impact })
}

/// Returns the share of the restitution that waves leave which do not return.
fn share_beside_waves(scene: &Scene, estimate: &Estimate) -> f64 {
    match scene.effects().partner_waves {
        Some(Switch::Off) => 1.0,
        _ => (1.0 - PartnerWaves::loss(scene, estimate)).max(0.0),
    }
}

fn quantities(impact: &Impact) -> ImpactQuantities {
    ImpactQuantities {
        restitution: impact.restitution,
        contact_time: impact.contact_time.unwrap_or(f64::NAN),
        peak_force: impact.peak_force,
        max_approach: impact.max_approach,
        max_contact_radius: impact.max_contact_radius,
        peak_pressure: impact.peak_pressure.unwrap_or(f64::NAN),
    }
}
