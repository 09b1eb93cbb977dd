//! Loss of the material itself, for bodies whose relaxation is not known. The restitution of a collision without it is an upper
//! bound, unless the case says that the material is meant to be elastic. The other quantities depend on the moduli.

use fem_case::engineering::{Unit, number};
use fem_case::{Body, Scene};
use fem_collision::QuantityOfInterest;
use fem_laws::ImpactQuantities;

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::{AdhesionEffect, Effect, MaterialLoss, PlasticFlow};
use crate::estimate::Estimate;
use crate::estimate::plastic_flow::flowing_impact;
use crate::quantity_errors::QuantityErrors;

impl Effect for MaterialLoss {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let bodies = Self::unknown(scene, estimate);
        let first = bodies.first()?;
        let names: Vec<&str> = bodies.iter().map(|body| body.name()).collect();
        let names = names.join(" and ");
        let measured = measured_words(scene);
        Some(Relevance {
            is_needed: true,
            number: format!("no relaxation is given for {names}"),
            if_not_needed: String::new(),
            open_error: format!("the restitution is an upper bound{measured}"),
            warning: Some(format!(
                "the damping of {names} is unknown and not included{measured}: give {}, or {} = true",
                first.material_key("relaxation"),
                first.material_key("elastic")
            )),
        })
    }

    /// The restitution is a bound, unless the bodies stick.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let sticks = AdhesionEffect::surely_sticks(scene, estimate.hertz.approach_speed());
        let is_bound = status.is_lacking && !sticks && Self::is_lacking(scene, estimate);
        QuantityErrors::from_fn(|quantity| {
            (!is_bound || quantity != QuantityOfInterest::Restitution).then_some(0.0)
        })
    }

    fn is_dissipative(&self) -> bool {
        true
    }
}

/// Returns the measured restitutions of the library at the approach speed, ` (measured: 0.32 by bridges-1984)`, or the speeds of its
/// first measurement; empty if there is none.
fn measured_words(scene: &Scene) -> String {
    let all = scene.measured_restitutions();
    let at_speed = all.iter().filter_map(|it| Some((it, it.at(scene.approach_speed())?)));
    let at_speed: Vec<String> =
        at_speed.map(|(it, value)| format!("{} by {}", number(value, 2), it.name)).collect();
    match all.first() {
        Some(first) if at_speed.is_empty() => {
            let (slowest, fastest) = first.speeds();
            let [slowest, fastest] = [slowest, fastest]
                .map(|speed| Unit::fitting(speed, "m/s").with_digits(3).show(speed));
            let range =
                if slowest == fastest { slowest } else { format!("{slowest} to {fastest}") };
            format!(" (measured at {range} by {})", first.name)
        }
        Some(_) => format!(" (measured: {})", at_speed.join(", ")),
        None => String::new(),
    }
}

/// Loss of restitution by flow above which that of the material is small beside it: metals lose about 1e-3 of the energy of a
/// vibration (Ashby 2011, chart of loss coefficient and modulus).
const LOSS_OF_FLOW: f64 = 0.02;

impl MaterialLoss {
    /// Returns the bodies whose loss is not known, each material once.
    fn unknown<'a>(scene: &'a Scene, estimate: &Estimate) -> Vec<&'a Body> {
        // The estimate for a model that is elastic has no flow.
        let flow = || Some(flowing_impact(scene, &estimate.hertz, None)?.quantities);
        let loses = |flow: ImpactQuantities| 1.0 - flow.restitution > LOSS_OF_FLOW;
        let flows =
            PlasticFlow::is_on(scene, estimate) && estimate.flow.or_else(flow).is_some_and(loses);
        let mut bodies: Vec<&Body> = scene.bodies_of_unknown_loss(flows).collect();
        bodies.dedup_by_key(|body| body.material_key(""));
        bodies
    }

    /// Returns whether a collision of a scene lacks the loss of a material.
    pub(crate) fn is_lacking(scene: &Scene, estimate: &Estimate) -> bool {
        !Self::unknown(scene, estimate).is_empty()
    }
}
