//! The answer of a stored summary for a quantity, as text: the estimate that leads, or the number with its error bar.

use fem::results::Parts;
use fem_case::engineering::{Unit, range};
use fem_collision::QuantityOfInterest;
use serde_json::Value;

use crate::number_text::with_error;

/// Relative errors below this get no digits of the number.
pub const VISIBLE: f64 = 1e-6;

/// Returns the parts of a quantity's error; summaries of older versions lack some.
pub fn error_parts(summary: &Value, quantity: QuantityOfInterest) -> Parts {
    let parts = &summary["uncertainty"][quantity.key()];
    let part = |part: &str| parts[part].as_f64();
    Parts {
        discretisation: part("discretisation"),
        model: part("model"),
        model_at_least: part("model_at_least"),
        input: part("input"),
    }
}

/// Returns the ends of a quantity's estimate, SI; `None` if no estimate leads, or if it has no such quantity.
pub fn estimate_of(summary: &Value, quantity: QuantityOfInterest) -> Option<[f64; 2]> {
    let end = |end: &str| summary["estimate"][end][quantity.key()].as_f64();
    Some([end("low")?, end("high")?])
}

/// Returns the scale of relative errors: 1 for the restitution, the value itself for all others.
pub fn error_scale(value: f64, quantity: QuantityOfInterest) -> f64 {
    if quantity == QuantityOfInterest::Restitution { 1.0 } else { value.abs() }
}

/// Returns the answer in one cell: `62.46 ± 0.21 µs`, `0.993 ± >0.002`, `0.993 ± ?`, `≈ 0.16 to 0.31`, `?` where the error is as
/// large as the number; `None` if there is none. `>` stands before an error of which a part is unknown, `≈` before an estimate by closed forms.
pub fn answer(summary: &Value, quantity: QuantityOfInterest) -> Option<String> {
    let symbol = quantity.unit();
    if summary.get("estimate").is_some_and(|estimate| !estimate.is_null()) {
        return estimate_of(summary, quantity).map(|ends| format!("≈ {}", range(ends, symbol)));
    }
    let value = summary[quantity.key()].as_f64()?;
    let unit = (!symbol.is_empty()).then(|| Unit::fitting(value, symbol));
    let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let parts = error_parts(summary, quantity);
    if parts.cover(error_scale(value, quantity)) {
        return Some("?".to_string());
    }
    let visible = |error: &f64| *error > VISIBLE * error_scale(value, quantity);
    let shown = |error: Option<f64>| with_error(scaled(value), error.filter(visible).map(scaled));
    let text = match (parts.sum(), parts.known().filter(visible)) {
        (Some(error), _) => shown(Some(error)),
        (None, Some(known)) => shown(Some(known)).replace("± ", "± >"),
        (None, None) => format!("{} ± ?", shown(None)),
    };
    Some(unit.map_or(text.clone(), |unit| format!("{text} {}", unit.symbol())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_cell_says_what_is_known() {
        let of = |summary: Value| answer(&summary, QuantityOfInterest::ContactTime);
        let number = |parts: Value| json!({ "contact_time_s": 62.459e-6, "estimate": null, "uncertainty": { "contact_time_s": parts } });
        let text = |text: &str| Some(text.to_string());
        let whole = json!({ "discretisation": 1e-7, "model": 1e-7, "input": null });
        assert_eq!(of(number(whole)), text("62.46 ± 0.20 µs"));
        let open = json!({ "discretisation": 1e-7, "model": null, "model_at_least": 1e-7 });
        assert_eq!(of(number(open)), text("62.46 ± >0.20 µs"));
        let unknown = json!({ "discretisation": 1e-18, "model": null });
        assert_eq!(of(number(unknown)), text("62.46 ± ? µs"));
        let covered = json!({ "discretisation": 1e-7, "model": 7e-5 });
        assert_eq!(of(number(covered)), text("?"));
        let exact = json!({ "discretisation": 0.0, "model": 0.0 });
        assert_eq!(of(number(exact)), text("62.46 µs"));
        let estimate =
            json!({ "low": { "contact_time_s": 29e-6 }, "high": { "contact_time_s": 49e-6 } });
        assert_eq!(
            of(json!({ "contact_time_s": 2e-5, "estimate": estimate })),
            text("≈ 29 to 49 µs")
        );
        assert_eq!(of(json!({ "contact_time_s": null })), None);
    }
}
