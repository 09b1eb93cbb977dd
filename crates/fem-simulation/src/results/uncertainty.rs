//! Error bars of the summary: the discretisation error, and the model-form error by neglected effects.
//!
//! The discretisation error bounds the distance from the solution of the model's continuum problem; the model-form
//! error is the change of that solution by effects that the model lacks
//! ([`Effect::model_form_error`](crate::effects::Effect::model_form_error)), and the spread of the hyperelastic laws if
//! the case names none. Closed forms estimate it within a factor of three. The parameters of contact laws are the user's.

use fem_collision::Collision;

use super::input_uncertainty::InputUncertainty;
use super::summary::{EffectSummary, Parts, PerQuantity, Quantities, Side};
use crate::effects::{Effect, EffectStatus, effect_named};
use crate::error::ErrorEstimate;
use crate::quantity_errors::QuantityErrors;
use crate::simulation::Simulation;

/// Relative errors up to this are those of floating-point numbers.
const ROUNDING: f64 = 1e-13;

/// Returns discretisation and model-form errors of the quantities that have a number, SI.
pub(super) fn uncertainty(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
    numbers: &Quantities,
    effects: &[EffectSummary],
    inputs: Option<&InputUncertainty>,
) -> PerQuantity<Parts> {
    let all = model_form_errors(simulation, collision, effects);
    let model = all.iter().fold(QuantityErrors::ZERO, |sum, (_, error)| sum.plus(*error));
    PerQuantity::by(|quantity| {
        let of = |error: &QuantityErrors| {
            let (number, size) = (numbers.number(quantity)?, error.size(quantity)?);
            // Less is rounding.
            Some(if size > ROUNDING * quantity.scale(number) { size } else { 0.0 })
        };
        let mut unknown = all.iter().filter(|(_, error)| error.size(quantity).is_none());
        let has_side = model.size(quantity).is_none()
            && numbers.number(quantity).is_some()
            && unknown.all(|(effect, _)| effect.is_dissipative());
        let bound = has_side.then(|| Side::without_dissipation(quantity)).flatten();
        let (discretisation, input) =
            (of(&errors.bars), inputs.and_then(|inputs| of(&inputs.axial)));
        Parts { discretisation, model: of(&model), input, bound }
    })
}

/// Returns the change by each neglected effect.
fn model_form_errors(
    simulation: &Simulation,
    collision: &Collision,
    effects: &[EffectSummary],
) -> Vec<(&'static dyn Effect, QuantityErrors)> {
    let all = || effects.iter().filter_map(|it| Some((effect_named(it.decision.name)?, it)));
    let Some(estimate) = simulation.estimate(&collision.approach) else {
        return all().map(|(effect, _)| (effect, QuantityErrors::default())).collect();
    };
    let estimate = estimate.with_computed(collision);
    let scene = simulation.scene_of_model();
    let error = |(effect, summary): (&'static dyn Effect, &EffectSummary)| {
        let EffectSummary { decision, error_if_left_out } = summary;
        let status =
            EffectStatus { is_lacking: decision.is_lacking, neglect_error: *error_if_left_out };
        (effect, effect.model_form_error(&scene, &estimate, &status))
    };
    all().map(error).collect()
}
