//! Error bars of the summary: the discretisation error, and the model-form error by neglected effects.
//!
//! The discretisation error bounds the distance from the solution of the model's continuum problem; the model-form
//! error is the change of that solution by effects that the model lacks
//! ([`Effect::model_form_error`](crate::effects::Effect::model_form_error)), and the spread of the hyperelastic laws if
//! the case names none. Closed forms estimate it within a factor of three. The parameters of contact laws are the user's.

use fem_collision::Collision;

use super::input_uncertainty::input_uncertainty;
use super::summary::{EffectSummary, Parts, Quantities, UncertaintySummary};
use crate::effects::{EffectStatus, effect_named};
use crate::error::ErrorEstimate;
use crate::quantity_errors::QuantityErrors;
use crate::simulation::Simulation;

/// Returns discretisation and model-form errors of the quantities that have a number, SI.
pub(super) fn uncertainty(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
    numbers: &Quantities,
    effects: &[EffectSummary],
) -> UncertaintySummary {
    let inputs = input_uncertainty(simulation, collision, numbers);
    let all = model_form_errors(simulation, collision, effects);
    let sum = |errors: &mut dyn Iterator<Item = QuantityErrors>| {
        errors.fold(QuantityErrors::ZERO, QuantityErrors::plus)
    };
    let model = sum(&mut all.iter().copied());
    let known = sum(&mut all.iter().copied().map(QuantityErrors::unknown_as_zero));
    UncertaintySummary::by(|quantity| {
        let of = |error: &QuantityErrors| numbers.number(quantity).and(error.size(quantity));
        let model = of(&model);
        let known = of(&known).filter(|known| model.is_none() && *known > 0.0);
        let input = inputs.as_ref().and_then(of);
        Parts { discretisation: of(&errors.bars), model, model_at_least: known, input }
    })
}

/// Returns the change by each neglected effect.
fn model_form_errors(
    simulation: &Simulation,
    collision: &Collision,
    effects: &[EffectSummary],
) -> Vec<QuantityErrors> {
    let Some(estimate) = simulation.estimate(collision) else {
        return vec![QuantityErrors::default()];
    };
    let estimate = estimate.with_computed(collision);
    let scene = simulation.scene_of_model();
    let error = |EffectSummary { decision, error_if_left_out }: &EffectSummary| {
        let status =
            EffectStatus { is_lacking: decision.is_lacking, neglect_error: *error_if_left_out };
        Some(effect_named(decision.name)?.model_form_error(&scene, &estimate, &status))
    };
    effects.iter().filter_map(error).collect()
}
