//! Growth of the flow stress with the strain rate, for flow rules that do not have it.
//!
//! A tensile test strains a metal at about 1e-3 per second, an impact at 1e3 to 1e5. A flow rule without `rate` is judged by the
//! factor of a steel; `rate = { johnson_cook = { c = 0, … } }` says that a material does not depend on the rate.

use fem_case::Scene;
use fem_case::engineering::number;
use fem_material::RateFactor;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::support::Support;
use crate::effects::decision::{Effect, RateDependence};
use crate::estimate::Estimate;
use crate::estimate::plastic_flow::{flowing_body, flowing_impact};
use crate::quantity_errors::QuantityErrors;

/// The factor of 4340 steel (Johnson & Cook 1983, Proceedings of the 7th International Symposium on Ballistics, 541).
const STEEL: RateFactor = RateFactor { coefficient: 0.014, reference_rate: 1.0 };

impl Effect for RateDependence {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let (body, rule) = flowing_body(scene, &estimate.hertz)?;
        let rate = flowing_impact(scene, &estimate.hertz, None)?.strain_rate;
        let rate_text = format!("strain rate about {} 1/s", number(rate, 1));
        if let Some(own) = rule.rate() {
            let higher = number(100.0 * (own.at(rate) - 1.0), 2);
            return Some(Relevance {
                is_needed: own.coefficient > 0.0,
                number: format!("{rate_text}, where the flow stress is {higher} % higher"),
                ..Relevance::default()
            });
        }
        let change = changes(scene, estimate)[0];
        let by = format!(
            "that of a steel is {} % higher there, which changes the restitution by {}",
            number(100.0 * (STEEL.at(rate) - 1.0), 1),
            number(change, 1)
        );
        let is_needed = change.abs() > scene.accuracy().restitution;
        Some(Relevance {
            is_needed,
            number: format!("{rate_text}; the flow stress does not depend on it"),
            if_not_needed: by.clone(),
            open_error: by.clone(),
            warning: is_needed.then(|| {
                format!(
                    "no rate dependence of {} is given, and a typical steel is {} % stronger at {} 1/s (e {change:+.2}): set {}",
                    body.name(),
                    number(100.0 * (STEEL.at(rate) - 1.0), 1),
                    number(rate, 1),
                    body.material_key("flow.rate")
                )
            }),
        })
    }

    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        Some(NeglectError::of_changes(estimate, changes(scene, estimate)))
    }

    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        if !status.is_lacking {
            return QuantityErrors::ZERO;
        }
        // The change is a share of the pressure of the flowing contact, a fraction of the elastic one.
        let mut flowing = estimate.clone();
        if let Some(flow) = estimate.flow {
            flowing.effective.sizes.peak_pressure = flow.peak_pressure;
        }
        NeglectError::errors_of(&flowing, changes(scene, estimate))
    }
}

impl RateDependence {
    /// Returns the support of explicit elements, which compute what the flow rules have; `None` if no body flows.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Option<Support> {
        let (_, rule) = flowing_body(scene, &estimate.hertz)?;
        Some(match rule.rate() {
            Some(_) => Support::Inherent { idle: "" },
            None => Support::Lacks,
        })
    }
}

/// Returns the change of the quantities by a steel's dependence on the rate, relative, that of the restitution absolute.
fn changes(scene: &Scene, estimate: &Estimate) -> [f64; 6] {
    match estimate.flow.zip(flowing_impact(scene, &estimate.hertz, Some(STEEL))) {
        Some((without, with)) => with.quantities.change_from(&without),
        None => [0.0; 6],
    }
}
