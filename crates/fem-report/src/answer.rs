//! The answer of a result for a quantity, as text: the number with its error bar, or the bound with its sign behind the measured
//! value.

use fem::results::{Parts, Status};
use fem_case::engineering::{Unit, number};
use fem_collision::QuantityOfInterest;
use serde_json::Value;

use crate::number_text::with_error;

/// Relative errors below this get no digits of the number.
pub const VISIBLE: f64 = 1e-6;

/// Returns the parts of a quantity's error; summaries of older versions lack some.
pub fn error_parts(summary: &Value, quantity: QuantityOfInterest) -> Parts {
    let parts = &summary["uncertainty"][quantity.key()];
    serde_json::from_value(parts.clone()).unwrap_or_default()
}

/// Returns the status of a quantity.
pub fn status(summary: &Value, quantity: QuantityOfInterest) -> Status {
    Status::of(summary[quantity.key()].as_f64(), error_parts(summary, quantity).model)
}

/// Returns the scale of relative errors: 1 for the restitution, the value itself for all others.
pub fn error_scale(value: f64, quantity: QuantityOfInterest) -> f64 {
    if quantity == QuantityOfInterest::Restitution { 1.0 } else { value.abs() }
}

/// Returns the measured restitutions of the library at the speed of a summary, with their names.
pub fn measured_restitutions(summary: &Value) -> Vec<(&str, f64)> {
    let all = summary["measured_restitution"].as_array().into_iter().flatten();
    all.filter_map(|it| Some((it["name"].as_str()?, it["restitution"].as_f64()?))).collect()
}

/// Returns where the restitution before a bound comes from: `measured (bridges-1984)`.
pub fn measured_note(all: &[(&str, f64)]) -> Option<String> {
    all.first().map(|(name, _)| format!("measured ({name})"))
}

/// Returns the answer of a summary in one cell ([`answer_text`]); `None` if there is none.
pub fn answer(summary: &Value, quantity: QuantityOfInterest) -> Option<String> {
    let value = summary[quantity.key()].as_f64()?;
    let measured = measured_restitutions(summary).first().map(|it| it.1);
    Some(answer_text(value, &error_parts(summary, quantity), quantity, measured))
}

/// Returns the restitution of one contact of a bouncing ball.
pub fn bounce_answer(
    restitution: Option<f64>,
    parts: &Parts,
    measured: Option<f64>,
) -> Option<String> {
    let quantity = QuantityOfInterest::Restitution;
    restitution.map(|value| answer_text(value, parts, quantity, measured))
}

/// Returns the energy of relative motion, ½ m* v² of the effective mass and the approach speed, J: what a collision can lose, in any
/// frame. Bodies are given by mass, `None` of an infinite one, and velocity; without a relative motion there is none.
pub fn relative_motion_energy(bodies: [(Option<f64>, f64); 2]) -> Option<f64> {
    let mobility: f64 = bodies.iter().filter_map(|(mass, _)| mass.map(f64::recip)).sum();
    let speed = bodies[0].1 - bodies[1].1;
    Some(0.5 * speed * speed / mobility).filter(|energy| *energy > 0.0 && energy.is_finite())
}

/// Returns whether 1 − e is known: neglected effects change it by no more than its own size or the discretisation error. That of a bound
/// is not.
pub fn has_known_loss(restitution: f64, parts: &Parts) -> bool {
    let known = (1.0 - restitution).abs().max(parts.discretisation.unwrap_or(0.0));
    parts.model.is_some_and(|neglected| neglected <= known)
}

/// Returns the mark of a number, which is its status: `≤ 0.9999` of a bound, or `0.993 ± ?` where an error is not known. A bound of
/// the restitution stands behind the measured one: `0.32 (≤ 1.0000)`.
pub fn marked(
    shown: &str,
    parts: &Parts,
    quantity: QuantityOfInterest,
    measured: Option<f64>,
) -> String {
    let own = match (parts.bound, parts.sum()) {
        (Some(side), _) => format!("{} {shown}", side.sign()),
        (None, None) => format!("{shown} ± ?"),
        (None, Some(_)) => shown.to_string(),
    };
    let leads = quantity == QuantityOfInterest::Restitution && parts.model.is_none();
    match measured.filter(|_| leads) {
        Some(measured) => format!("{} ({own})", number(measured, 2)),
        None => own,
    }
}

/// Returns a number with its error bar, `62.46 ± 0.21 µs`, or with its mark ([`marked`]).
pub fn answer_text(
    value: f64,
    parts: &Parts,
    quantity: QuantityOfInterest,
    measured: Option<f64>,
) -> String {
    let symbol = quantity.unit();
    let unit = (!symbol.is_empty()).then(|| Unit::fitting(value, symbol));
    let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let error = parts.sum().filter(|error| *error > VISIBLE * error_scale(value, quantity));
    let number = with_error(scaled(value), error.map(scaled));
    let text = marked(&number, parts, quantity, measured);
    unit.map_or(text.clone(), |unit| format!("{text} {}", unit.symbol()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_cell_says_what_is_known() {
        let of = |summary: Value| answer(&summary, QuantityOfInterest::ContactTime);
        let number = |parts: Value| json!({ "contact_time_s": 62.459e-6, "uncertainty": { "contact_time_s": parts } });
        let text = |text: &str| Some(text.to_string());
        let whole = json!({ "discretisation": 1e-7, "model": 1e-7, "input": null });
        assert_eq!(of(number(whole)), text("62.46 ± 0.20 µs"));
        let open = json!({ "discretisation": 1e-7, "model": null, "bound": "at least" });
        assert_eq!(of(number(open)), text("≥ 62.46 µs"));
        let unknown = json!({ "discretisation": 1e-18, "model": null });
        assert_eq!(of(number(unknown)), text("62.46 ± ? µs"));
        let wide = json!({ "discretisation": 1e-7, "model": 7e-5 });
        assert_eq!(of(number(wide)), text("62 ± 70 µs"));
        let exact = json!({ "discretisation": 0.0, "model": 0.0 });
        assert_eq!(of(number(exact)), text("62.46 µs"));
        assert_eq!(of(json!({ "contact_time_s": null })), None);
    }

    /// A body that meets an equal one at rest has half of its energy to lose; beside a wall of any speed it has all.
    #[test]
    fn only_relative_motion_can_be_lost() {
        let of = |mass, velocities: [f64; 2]| {
            relative_motion_energy([(mass, velocities[0]), (Some(2.0), velocities[1])])
        };
        assert_eq!(of(Some(2.0), [3.0, 0.0]), Some(4.5));
        for velocities in [[3.0, 0.0], [0.0, -3.0], [10.0, 7.0]] {
            assert_eq!(of(None, velocities), Some(9.0));
        }
        assert_eq!(of(None, [1.0, 1.0]), None);
    }

    /// The first measurement leads, but not where the number is computed.
    #[test]
    fn a_measured_restitution_stands_before_a_bound() {
        let of = |model: Value, bound: Value| {
            let parts = json!({ "discretisation": 1e-3, "model": model, "bound": bound });
            let measured = json!([{ "name": "no-speed", "restitution": null },
                { "name": "a", "restitution": 0.3213 }, { "name": "b", "restitution": 0.45 }]);
            let summary = json!({ "restitution": 0.99, "uncertainty": { "restitution": parts },
                "measured_restitution": measured });
            let note = measured_note(&measured_restitutions(&summary)).unwrap();
            assert_eq!(note, "measured (a)");
            answer(&summary, QuantityOfInterest::Restitution).unwrap()
        };
        assert_eq!(of(Value::Null, "at most".into()), "0.32 (≤ 0.9900)");
        assert_eq!(of(Value::Null, Value::Null), "0.32 (0.9900 ± ?)");
        assert_eq!(of(1e-3.into(), Value::Null), "0.9900 ± 0.0020");
        assert_eq!(measured_note(&[]), None);
    }
}
