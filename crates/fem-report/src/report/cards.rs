//! The quantities of interest of a collision with their error bars, as cards on the report page.

use fem::results::Parts;
use fem_case::engineering::{Unit, show};
use fem_collision::QuantityOfInterest;

use super::stored_result::StoredResult;
use crate::answer::{answer, error_scale, has_known_loss, measured_note, measured_restitutions};
use crate::number_text::{power_of_ten, rounded};

/// Relative errors below this are rounding.
const ROUNDING: f64 = 1e-9;

/// One quantity of interest.
pub struct Card {
    pub name: String,
    /// The number with its error, or the bound with its sign.
    pub value: String,
    pub unit: String,
    /// The parts of the error, and Hertz' value.
    pub notes: Vec<String>,
}

/// Returns a card for each quantity that the result has.
pub fn cards(result: &StoredResult) -> Vec<Card> {
    QuantityOfInterest::ALL.into_iter().filter_map(|quantity| card(result, quantity)).collect()
}

fn card(result: &StoredResult, quantity: QuantityOfInterest) -> Option<Card> {
    let key = quantity.key();
    let value = result.number(&[key])?;
    let hertz = result.number(&["hertz", key]);
    let parts = result.error_parts(quantity);
    let scale = error_scale(value, quantity);
    let unit = (!quantity.unit().is_empty()).then(|| Unit::fitting(value, quantity.unit()));
    let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let mut notes = Vec::new();
    let numerics = if result.has_elements() { "mesh" } else { "numerics" };
    notes.extend(error_text(&parts, numerics, ROUNDING * scale, &|size| rounded(scaled(size))));
    if let Some(hertz) = hertz.filter(|_| quantity != QuantityOfInterest::Restitution) {
        notes.push(format!("Hertz {} (× {:.4})", show(hertz, quantity.unit()), value / hertz));
    }
    if quantity == QuantityOfInterest::Restitution {
        if (1.0 - value).abs() < 0.1 && value != 1.0 && has_known_loss(value, &parts) {
            notes.push(format!("1 − e = {}", power_of_ten(1.0 - value)));
        }
        let measured = measured_restitutions(&result.summary);
        notes.extend(measured_note(&measured).filter(|_| parts.model.is_none()));
    }
    let text = answer(&result.summary, quantity)?;
    let symbol = unit.as_ref().map_or("", Unit::symbol);
    Some(Card {
        name: name(result, quantity),
        value: text.strip_suffix(symbol).unwrap_or(&text).trim_end().to_string(),
        unit: symbol.to_string(),
        notes,
    })
}

/// Returns the parts of an error that are larger than rounding, or unknown.
fn error_text(
    parts: &Parts,
    numerics: &str,
    least: f64,
    shown: &dyn Fn(f64) -> String,
) -> Option<String> {
    let part = |name: &str, size: Option<f64>| match size {
        Some(size) => (size > least).then(|| format!("{name} {}", shown(size))),
        None => Some(format!("{name} ?")),
    };
    let parts = [
        part(numerics, parts.discretisation),
        part("neglected effects", parts.model),
        parts.input.and_then(|size| part("inputs", Some(size))),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| format!("± {}", parts.join(" + ")))
}

/// Returns the name of a quantity; for radius and pressure it says whether they refer to the undeformed
/// (nominal) or the deformed (true) shape.
pub fn name(result: &StoredResult, quantity: QuantityOfInterest) -> String {
    let shape = match quantity {
        QuantityOfInterest::MaxContactRadius | QuantityOfInterest::PeakPressure
            if result.is_finite_strain() =>
        {
            ", true"
        }
        QuantityOfInterest::MaxContactRadius | QuantityOfInterest::PeakPressure => ", nominal",
        _ => "",
    };
    format!("{}{shape}", quantity.name())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem::results::Side;

    #[test]
    fn unknown_parts_of_an_error_are_named() {
        let of = |discretisation, model, bound| {
            let parts = Parts { discretisation, model, input: None, bound };
            error_text(&parts, "mesh", 1e-9, &rounded)
        };
        let text = |text: &str| Some(text.to_string());
        assert_eq!(of(Some(0.16), Some(0.5), None), text("± mesh 0.16 + neglected effects 0.5"));
        assert_eq!(of(Some(1e-12), Some(0.0), None), None);
        for side in [None, Some(Side::AtMost)] {
            assert_eq!(of(Some(1e-12), None, side), text("± neglected effects ?"));
            assert_eq!(of(Some(0.16), None, side), text("± mesh 0.16 + neglected effects ?"));
        }
        assert_eq!(of(None, Some(0.0), None), text("± mesh ?"));
        let parts =
            Parts { discretisation: Some(0.16), model: Some(0.5), input: Some(0.3), bound: None };
        let with_inputs = text("± mesh 0.16 + neglected effects 0.5 + inputs 0.3");
        assert_eq!(error_text(&parts, "mesh", 1e-9, &rounded), with_inputs);
    }
}
