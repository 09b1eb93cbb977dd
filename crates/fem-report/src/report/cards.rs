//! The numbers that a collision is known by, with what they may be off by.

use fem::results::Parts;
use fem_case::engineering::{Unit, show};
use fem_collision::Headline;

use super::record::Record;

/// One number.
pub struct Card {
    pub name: String,
    /// With its error, if all of it is known.
    pub value: String,
    pub unit: String,
    /// What of the error is of what, and what Hertz says.
    pub notes: Vec<String>,
}

/// All that a result has.
pub fn cards(record: &Record) -> Vec<Card> {
    Headline::ALL.into_iter().filter_map(|headline| card(record, headline)).collect()
}

fn card(record: &Record, headline: Headline) -> Option<Card> {
    let key = headline.key();
    let value = record.number(&[key])?;
    let hertz = record.number(&["hertz", key]);
    let parts = record.parts(headline);
    let whole = whole(value, headline);
    let error = parts.sum();
    let unit = (!headline.unit().is_empty()).then(|| Unit::fitting(value, headline.unit()));
    let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
    let mut notes = Vec::new();
    let numerics = if record.has_elements() { "mesh" } else { "numerics" };
    notes.extend(of_what(&parts, numerics, EXACT * whole, &|size| rounded(scaled(size))));
    if let Some(hertz) = hertz.filter(|_| headline != Headline::Restitution) {
        notes.push(format!("Hertz {} (× {:.4})", show(hertz, headline.unit()), value / hertz));
    }
    if headline == Headline::Restitution && (1.0 - value).abs() < 0.1 && value != 1.0 {
        notes.push(format!("1 − e = {}", power_of_ten(1.0 - value)));
    }
    Some(Card {
        name: name(record, headline),
        // Smaller errors are a note's, and have no digits of the number.
        value: with_error(scaled(value), error.filter(|error| *error > SEEN * whole).map(scaled)),
        unit: unit.as_ref().map_or(String::new(), |unit| unit.symbol().to_string()),
        notes,
    })
}

/// What an error is of, where parts are larger than what rounding does, or not known.
fn of_what(
    parts: &Parts,
    numerics: &str,
    least: f64,
    shown: &dyn Fn(f64) -> String,
) -> Option<String> {
    let told = |name: &str, size: Option<f64>, known: Option<f64>| match (size, known) {
        (Some(size), _) => (size > least).then(|| format!("{name} {}", shown(size))),
        (None, Some(known)) if known > least => {
            Some(format!("{name} not known, at least {}", shown(known)))
        }
        (None, _) => Some(format!("{name} not known")),
    };
    let told = [
        told(numerics, parts.discretisation, None),
        told("effects left out", parts.model, parts.model_at_least),
    ];
    let told: Vec<String> = told.into_iter().flatten().collect();
    (!told.is_empty()).then(|| told.join(" + "))
}

/// What a number is called: of radius and pressure, of which shape they are.
pub fn name(record: &Record, headline: Headline) -> String {
    let shape = match headline {
        Headline::MaxContactRadius | Headline::PeakPressure if record.is_finite_strain() => {
            ", true"
        }
        Headline::MaxContactRadius | Headline::PeakPressure => ", nominal",
        _ => "",
    };
    format!("{}{shape}", headline.name())
}

/// What an error of a number is a share of.
pub fn whole(value: f64, headline: Headline) -> f64 {
    if headline == Headline::Restitution { 1.0 } else { value.abs() }
}

/// Shares of a number up to which its error is none, and up to which it is not written beside it.
const EXACT: f64 = 1e-9;
pub const SEEN: f64 = 1e-6;

/// Three digits: `0.0718`, `9.09 × 10⁻⁵`.
pub fn power_of_ten(value: f64) -> String {
    with_digits(&format!("{value:.2e}"))
}

/// Digits with an exponent as people write them.
fn with_digits(text: &str) -> String {
    let parts =
        text.split_once('e').and_then(|(digits, power)| Some((digits, power.parse::<i32>().ok()?)));
    match parts {
        Some((digits, power)) if !(-4..=3).contains(&power) => {
            let power = power.to_string();
            let raised = power.chars().map(|digit| match digit {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                '4'..='9' => {
                    char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit)
                }
                _ => '⁰',
            });
            format!("{digits}\u{a0}×\u{a0}10{}", raised.collect::<String>())
                .replace('-', "\u{2212}")
        }
        _ => text.parse().map_or(text.to_string(), fem_figure::tick).replace('-', "\u{2212}"),
    }
}

/// Digits of a number whose error is known: so many that the error has two.
const MOST_DIGITS: usize = 6;

/// `62.46 ± 0.21`.
pub fn with_error(value: f64, error: Option<f64>) -> String {
    let before = if value == 0.0 { 1 } else { value.abs().log10().floor() as i64 + 1 };
    let most = (MOST_DIGITS as i64 - before.max(1)).max(0);
    let plain = (4 - before.max(0)).clamp(0, 8) as usize;
    match error.filter(|error| *error > 0.0 && error.is_finite()) {
        None => format!("{value:.plain$}"),
        Some(error) => {
            let decimals = (1 - error.log10().floor() as i64).clamp(0, most) as usize;
            let error = if error < 0.5 * 10f64.powi(-(decimals as i32)) {
                rounded(error)
            } else {
                format!("{error:.decimals$}")
            };
            format!("{value:.decimals$} ± {error}")
        }
    }
}

/// Two digits.
pub fn rounded(size: f64) -> String {
    with_digits(&format!("{size:.1e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is missing is said, whatever else is known.
    #[test]
    fn parts_that_are_not_known_are_said() {
        let of = |discretisation, model, model_at_least| {
            let parts = Parts { discretisation, model, model_at_least };
            of_what(&parts, "mesh", 1e-9, &rounded)
        };
        let said = |text: &str| Some(text.to_string());
        assert_eq!(of(Some(0.16), Some(0.5), None), said("mesh 0.16 + effects left out 0.5"));
        assert_eq!(of(Some(1e-12), Some(0.0), None), None);
        assert_eq!(of(Some(1e-12), None, None), said("effects left out not known"));
        assert_eq!(
            of(Some(0.16), None, Some(1.7)),
            said("mesh 0.16 + effects left out not known, at least 1.7")
        );
        assert_eq!(of(None, Some(0.0), None), said("mesh not known"));
    }

    #[test]
    fn powers_of_ten_are_written_out() {
        for (value, expected) in [
            (0.0718, "0.0718"),
            (9.087e-5, "9.09\u{a0}×\u{a0}10⁻⁵"),
            (9.087e-4, "0.000909"),
            (-3.8e-17, "−3.80\u{a0}×\u{a0}10⁻¹⁷"),
            (0.0, "0"),
            (12_345.0, "1.23\u{a0}×\u{a0}10⁴"),
        ] {
            assert_eq!(power_of_ten(value), expected);
        }
    }

    #[test]
    fn a_number_has_the_digits_of_its_error() {
        for (value, error, expected) in [
            (62.459_09, Some(0.2134), "62.46 ± 0.21"),
            (0.927_891_2, Some(1.9e-4), "0.92789 ± 0.00019"),
            (104.586, Some(12.3), "105 ± 12"),
            (969.801, Some(0.0), "969.8"),
            (62.459_09, None, "62.46"),
            (0.927_891_2, None, "0.9279"),
            (62.459_09, Some(1e-9), "62.4591 ± 1.0\u{a0}×\u{a0}10⁻⁹"),
        ] {
            assert_eq!(with_error(value, error), expected);
        }
    }
}
