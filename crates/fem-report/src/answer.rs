//! The answer of a stored summary for a quantity, as text: the number with its error bar, or the bound with its sign.

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
    Status::of(summary[quantity.key()].as_f64(), &error_parts(summary, quantity))
}

/// Returns the scale of relative errors: 1 for the restitution, the value itself for all others.
pub fn error_scale(value: f64, quantity: QuantityOfInterest) -> f64 {
    if quantity == QuantityOfInterest::Restitution { 1.0 } else { value.abs() }
}

/// Returns the answer of a summary in one cell ([`answer_text`]), a measured restitution before a bound; `None` if there is none.
pub fn answer(summary: &Value, quantity: QuantityOfInterest) -> Option<String> {
    let value = summary[quantity.key()].as_f64()?;
    let parts = error_parts(summary, quantity);
    let text = answer_text(value, &parts, quantity);
    let measured = summary["measured_restitution"].as_array().into_iter().flatten();
    let measured = measured.filter_map(|it| it["restitution"].as_f64()).next();
    Some(behind_measured(text, &parts, quantity, measured))
}

/// Returns the text of a bound of the restitution behind the measured value of the library, if there is one: `0.32 (≤ 1.0000)`.
pub fn behind_measured(
    text: String,
    parts: &Parts,
    quantity: QuantityOfInterest,
    measured: Option<f64>,
) -> String {
    let is_bound = quantity == QuantityOfInterest::Restitution && parts.bound.is_some();
    match measured.filter(|_| is_bound) {
        Some(measured) => format!("{} ({text})", number(measured, 2)),
        None => text,
    }
}

/// Returns a number with its error bar, `62.46 ± 0.21 µs`, a bound with its sign, `≤ 0.9999`, or `0.993 ± ?` where an effect of
/// unknown size and side is missing.
pub fn answer_text(value: f64, parts: &Parts, quantity: QuantityOfInterest) -> String {
    let symbol = quantity.unit();
    let unit = (!symbol.is_empty()).then(|| Unit::fitting(value, symbol));
    let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let error = parts.sum().filter(|error| *error > VISIBLE * error_scale(value, quantity));
    let shown = with_error(scaled(value), error.map(scaled));
    let text = match (parts.bound, parts.sum()) {
        (Some(side), _) => format!("{} {shown}", side.sign()),
        (None, None) => format!("{shown} ± ?"),
        (None, Some(_)) => shown,
    };
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
}
