//! Quantities with an uncertainty: `"70 ± 2 GPa"`, `"70 GPa ± 3 %"`, or a table `{ value = "70 GPa", uncertainty = "2 GPa" }`,
//! which is read as such a text; and temperatures, numbers on a scale with an offset, `23 degC`.

use fem_material::ZERO_CELSIUS;

use crate::quantity::units::{Dimension, UnitError, parse_quantity, unit_of};

/// Signs between a value and its uncertainty.
pub(super) const SIGNS: [&str; 3] = ["±", "+/-", "+-"];
/// The unit of a relative uncertainty.
const RELATIVE: &str = "%";

/// Returns the value of a text in SI, its uncertainty if it has one, and the dimension. A unit that only one of the two has
/// is that of both.
///
/// # Errors
/// A value or an uncertainty that is no quantity, of different dimensions; a negative uncertainty.
pub(crate) fn parse(text: &str) -> Result<(f64, Option<f64>, Dimension), UnitError> {
    let Some((value, spread)) = SIGNS.iter().find_map(|sign| text.split_once(sign)) else {
        let (value, dimension) = parse_quantity(text)?;
        return Ok((value, None, dimension));
    };
    let malformed = |message: &str| Err(UnitError::Malformed(message.to_string()));
    let Ok(unit_of_spread) = unit_of(spread) else {
        return malformed("no number follows the ±");
    };
    let unit = unit_of(value)?;
    if unit_of_spread != RELATIVE && unit_of_spread.contains(RELATIVE) {
        return malformed("its uncertainty is a share and has a unit: write one of both");
    }
    let is_relative = unit_of_spread == RELATIVE && unit != RELATIVE;
    let value = match unit {
        "" if !is_relative => format!("{value} {unit_of_spread}"),
        _ => value.to_string(),
    };
    let (value, dimension) = parse_quantity(&value)?;
    let (spread, dimension_of_spread) = match unit_of_spread {
        "" => parse_quantity(&format!("{spread} {unit}"))?,
        _ => parse_quantity(spread)?,
    };
    match is_relative {
        _ if spread < 0.0 => malformed("its uncertainty is negative"),
        true => Ok((value, Some(spread * value.abs()), dimension)),
        false if dimension_of_spread != dimension => malformed("its uncertainty has another unit"),
        false => Ok((value, Some(spread), dimension)),
    }
}

/// Scales of temperature: name, kelvin per degree, and kelvin at its zero.
pub(crate) const SCALES: [(&str, f64, f64); 8] = [
    ("degC", 1.0, ZERO_CELSIUS),
    ("°C", 1.0, ZERO_CELSIUS),
    ("ºC", 1.0, ZERO_CELSIUS),
    ("C", 1.0, ZERO_CELSIUS),
    ("degF", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("°F", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("F", 5.0 / 9.0, 459.67 * 5.0 / 9.0),
    ("K", 1.0, 0.0),
];

/// Returns a temperature with its scale, `23 degC`, `73 °F` or `296 K`, in K, above 0; `None` for any other text.
///
/// ```
/// assert_eq!(fem_case::parse_temperature("23 degC"), Some(296.15));
/// assert_eq!(fem_case::parse_temperature("20"), None);
/// ```
pub fn parse_temperature(text: &str) -> Option<f64> {
    let text = text.trim();
    let of = |(name, factor, zero): (&str, f64, f64)| {
        let number = text.strip_suffix(name)?.trim().replace('−', "-");
        Some(number.parse::<f64>().ok()? * factor + zero)
    };
    let kelvin = SCALES.into_iter().find_map(of)?;
    (kelvin > 0.0 && kelvin.is_finite()).then_some(kelvin)
}

/// Returns a temperature in K with its uncertainty, `23 ± 2 degC`; `None` for any other text.
pub(super) fn parse_uncertain_temperature(text: &str) -> Option<(f64, Option<f64>)> {
    let Some((value, spread)) = SIGNS.iter().find_map(|sign| text.split_once(sign)) else {
        return Some((parse_temperature(text)?, None));
    };
    let (value, spread) = (value.trim(), spread.trim());
    let (name, factor, _) = SCALES.into_iter().find(|scale| spread.ends_with(scale.0))?;
    let uncertainty = spread.strip_suffix(name)?.trim().parse::<f64>().ok()? * factor;
    let with_scale = format!("{value} {name}");
    let kelvin = parse_temperature(value).or_else(|| parse_temperature(&with_scale))?;
    (uncertainty >= 0.0 && uncertainty.is_finite()).then_some((kelvin, Some(uncertainty)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_uncertainty_has_a_unit_of_its_own_or_that_of_the_value() {
        for (text, value, spread) in [
            ("70 ± 2 GPa", 70e9, 2e9),
            ("70 GPa ± 2 GPa", 70e9, 2e9),
            ("70 GPa ± 0.03", 70e9, 3e7),
            ("70 ± 0.03 GPa", 70e9, 3e7),
            ("70 GPa +- 500 MPa", 70e9, 5e8),
            ("70 GPa +/- 3 %", 70e9, 2.1e9),
            ("-0.2 ± 0.01", -0.2, 0.01),
            ("0.2 ± 3 %", 0.2, 0.006),
            ("20 % ± 1 %", 0.2, 0.01),
            ("0 m/s ± 1 cm/s", 0.0, 0.01),
        ] {
            let (found, uncertainty, _) = parse(text).unwrap();
            assert_eq!(found, value, "{text}");
            assert!((uncertainty.unwrap() - spread).abs() < 1e-12 * spread, "{text}");
        }
        assert_eq!(parse("70 GPa").unwrap().1, None);
        for text in [
            "70 GPa ± -2 GPa",
            "70 GPa ± 2 mm",
            "± 2 GPa",
            "70 GPa ±",
            "1 ± 2 ± 3 m",
            "70 GPa ± 3 % GPa",
            "70 ± 3 %GPa",
            "70 GPa ± 3 GPa %",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
        let error = parse("70 ± GPa").unwrap_err();
        assert_eq!(error.to_string(), "no number follows the ±");
    }

    #[test]
    fn temperatures_have_a_scale() {
        for (text, kelvin) in [
            ("23 degC", 296.15),
            ("-20°C", 253.15),
            ("−20 C", 253.15),
            ("296.15 K", 296.15),
            ("73.4 °F", 296.15),
            ("32 degF", 273.15),
        ] {
            let found = parse_temperature(text).unwrap();
            assert!((found - kelvin).abs() < 1e-9, "{text}: {found}");
        }
        for text in ["", "23", "degC", "-300 degC", "nan K", "inf K", "20 m", "1e400 K", "--2 K"] {
            assert_eq!(parse_temperature(text), None, "{text}");
        }
        assert_eq!(parse_uncertain_temperature("23 ± 2 degC"), Some((296.15, Some(2.0))));
        assert_eq!(parse_uncertain_temperature("23 degC +- 2 K"), Some((296.15, Some(2.0))));
        assert_eq!(parse_uncertain_temperature("23 degC"), Some((296.15, None)));
        for text in ["23 ± 2", "23 degC ± -2 K", "± 2 K", "23 degC ±"] {
            assert_eq!(parse_uncertain_temperature(text), None, "{text}");
        }
    }
}
